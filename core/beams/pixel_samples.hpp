#pragma once

#include "core/scene/surroundings.hpp"
#include "core/shapes/shape.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace raylane::core {

/// What a sample shows.
struct Sample {
    Vec3d color;              ///< linear RGB
    ShapeId shape = no_shape; ///< that the camera's ray hits first
    double t = 0.0;           ///< where it does
    /// The share of the background that is seen straight on and left out (Settings::alpha), or 0.
    double transmittance = 0.0;
};

/// The samples of one pixel so far.
class PixelSamples {
  public:
    int count() const { return count_; }
    Color mean() const { return convert<float>(Vec3d(sum_ / static_cast<double>(count_))); }
    float alpha() const {
        return static_cast<float>(1.0 - seen_sum_[of_background] / static_cast<double>(count_));
    }

    /// To be called in the order of the samples' numbers.
    void add(const Sample& sample) {
        ++count_;
        sum_ += sample.color;
        for (std::size_t channel = 0; channel < channels; ++channel) {
            const double seen = channel == of_background
                                    ? sample.transmittance
                                    : std::clamp(sample.color[static_cast<int>(channel)], 0.0, 1.0);
            seen_sum_[channel] += seen;
            seen_squares_[channel] += seen * seen;
        }
        farthest_ =
            std::max(farthest_,
                     sample.shape == no_shape ? std::numeric_limits<double>::infinity() : sample.t);
        if (!has_seen(sample.shape) && shapes_count_ < most_shapes)
            shapes_[shapes_count_++] = sample.shape;
    }

    /// True if a sample has hit the shape, or, for no_shape, none. Of the first `most_shapes`.
    bool has_seen(ShapeId shape) const {
        return std::find(shapes_.begin(), shapes_.begin() + shapes_count_, shape) !=
               shapes_.begin() + shapes_count_;
    }

    /// Shapes that have been hit, and one more if a sample hit none; `most_shapes` at most.
    int different_shapes() const { return shapes_count_; }

    /// The largest t at which a sample hits; infinite if one hits nothing.
    double farthest() const { return farthest_; }

    /// True if the mean is probably off by no more than that, as the film shows it: 1 is white.
    /// `is_blurred`: what is seen depends on the place on a lens, too.
    bool is_within(double tolerance, Transfer transfer, bool is_blurred) const;

    static constexpr int most_shapes = 8;

  private:
    /// What is left out of the background is seen as if that were white.
    static constexpr std::size_t of_background = 3, channels = 4;

    int count_ = 0;
    int shapes_count_ = 0;
    double farthest_ = 0.0;
    std::array<ShapeId, most_shapes> shapes_{};
    Vec3d sum_{0.0};
    // Of colours as the film has them, 1 at most, and of the background.
    std::array<double, channels> seen_sum_{}, seen_squares_{};
};

} // namespace raylane::core
