#pragma once

#include "scenes/files/input_file.hpp"

namespace raylane::scenes {

/// The formats of input files.
enum class Format {
    json,
    nff,
    pov,
    tachyon,
    built,
    pdb,
    cif,
    xyz,
    gro,
    lammps_dump,
    lammps_data,
    mol,
    mol2,
    pqr
};

/// Returns true for formats of atoms. These have no appearance; the user chooses how to draw them.
constexpr bool is_structure(Format format) {
    return format >= Format::pdb;
}

/// Detects the format by the file name's extension (the one before ".gz", if present), otherwise by
/// the content. Throws BadInput with a list of the supported formats if neither decides.
Format format_of(InputFile& file);

} // namespace raylane::scenes
