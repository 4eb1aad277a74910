#pragma once

#include "scenes/input_file.hpp"
#include "scenes/structure/structure.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace raylane::scenes {

/// Options of readers.
struct ReaderOptions {
    std::string atom_style; ///< of LAMMPS' data, as its command atom_style has it, or empty
    OnRemark on_remark;
};

/// A file's frames, one after the other.
class FrameReader {
  public:
    FrameReader() = default;
    virtual ~FrameReader() = default;
    FrameReader(const FrameReader&) = delete;
    FrameReader& operator=(const FrameReader&) = delete;

    /// Reads the next frame, in place of what is there; false if there are no more. Throws
    /// BadInput, with the line, and SystemRefused.
    virtual bool next(Structure& frame) = 0;
};

/// XYZ: the number of atoms, a remark, and lines of an element and three coordinates; with
/// `Properties=` and `Lattice=` in the remark extended XYZ, as ASE and OVITO have it.
std::unique_ptr<FrameReader> open_xyz(InputFile& file);
/// GROMACS' GRO, in nanometres, with as many decimals as it has.
std::unique_ptr<FrameReader> open_gro(InputFile& file);
/// LAMMPS' dump of atoms: `ITEM: ATOMS` with x, y, z, scaled (xs) or unwrapped (xu, xsu).
std::unique_ptr<FrameReader> open_lammps_dump(InputFile& file);
/// Reads LAMMPS' data of any atom style. The options or a remark behind "Atoms" name the style.
/// Without them it follows from the columns, and BadInput is thrown if several styles fit these.
std::unique_ptr<FrameReader> open_lammps_data(InputFile& file, const ReaderOptions& options);
/// PDB, of which each MODEL is a frame; and mmCIF or a small molecule's CIF. By gemmi; without it,
/// BadInput says so.
std::unique_ptr<FrameReader> open_pdb(InputFile& file);
std::unique_ptr<FrameReader> open_cif(InputFile& file, const ReaderOptions& options);

} // namespace raylane::scenes
