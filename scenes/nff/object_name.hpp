#pragma once

#include "scenes/input_file.hpp"

#include <cstddef>
#include <string>

namespace raylane::scenes {

/// Name in messages for the object of a well-formed NFF file that has `objects_before` objects
/// before it: "the s of line 12". Empty where the file cannot be read again (a pipe).
///
/// To know the line of each object would take memory for millions, and hardly ever somebody asks.
std::string nff_object_name(InputFile& file, std::size_t objects_before);

} // namespace raylane::scenes
