#pragma once

#include "core/scene/surroundings.hpp"

#include <array>

namespace raylane::core {

/// Returns how far a pixel's filter reaches from the pixel's middle along each axis, in pixels.
constexpr double reach_of(PixelFilter filter) {
    return filter == PixelFilter::box ? 0.5 : 1.5;
}

/// Distributes samples by the density of a filter, so that the mean of a pixel's samples is its
/// filtered colour (Ernst, Stamminger and Greiner, "Filter Importance Sampling", 2006). All filters
/// are separable: a product of a function of x and one of y.
class FilterPlaces {
  public:
    explicit FilterPlaces(PixelFilter filter);

    /// Maps an evenly distributed coordinate in [0, 1] to [0.5 - reach, 0.5 + reach].
    double place(double even) const {
        const double at = even * intervals;
        const int interval = at < intervals ? static_cast<int>(at) : intervals - 1;
        const auto i = static_cast<std::size_t>(interval);
        return places_[i] + (at - interval) * (places_[i + 1] - places_[i]);
    }

    /// Returns the table of a filter, which is computed once.
    static const FilterPlaces& of(PixelFilter filter);

  private:
    static constexpr int intervals = 256;
    std::array<double, intervals + 1> places_{};
};

} // namespace raylane::core
