#pragma once

#include "core/scene/film.hpp"
#include "scenes/atomic_file.hpp"
#include "scenes/image/picture_options.hpp"

namespace raylane::scenes {

/// PNG by libpng, in RGB, or RGBA if the film has an alpha, by which PNG's colours are not
/// multiplied. The same bytes for the same picture and options. Throws SystemRefused.
void write_png(AtomicFile& file, const core::Film& film, const PictureOptions& options);

} // namespace raylane::scenes
