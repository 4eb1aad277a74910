#pragma once

#include "core/scene/texture.hpp"
#include "scenes/files/input_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace raylane::scenes {

/// Returns the pixels of a PNG by its first bytes, or 0 for another format.
std::uint64_t pixels_of_png(std::string_view head);

/// Reads a PNG as the colour of surfaces. Grey and palettes become RGB; codes of 16 bits become
/// floats; colour profiles are ignored. Throws BadInput for other formats, for malformed images,
/// for transparent pixels, and for more than `max_pixels`. Throws SystemRefused.
core::Texture read_texture(InputFile& file, std::size_t max_pixels = core::Texture::max_pixels);

} // namespace raylane::scenes
