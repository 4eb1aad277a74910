#pragma once

#include "simd/kernel/solvers/shapes.hpp"

namespace raylane::simd {

/// core/solvers/sphere.hpp
template <class Arch>
struct SphereLanes {
    Vectors<Arch> center;
    Floats<Arch> radius;

    template <class Reader>
    explicit SphereLanes(Reader reader)
        : center(next_vector<Arch>(reader)), radius(reader.next()) {}

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> from_center = rays.origin - center;
        const Floats<Arch> dd = squared_length(rays.direction);
        const Floats<Arch> tau = negated(dot(from_center, rays.direction)) / dd;
        const Vectors<Arch> foot = mul_add<Arch>(tau, rays.direction, from_center);
        const Floats<Arch> discriminant =
            mul_add<Arch>(radius, radius, negated(squared_length(foot)));
        const Floats<Arch> half_chord = xsimd::sqrt(discriminant / dd);

        const Mask<Arch> meets = ~(discriminant < zero<Arch>()) & ~starts.on_surface;
        const Mask<Arch> leaves = starts.on_surface & starts.inward;
        return {{meets, tau - half_chord, zero<Arch>(), all<Arch>()},
                {meets | leaves,
                 xsimd::select(leaves, not_behind<Arch>(tau + tau), tau + half_chord), zero<Arch>(),
                 none<Arch>()}};
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>&) const {
        return normalized(point - center);
    }
};

} // namespace raylane::simd
