#pragma once

#include "core/scene/surroundings.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// How a file has a picture, and what it has beside it.
struct PictureOptions {
    core::Transfer transfer = core::Transfer::srgb; ///< of .png alone
    /// Of a component: of .png 8 or 16, of .exr 16 or 32; 0: the fewer.
    int bits = 0;
    std::optional<float> dpi; ///< pixels per inch, in .png and .exr
    /// Names and what they stand for, in UTF-8, in .png and .exr. Names are those that PNG knows:
    /// Title, Software, Comment, ...
    std::vector<std::pair<std::string, std::string>> texts;
};

} // namespace raylane::scenes
