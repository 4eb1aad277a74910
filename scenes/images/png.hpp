#pragma once

#include "core/scene/film.hpp"
#include "scenes/files/atomic_file.hpp"
#include "scenes/images/float_images.hpp"
#include "scenes/images/image_options.hpp"

#include <string>
#include <string_view>

namespace raylane::scenes {

/// Reads PNG by libpng: all variants of the format, with all checksums verified. Grey becomes RGB;
/// colour profiles are ignored. Throws MalformedImage, also for data after the end of the
/// image, and std::bad_alloc.
void read_png(ByteSource& source, Image& image);

/// Returns the type of the first chunk that raylane never writes, such as gAMA, or an empty text.
/// Such a chunk may change how a viewer shows the codes. For a text chunk, the key follows the type
/// ("tEXt Author"). raylane writes each of its keys at most once, so a repeated key is foreign,
/// too. `bytes`: a PNG that read_png() accepts.
std::string foreign_chunk(std::string_view bytes);

/// Writes PNG by libpng as RGB, or as RGBA if the film has an alpha; PNG's colours are not
/// multiplied by alpha. The same image and options give the same bytes. Throws SystemRefused.
void write_png(AtomicFile& file, const core::Film& film, const ImageOptions& options);

} // namespace raylane::scenes
