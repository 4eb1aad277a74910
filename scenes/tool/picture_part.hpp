#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace raylane::scenes {

/// One of several parts of a picture, of each of which a process draws the tiles: those whose
/// number leaves the same rest, so that all take about as long.
struct PicturePart {
    std::size_t number; ///< from 1
    std::size_t count;

    bool has(std::size_t tile) const { return tile % count == number - 1; }
    /// "3/16".
    std::string text() const;
};

/// Of a text such as "3/16"; nothing if it is none.
std::optional<PicturePart> picture_part_of(const std::string& text);

} // namespace raylane::scenes
