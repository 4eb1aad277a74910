#pragma once

#include "simd/kernel/solvers/quadratic.hpp"
#include "simd/kernel/solvers/shapes.hpp"

namespace raylane::simd {

/// core/shapes/sphere.hpp
template <class Arch, bool textbook = false>
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
        const Mask<Arch> leaves = starts.on_surface & starts.inward;
        if constexpr (textbook) {
            Crossings<Arch> roots =
                solve_textbook<Arch>(dd, dot(from_center, rays.direction),
                                     squared_length(from_center) - radius * radius);
            roots.first.exists = roots.first.exists & ~starts.on_surface;
            roots.second.exists = (roots.second.exists & ~starts.on_surface) | leaves;
            roots.second.t = select(leaves, not_behind<Arch>(tau + tau), roots.second.t);
            return roots;
        }
        const Vectors<Arch> foot = mul_add<Arch>(tau, rays.direction, from_center);
        const Floats<Arch> discriminant =
            mul_add<Arch>(radius, radius, negated(squared_length(foot)));
        const Floats<Arch> half_chord = sqrt(discriminant / dd);

        const Mask<Arch> meets = ~(discriminant < zero<Arch>()) & ~starts.on_surface;
        return {{meets, tau - half_chord, zero<Arch>(), all<Arch>()},
                {meets | leaves, select(leaves, not_behind<Arch>(tau + tau), tau + half_chord),
                 zero<Arch>(), none<Arch>()}};
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>&) const {
        return normalized(point - center);
    }
};

} // namespace raylane::simd
