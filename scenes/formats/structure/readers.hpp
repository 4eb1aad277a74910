#pragma once

#include "scenes/files/input_file.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <memory>
#include <string>

namespace raylane::scenes {

/// Options of readers.
struct ReaderOptions {
    std::string atom_style; ///< of LAMMPS' data, as in the command atom_style, or empty
    OnRemark on_remark;
    int frame = 0; ///< that read_structure() shows; negative: counted from the end
};

/// Reads a file's frames, one after the other.
class FrameReader {
  public:
    FrameReader() = default;
    virtual ~FrameReader() = default;
    FrameReader(const FrameReader&) = delete;
    FrameReader& operator=(const FrameReader&) = delete;

    /// Reads the next frame into `frame`, and replaces its contents. Returns false after the last
    /// frame. Throws BadInput, with the line, and SystemRefused.
    virtual bool next(Structure& frame) = 0;
};

/// Reads XYZ: the number of atoms, a comment, and lines of an element and three coordinates. With
/// `Properties=` and `Lattice=` in the comment, reads extended XYZ, as written by ASE and OVITO.
std::unique_ptr<FrameReader> open_xyz(InputFile& file);
/// Reads GROMACS' GRO, in nanometres, with any number of decimals.
std::unique_ptr<FrameReader> open_gro(InputFile& file);
/// Reads LAMMPS' dump of atoms: `ITEM: ATOMS` with x, y, z, scaled (xs) or unwrapped (xu, xsu).
std::unique_ptr<FrameReader> open_lammps_dump(InputFile& file);
/// Reads LAMMPS' data of any atom style. The options, or a comment after "Atoms", name the style.
/// Without them the style follows from the columns. Throws BadInput if several styles fit these.
std::unique_ptr<FrameReader> open_lammps_data(InputFile& file, const ReaderOptions& options);
/// Reads MOL and SDF (V2000 and V3000), in which each record is a frame, with formal charges.
std::unique_ptr<FrameReader> open_mol(InputFile& file);
/// Reads Tripos' MOL2, in which each molecule is a frame, with charges.
std::unique_ptr<FrameReader> open_mol2(InputFile& file);
/// Reads PQR: PDB with a charge and a radius in angstrom for each atom, separated by blanks.
std::unique_ptr<FrameReader> open_pqr(InputFile& file);
/// Read PDB, in which each MODEL is a frame, and mmCIF or a small molecule's CIF. Without gemmi,
/// throw BadInput.
std::unique_ptr<FrameReader> open_pdb(InputFile& file);
std::unique_ptr<FrameReader> open_cif(InputFile& file, const ReaderOptions& options);

} // namespace raylane::scenes
