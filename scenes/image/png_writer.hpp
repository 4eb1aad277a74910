#pragma once

#include "core/scene/film.hpp"
#include "scenes/atomic_file.hpp"
#include "scenes/image/picture_options.hpp"

namespace raylane::scenes {

/// Writes PNG by libpng as RGB, or as RGBA if the film has an alpha; PNG's colours are not
/// multiplied by alpha. The same picture and options give the same bytes. Throws SystemRefused.
void write_png(AtomicFile& file, const core::Film& film, const PictureOptions& options);

} // namespace raylane::scenes
