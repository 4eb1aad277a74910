#pragma once

#include "scenes/tool/command.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// What options of several pictures are under in the help.
inline constexpr const char* group_of_several = "Parameters and several pictures";
inline constexpr int most_pictures = 1'000'000;

/// Python's start:stop:step; what is negative counts from the end.
struct FrameRange {
    std::optional<long> start, stop;
    long step = 1;       ///< > 0
    bool is_one = false; ///< start alone

    bool counts_from_end() const { return (start && *start < 0) || (stop && *stop < 0); }
    /// The same from the start, where it is known how many frames there are.
    FrameRange of(long count) const;
};

/// What fits several pictures of one film.
enum class FitTo : std::uint8_t { first, all, each };

/// A whole turn, or another angle, in so many pictures.
struct Turn {
    double degrees;
    std::size_t count;
};

/// How a command line asks for several pictures.
struct FrameArguments {
    Argument frames, camera_from, turn;
    bool overwrite = false; ///< files that are there already

    void add_to(CLI::App& command);
    /// Those that are given, of which a picture of a film is made again: names and values.
    std::vector<std::pair<std::string, std::string>> given() const;
    // Throw BadInput.
    std::optional<FrameRange> range() const;
    /// True if they ask for one picture: that of a frame, by its number.
    bool is_one() const;
    std::optional<Turn> turning() const;
    FitTo fit_to() const;
};

} // namespace raylane::scenes
