#include "core/scene/pixel_filter.hpp"

#include "core/numbers/elementary.hpp"

namespace raylane::core {

namespace {

/// Returns the density, not normalised, at `x` in [-1, 1] of the filter's reach.
double density(PixelFilter filter, double x) {
    switch (filter) {
    case PixelFilter::box:
        break;
    case PixelFilter::gaussian: {
        constexpr double deviation = 0.5, reach = reach_of(PixelFilter::gaussian);
        const double at = x * reach / deviation;
        constexpr double at_end = reach / deviation;
        return core::exp(-0.5 * at * at) - core::exp(-0.5 * at_end * at_end);
    }
    case PixelFilter::blackman_harris: {
        // Harris, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier
        // Transform" (1978): the minimum of four terms.
        constexpr double pi = 3.14159265358979323846;
        return 0.35875 + 0.48829 * core::cos(pi * x) + 0.14128 * core::cos(2.0 * pi * x) +
               0.01168 * core::cos(3.0 * pi * x);
    }
    }
    return 1.0;
}

} // namespace

/// Tabulates the inverse of the density's integral. The trapezoidal rule uses steps much smaller
/// than the table's.
FilterPlaces::FilterPlaces(PixelFilter filter) {
    constexpr int steps = 1 << 14;
    constexpr double step = 2.0 / steps;
    const auto at = [](int i) { return -1.0 + i * step; };
    double total = 0.0;
    for (int i = 0; i < steps; ++i)
        total += density(filter, at(i)) + density(filter, at(i + 1));

    const double reach = reach_of(filter);
    int next = 1;
    double sum = 0.0;
    places_.front() = 0.5 - reach;
    for (int i = 0; i < steps; ++i) {
        const double more = density(filter, at(i)) + density(filter, at(i + 1));
        for (; next < intervals && sum + more >= total * next / intervals; ++next)
            places_[static_cast<std::size_t>(next)] =
                0.5 + reach * (at(i) + step * ((total * next / intervals - sum) / more));
        sum += more;
    }
    places_.back() = 0.5 + reach;
}

const FilterPlaces& FilterPlaces::of(PixelFilter filter) {
    static const FilterPlaces box(PixelFilter::box), gaussian(PixelFilter::gaussian),
        blackman_harris(PixelFilter::blackman_harris);
    return filter == PixelFilter::box        ? box
           : filter == PixelFilter::gaussian ? gaussian
                                             : blackman_harris;
}

} // namespace raylane::core
