#pragma once

#include "scenes/tool/options/option.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

/// The heading in the help of options for several images.
inline constexpr const char* group_of_several = "Parameters and sequences";

/// Python's start:stop:step; negative numbers count from the end.
struct FrameRange {
    std::optional<long> start, stop;
    long step = 1;       ///< > 0
    bool is_one = false; ///< only the frame `start`

    bool counts_from_end() const { return (start && *start < 0) || (stop && *stop < 0); }
    /// Returns the same range counted from the start, for `count` frames.
    FrameRange of(long count) const;
};

/// The images that an automatic camera and the ranges of colours are fitted to.
enum class FitTo : std::uint8_t { first, all, each };

/// A turn by `degrees`, divided into `count` images.
struct Turn {
    double degrees;
    std::size_t count;
};

/// The values of a scene's parameter: "n=1.5", or "n=1.2:1.8:20".
struct ParameterSweep {
    std::string name;
    std::vector<double> values;
    bool is_sweep = false; ///< has the second form
};

Values<FrameRange> frame_ranges();
Values<Turn> turns();
/// `sweeps`: whether a parameter may have several values.
Values<ParameterSweep> parameter_values(bool sweeps);

/// Options for several images.
struct FrameArguments : OptionTable {
    explicit FrameArguments(OptionTable& whole) : OptionTable(whole, group_of_several) {}

    Option<FrameRange> frames = {
        *this, "--frames", frame_ranges().otherwise("0").recorded(),
        "Frames of a trajectory of atoms: one number, or START:STOP:STEP as in Python, "
        "with a step of at least 1. Images are numbered by frame."};
    Option<Turn> turn = {
        *this, "--turn", turns().recorded(),
        "Turn the camera to its right around the point that it looks at: IMAGES images, "
        "each turned by DEGREES/IMAGES from the one before."};
    Option<FitTo> camera_from = {
        *this, "--camera-from",
        choice<FitTo>({{"first", FitTo::first}, {"all", FitTo::all}, {"each", FitTo::each}})
            .initially(FitTo::first)
            .recorded(),
        "Frames that an automatic camera and the ranges of colours are fitted to: the "
        "first one, all, or each one separately."};
    Flag overwrite = {*this, "--overwrite,--force", flag(),
                      "Render images of a sequence again that exist already."};

    /// Returns true if the options request the image of one frame by its number.
    bool is_one() const { return frames && frames->is_one && !turn; }
};

/// Options for the parameters of a scene.
struct ParameterArguments : OptionTable {
    ParameterArguments(OptionTable& whole, bool sweeps);

    /// Returns one value of each parameter for each image. There is one image if each parameter has
    /// one value. Throws BadInput if two parameters have different numbers of values above one.
    std::vector<std::map<std::string, double>> values() const;
    /// Returns true if any value has the form FIRST:LAST:COUNT, even if COUNT is 1.
    bool has_sweep() const;

    ListOption<ParameterSweep> set;
};

} // namespace raylane::scenes
