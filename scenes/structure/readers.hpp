#pragma once

#include "scenes/input_file.hpp"
#include "scenes/structure/structure.hpp"

#include <memory>
#include <string_view>

namespace raylane::scenes {

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
/// What LAMMPS' read_data reads: of the atom styles angle, atomic, bond, charge, full, molecular,
/// and sphere.
std::unique_ptr<FrameReader> open_lammps_data(InputFile& file);
/// PDB, of which each MODEL is a frame; and mmCIF or a small molecule's CIF. By gemmi; without it,
/// BadInput says so.
std::unique_ptr<FrameReader> open_pdb(InputFile& file);
std::unique_ptr<FrameReader> open_cif(InputFile& file);

} // namespace raylane::scenes
