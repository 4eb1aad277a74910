#pragma once

#include "scenes/files/input_file.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace raylane::scenes {

/// Python's start:stop:step; negative numbers count from the end.
struct FrameRange {
    std::optional<long> start{}, stop{};
    long step = 1;       ///< > 0
    bool is_one = false; ///< only the frame `start`

    bool counts_from_end() const { return (start && *start < 0) || (stop && *stop < 0); }
    /// Returns the same range counted from the start, for `count` frames.
    FrameRange of(long count) const;
};

/// Options of readers.
struct ReaderOptions {
    std::string atom_style; ///< of LAMMPS' data, as in the command atom_style, or empty
    OnRemark on_remark;
    FrameRange frames = {}; ///< of which read_structure() shows the first one
    /// Receives the frame that read_structure() shows.
    std::function<void(const Structure&)> on_structure = {};
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
