#pragma once

#include "scenes/image/float_pictures.hpp"

#include <string>
#include <string_view>

namespace raylane::scenes {

/// PNG by libpng: all that the format has, with all of its checksums. Grey becomes RGB, colour
/// profiles are left out. Throws MalformedPicture, also for what follows the picture's end, and
/// std::bad_alloc.
void read_png(ByteSource& source, Image& image);

/// Returns the type of the first chunk that raylane never writes, such as gAMA, or an empty text.
/// Such a chunk may change how a viewer shows the codes. The type of a text has its key behind it
/// ("tEXt Author"): each key of raylane's is there once. `bytes`: a PNG that read_png() accepts.
std::string foreign_chunk(std::string_view bytes);

} // namespace raylane::scenes
