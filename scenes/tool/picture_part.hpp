#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace raylane::scenes {

/// One of several parts of a picture, each of which is drawn by one process. A part consists of the
/// tiles whose numbers have the same remainder modulo `count`, so that all parts take about as
/// long.
struct PicturePart {
    std::size_t number; ///< from 1
    std::size_t count;

    bool has(std::size_t tile) const { return tile % count == number - 1; }
    /// Returns a text such as "3/16".
    std::string text() const;
};

/// Parses a text such as "3/16". Returns nothing if it is malformed.
std::optional<PicturePart> picture_part_of(const std::string& text);

} // namespace raylane::scenes
