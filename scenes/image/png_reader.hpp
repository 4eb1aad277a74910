#pragma once

#include "scenes/image/float_pictures.hpp"

namespace raylane::scenes {

/// PNG by libpng: all that the format has, with all of its checksums. Grey becomes RGB, colour
/// profiles are left out. Throws MalformedPicture, also for what follows the picture's end, and
/// std::bad_alloc.
void read_png(ByteSource& source, Image& image);

} // namespace raylane::scenes
