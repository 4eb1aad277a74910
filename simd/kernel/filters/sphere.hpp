#pragma once

#include "simd/kernel/filters/filter.hpp"

namespace raylane::simd {

/// In exact arithmetic, with f = origin - center, tau = -f . d and q = f + tau d (the foot of the
/// perpendicular), a unit direction crosses at tau -+ sqrt(r^2 - q^2).
///
/// With u = half_ulp, tau comes with an error below slack + 9 u |f|: f is off by slack + u |f|, d
/// by u, and the sum of three products by 4 u |f|, with room for |d| != 1. q is then off by at most
/// slack + 16 u |f|, two thirds of it along d, where it counts at second order only. Near the
/// surface, and only there it matters, |f| <= |tau| + |q| and |q| <= r + error. So
/// `error` = slack + 24 u (|tau| + r) bounds all of these with room for the squares' and the root's
/// own rounding, 6 u r.
template <class Arch>
struct SphereFilter {
    Vectors<Arch> center;
    Floats<Arch> radius;

    template <class Reader>
    explicit SphereFilter(Reader reader)
        : center(next_vector<Arch>(reader)), radius(reader.next()) {}

    Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> from_center = rays.origin - center;
        const F tau = negated(fast_dot(from_center, rays.direction));
        const Vectors<Arch> foot = fast_mul_add<Arch>(tau, rays.direction, from_center);
        const F foot_squared = fast_dot(foot, foot);
        const F error = fast_mul_add<Arch>(F(24 * half_ulp), xsimd::abs(tau) + radius, rays.slack);

        const F outer = radius + error, inner = radius - error;
        const F outer_chord = outer * outer - foot_squared;
        const F half_chord = xsimd::sqrt(outer_chord);
        const F entry = tau - half_chord - error;
        const Mask<Arch> meets = outer_chord >= zero<Arch>();
        const Mask<Arch> ahead = entry > zero<Arch>();

        Bounds<Arch> result{meets & (tau + half_chord + error > zero<Arch>()),
                            xsimd::select(ahead, entry, zero<Arch>()), none<Arch>(), tau + error};
        const F inner_chord = inner * inner - foot_squared;
        result.certain = ahead & (inner > zero<Arch>()) & (inner_chord > zero<Arch>());

        // Surely inside, it is the exit that counts.
        const Mask<Arch> inside =
            (inner > zero<Arch>()) & (fast_mul_add<Arch>(tau, tau, foot_squared) < inner * inner);
        if (Lanes<Arch>::bits(inside) != 0) [[unlikely]] {
            const F exit = tau + xsimd::sqrt(xsimd::select(inside, inner_chord, zero<Arch>()));
            result.lower = xsimd::select(inside & (exit > error), exit - error, result.lower);
            result.certain = result.certain | inside;
            result.upper = xsimd::select(inside, tau + half_chord + error, result.upper);
        }
        return result;
    }
};

} // namespace raylane::simd
