#include "core/beams/pixel_samples.hpp"

#include "core/scene/scene.hpp"

#include <cmath>

namespace raylane::core {

namespace {

/// Returns the squared slope of the film's transfer curve at a linear component. For sRGB this is
/// the slope of the square root, which is close to the curve of IEC 61966-2-1, limited to the
/// curve's steepest slope.
double squared_slope(double linear, Transfer transfer) {
    constexpr double steepest = 12.92;
    if (transfer == Transfer::linear) return 1.0;
    return std::min(steepest * steepest, 0.25 / std::max(linear, 1e-4));
}

/// The background, the last of four channels, counts as three channels of white.
constexpr std::size_t channels_of_film[] = {0, 1, 2, 3, 3, 3};

} // namespace

double light_rays_of(const Scene& scene, const Settings& settings) {
    double rays = 0.0;
    for (const Light& light : scene.lights())
        rays += is_soft(light.kind) ? static_cast<double>(settings.light_rays()) : 1.0;
    return rays;
}

SamplePoint place_in_grid(int number, int samples) {
    int side = 1;
    while (side * side < samples)
        ++side;
    const int cell = number + side * side;
    const auto center_of = [side](int index) {
        return (static_cast<float>(index) + 0.5F) / static_cast<float>(side);
    };
    return {center_of(cell % side), center_of(cell / side)};
}

Shown::Shown(const Sample& sample) {
    for (int channel = 0; channel < 3; ++channel)
        channels[static_cast<std::size_t>(channel)] =
            std::sqrt(std::clamp(static_cast<float>(sample.color[channel]), 0.0F, 1.0F));
    channels[3] = std::sqrt(static_cast<float>(sample.transmittance));
}

double variance_around(std::span<const Shown> middles) {
    std::array<float, 4> sum{}, squares{};
    const Shown& first = middles.front();
    for (const Shown& middle : middles)
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const float off = middle.channels[channel] - first.channels[channel];
            sum[channel] += off;
            squares[channel] += off * off;
        }
    const auto n = static_cast<float>(middles.size());
    float total = 0.0F;
    for (const std::size_t channel : channels_of_film)
        total += std::max(0.0F, squares[channel] / n - sum[channel] / n * (sum[channel] / n));
    return static_cast<double>(total) / 3.0;
}

PixelSamples& PixelSamples::operator+=(const PixelSamples& more) {
    count_ += more.count_;
    sum_ += more.sum_;
    for (std::size_t channel = 0; channel < channels; ++channel) {
        seen_sum_[channel] += more.seen_sum_[channel];
        seen_squares_[channel] += more.seen_squares_[channel];
    }
    for (std::size_t i = 0; i < more.shapes_count_; ++i)
        if (!has_seen(more.shapes_[i]) && shapes_count_ < max_shapes)
            shapes_[shapes_count_++] = more.shapes_[i];
    return *this;
}

double PixelSamples::squares_shown(Transfer transfer) const {
    const double n = count_;
    double squares = 0.0;
    for (const std::size_t channel : channels_of_film) {
        const double mean = seen_sum_[channel] / n;
        squares +=
            std::max(0.0, seen_squares_[channel] - n * mean * mean) * squared_slope(mean, transfer);
    }
    return squares / 3.0;
}

} // namespace raylane::core
