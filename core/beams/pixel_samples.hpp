#pragma once

#include "core/numbers/sample_sequence.hpp"
#include "core/scene/surroundings.hpp"
#include "core/shapes/shape.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace raylane::core {

class Scene;

/// The result of one sample.
struct Sample {
    Vec3d color;              ///< linear RGB
    ShapeId shape = no_shape; ///< the first shape that the camera's ray hits
    /// Share of the background that is visible in a straight line and left out (Settings::alpha),
    /// or 0.
    double transmittance = 0.0;
    double cost = 1.0; ///< number of rays of its path, and of rays to lights
};

/// Returns the number of rays to lights from each surface that a path meets.
double light_rays_of(const Scene& scene, const Settings& settings);

/// Returns the position of sample `number` < 0 of a first grid of `samples` samples, relative to
/// the pixel's upper left corner: the centre of its cell.
SamplePoint place_in_grid(int number, int samples);

/// Returns the position of a sample in its pixel, relative to the upper left corner, before the
/// filter is applied.
inline SamplePoint place_in_pixel(const SampleName& sample) {
    if (sample.number < 0) return place_in_grid(sample.number, sample.common);
    return sequence_point(sequence_key(static_cast<std::uint32_t>(sample.x),
                                       static_cast<std::uint32_t>(sample.y), SequenceUse::in_pixel),
                          static_cast<std::uint32_t>(sample.number));
}

/// A sample in roughly the scale of the film: square roots of the components, at most 1, and of the
/// share of the background, which counts as white.
struct Shown {
    std::array<float, 4> channels{};

    Shown() = default;
    explicit Shown(const Sample& sample);
};

/// Returns the variance of the middle samples of a pixel and its neighbours, at most nine of them.
double variance_around(std::span<const Shown> middles);

/// The mean of samples.
struct Mean {
    Vec3d color;
    double transmittance;
};

/// The samples of one pixel so far.
class PixelSamples {
  public:
    int count() const { return count_; }
    Color mean() const { return convert<float>(Vec3d(sum_ / static_cast<double>(count_))); }
    /// Mean in double, including the background.
    Mean exact_mean() const {
        const double n = count_;
        return {sum_ / n, seen_sum_[of_background] / n};
    }
    float alpha() const {
        return static_cast<float>(1.0 - seen_sum_[of_background] / static_cast<double>(count_));
    }

    /// Adds a sample. Call in the order of the samples' numbers.
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
        if (!has_seen(sample.shape) && shapes_count_ < max_shapes)
            shapes_[shapes_count_++] = sample.shape;
    }

    /// Adds samples that follow those of this object.
    PixelSamples& operator+=(const PixelSamples& more);

    /// Returns true if a sample has hit the shape, or, for no_shape, has hit nothing. Knows the
    /// first `max_shapes` shapes only.
    bool has_seen(ShapeId shape) const {
        return std::find(shapes_.begin(), shapes_.begin() + shapes_count_, shape) !=
               shapes_.begin() + shapes_count_;
    }

    /// Returns the sum of squares about the mean in the scale of the film, averaged over the
    /// channels.
    double squares_shown(Transfer transfer) const;

    static constexpr int max_shapes = 8;

  private:
    /// The share of the background that is left out counts as white.
    static constexpr std::size_t of_background = 3, channels = 4;

    int count_ = 0;
    std::size_t shapes_count_ = 0;
    std::array<ShapeId, max_shapes> shapes_{};
    Vec3d sum_{0.0};
    // Sums over the colours clamped to [0, 1], and over the background's share.
    std::array<double, channels> seen_sum_{}, seen_squares_{};
};

} // namespace raylane::core
