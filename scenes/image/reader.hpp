#pragma once

#include "scenes/image/components.hpp"
#include "scenes/input_file.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// A picture with the components that its file has.
struct Image {
    int width = 0;
    int height = 0;
    /// True if the components are linear floats (EXR, HDR, PFM); false if they are codes divided by
    /// the largest code (PNG).
    bool linear_float = false;
    Components rgb;   ///< width * height * 3, rows from the top down
    Components alpha; ///< width * height; empty: 1 everywhere
    std::string name; ///< of the file, for messages
    /// Texts of a PNG or EXR beside the pixels, same as PictureOptions::texts.
    std::vector<std::pair<std::string, std::string>> texts{};
    int bits = 0; ///< per component in the file: 8 or 16 (PNG), 16 or 32 (EXR), 0 (others)
};

/// Reads a PNG, EXR, HDR or PFM picture; the content decides which. Grey becomes RGB. Throws
/// BadInput for other formats and for malformed or excessively large pictures, and SystemRefused.
Image read_image(const std::filesystem::path& path);
Image read_image(InputFile& file);

} // namespace raylane::scenes
