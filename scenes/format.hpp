#pragma once

#include "scenes/input_file.hpp"

namespace raylane::scenes {

/// What files that are read hold.
enum class Format { json, nff, pov, tachyon, built, pdb, cif, xyz, gro, lammps_dump, lammps_data };

/// True of atoms, which are drawn as the reader likes.
constexpr bool is_structure(Format format) {
    return format >= Format::pdb;
}

/// By the file's ending (what is before ".gz", where it has that), or else by its content. Throws
/// BadInput, with what there is, if neither tells.
Format format_of(InputFile& file);

} // namespace raylane::scenes
