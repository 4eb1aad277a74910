#pragma once

#include "core/scene/aovs.hpp"
#include "core/scene/film.hpp"
#include "scenes/images/image_options.hpp"
#include "scenes/images/reader.hpp"

#include <string>
#include <string_view>

namespace raylane::scenes {

/// Returns true if raylane was built with libtiff.
bool has_tiff();

/// Returns the bytes of a TIFF file: R, G, B, and a separate A if the film has an alpha, of 8 or 16
/// bits through the transfer curve, without loss by LZW with differences, in one strip per 64 KiB.
/// It has the resolution, and Title, Software and the other texts as DocumentName, Software and
/// ImageDescription. Without AOVs. Throws std::bad_alloc, and BadInput without libtiff.
std::string tiff_of(const core::Film& film, const core::Aovs* aovs, const ImageOptions& options);

/// Returns true for the first bytes of a TIFF file.
bool looks_like_tiff(std::string_view head);

/// Reads a TIFF of 8 or 16 bits: RGB, or RGB and an alpha that is not multiplied, in strips; the
/// first image of the file. The texts are those that tiff_of() writes. Throws MalformedImage, also
/// for other forms of TIFF, and without libtiff; and std::bad_alloc.
void read_tiff(const std::string& bytes, Image& image);

/// Returns the number of the first tag that raylane never writes, such as "tag 34675", or an empty
/// text. Such a tag, another orientation or a second image may change how a viewer shows the codes.
/// `bytes`: a TIFF that read_tiff() accepts.
std::string foreign_tag(std::string_view bytes);

} // namespace raylane::scenes
