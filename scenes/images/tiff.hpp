#pragma once

#include "core/scene/film.hpp"
#include "core/scene/layers.hpp"
#include "scenes/images/image_options.hpp"

#include <string>

namespace raylane::scenes {

/// Returns true if raylane was built with libtiff.
bool has_tiff();

/// Returns the bytes of a TIFF file: R, G, B, and a separate A if the film has an alpha, of 8 or 16
/// bits through the transfer curve, without loss by LZW with differences, in one strip per 64 KiB.
/// It has the resolution, and Title, Software and the other texts as DocumentName, Software and
/// ImageDescription. There are no layers. Throws std::bad_alloc, and BadInput without libtiff.
std::string tiff_of(const core::Film& film, const core::Layers* layers,
                    const ImageOptions& options);

} // namespace raylane::scenes
