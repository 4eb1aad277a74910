#pragma once

#include "scenes/image/components.hpp"
#include "scenes/input_file.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// A picture as a file holds it.
struct Image {
    int width = 0;
    int height = 0;
    /// True if the components are linear floats (EXR, HDR, PFM), not codes divided by the largest
    /// code (PNG).
    bool linear_float = false;
    Components rgb;   ///< width * height * 3, rows from the top down
    Components alpha; ///< width * height, or nothing: 1
    std::string name; ///< of its file, for messages
    /// What PNG or EXR say beside the pixels, as PictureOptions has it.
    std::vector<std::pair<std::string, std::string>> texts{};
    int bits = 0; ///< of a component in the file: of PNG 8 or 16, of EXR 16 or 32; else 0
};

/// Reads a PNG, EXR, HDR or PFM picture; the content tells which. Grey becomes RGB. Throws BadInput
/// for anything else and for what is malformed or absurdly large, and SystemRefused.
Image read_image(const std::filesystem::path& path);
Image read_image(InputFile& file);

} // namespace raylane::scenes
