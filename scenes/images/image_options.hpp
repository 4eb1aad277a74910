#pragma once

#include "core/scene/surroundings.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// Encoding of an image's file, and its metadata.
struct ImageOptions {
    core::Transfer transfer = core::Transfer::srgb; ///< for .png and .tif
    /// Bits per component: 8 or 16 in .png and .tif, 16 or 32 in .exr; 0: the smaller one.
    int bits = 0;
    std::optional<float> dpi{}; ///< pixels per inch, in .png, .tif and .exr
    /// Names and texts in UTF-8, for .png, .tif and .exr. The names are PNG's keywords: Title,
    /// Software, Comment, ...
    std::vector<std::pair<std::string, std::string>> texts{};
};

} // namespace raylane::scenes
