#pragma once

#include "scenes/tool/command.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// The heading in the help of options for several pictures.
inline constexpr const char* group_of_several = "Parameters and sequences";
inline constexpr int most_pictures = 1'000'000;

/// Python's start:stop:step; negative numbers count from the end.
struct FrameRange {
    std::optional<long> start, stop;
    long step = 1;       ///< > 0
    bool is_one = false; ///< only the frame `start`

    bool counts_from_end() const { return (start && *start < 0) || (stop && *stop < 0); }
    /// Returns the same range counted from the start, for `count` frames.
    FrameRange of(long count) const;
};

/// The pictures that an automatic camera and the ranges of colours are fitted to.
enum class FitTo : std::uint8_t { first, all, each };

/// A turn by `degrees`, divided into `count` pictures.
struct Turn {
    double degrees;
    std::size_t count;
};

/// Command line options for several pictures.
struct FrameArguments {
    Argument frames, camera_from, turn;
    bool overwrite = false; ///< draw pictures whose files exist already

    void add_to(CLI::App& command);
    /// Returns names and values of the options that are given and that pictures depend on.
    std::vector<std::pair<std::string, std::string>> given() const;
    // Throw BadInput.
    std::optional<FrameRange> range() const;
    /// Returns true if the options request the picture of one frame by its number.
    bool is_one() const;
    std::optional<Turn> turning() const;
    FitTo fit_to() const;
};

} // namespace raylane::scenes
