#pragma once

#include "simd/kernel/shapes/quadratic.hpp"

namespace raylane::simd {

/// Same as core::ball_crossings, per lane.
template <class Arch, bool textbook>
Crossings<Arch> ball_crossings(const MeasuredRays<Arch>& rays, const Floats<Arch>& radius,
                               const Starts<Arch>& starts) {
    const Vectors<Arch>&origin = rays.origin, &direction = rays.direction;
    const Floats<Arch>& dd = rays.squared_length;
    const Divisor<Arch>& by_dd = rays.by_squared_length;
    const Floats<Arch> tau = negated(dot(origin, direction)) / by_dd;
    const Mask<Arch> leaves = starts.on_surface & starts.inward;
    if constexpr (textbook) {
        Crossings<Arch> roots = solve_textbook<Arch>(dd, dot(origin, direction),
                                                     squared_length(origin) - radius * radius);
        roots.first.exists = roots.first.exists & ~starts.on_surface;
        roots.second.exists = (roots.second.exists & ~starts.on_surface) | leaves;
        roots.second.t = select(leaves, not_behind<Arch>(tau + tau), roots.second.t);
        return roots;
    }
    const Vectors<Arch> foot = mul_add<Arch>(tau, direction, origin);
    const Floats<Arch> discriminant = mul_add<Arch>(radius, radius, negated(squared_length(foot)));
    const Floats<Arch> half_chord = sqrt(discriminant / by_dd);

    const Mask<Arch> meets = ~(discriminant < zero<Arch>()) & ~starts.on_surface;
    return {{meets, tau - half_chord, zero<Arch>(), all<Arch>()},
            {meets | leaves, select(leaves, not_behind<Arch>(tau + tau), tau + half_chord),
             zero<Arch>(), none<Arch>()}};
}

} // namespace raylane::simd
