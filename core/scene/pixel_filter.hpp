#pragma once

#include "core/scene/surroundings.hpp"

#include <array>

namespace raylane::core {

/// How far from its middle a pixel's filter reaches, in pixels, along each axis.
constexpr double reach_of(PixelFilter filter) {
    return filter == PixelFilter::box ? 0.5 : 1.5;
}

/// Places samples by the density of a filter, so that the mean of a pixel's samples is its filtered
/// colour (Ernst, Stamminger and Greiner, "Filter Importance Sampling", 2006). All filters are
/// products of one of x and one of y.
class FilterPlaces {
  public:
    explicit FilterPlaces(PixelFilter filter);

    /// Where a coordinate in [0, 1] that is spread evenly goes: in [0.5 - reach, 0.5 + reach].
    double place(double even) const {
        const double at = even * intervals;
        const int interval = at < intervals ? static_cast<int>(at) : intervals - 1;
        const auto i = static_cast<std::size_t>(interval);
        return places_[i] + (at - interval) * (places_[i + 1] - places_[i]);
    }

    /// The one of a filter; made once.
    static const FilterPlaces& of(PixelFilter filter);

  private:
    static constexpr int intervals = 256;
    std::array<double, intervals + 1> places_{};
};

} // namespace raylane::core
