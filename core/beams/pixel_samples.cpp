#include "core/beams/pixel_samples.hpp"

#include "core/numbers/elementary.hpp"

#include <cmath>

namespace raylane::core {

namespace {

/// How much more a linear component differs as the film shows it: the slope of IEC 61966-2-1.
double slope_shown(double linear) {
    constexpr double steepest = 12.92, end_of_line = 0.0031308;
    return linear <= end_of_line ? steepest : 1.055 / 2.4 * core::pow(linear, 1.0 / 2.4 - 1.0);
}
constexpr double least_slope = 1.055 / 2.4;

} // namespace

/// The mean of n points of a (0, 2)-sequence is off by some n^(-3/4) of the deviation where an edge
/// goes through, as each of their cells is a small pixel; by some n^(-5/8) if the edge depends on
/// two such points at a time.
bool PixelSamples::is_within(double tolerance, Transfer transfer, bool is_blurred) const {
    const double n = count_;
    const double root = std::sqrt(n);
    const double accuracy = 1.0 / std::sqrt(n * (is_blurred ? std::sqrt(root) : root));
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const double mean = seen_sum_[channel] / n;
        const double variance = std::max(0.0, seen_squares_[channel] / n - mean * mean);
        const double off = std::sqrt(variance * n / (n - 1.0)) * accuracy;
        if (transfer == Transfer::linear) {
            if (off > tolerance) return false;
            continue;
        }
        if (off * least_slope > tolerance) return false;
        if (off * slope_shown(0.0) <= tolerance) continue;
        if (off * slope_shown(mean) > tolerance) return false;
    }
    return true;
}

} // namespace raylane::core
