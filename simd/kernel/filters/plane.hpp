#pragma once

#include "simd/kernel/filters/filter.hpp"

namespace raylane::simd {

/// What bounds t = height / approach for height = n . (p - origin) and approach = n . d.
///
/// Each is a sum of three products: off by at most 4 u of the sum of their absolute values, by u
/// more for the rounded difference or direction, and the height by |n| slack. 8 u leaves room for
/// the rounding of these bounds.
template <class Arch>
struct FlatBounds {
    Floats<Arch> height, height_error, approach, approach_error;

    FlatBounds(const Vectors<Arch>& to_point, const Vectors<Arch>& normal,
               const FilterRays<Arch>& rays) {
        using F = Floats<Arch>;
        const F reach = xsimd::abs(normal.x) + xsimd::abs(normal.y) + xsimd::abs(normal.z);
        height = fast_dot(normal, to_point);
        height_error =
            fast_mul_add<Arch>(F(8 * half_ulp), absolute_dot(normal, to_point), reach * rays.slack);
        approach = fast_dot(normal, rays.direction);
        approach_error = F(8 * half_ulp) * absolute_dot(normal, rays.direction);
    }

    Bounds<Arch> bounds() const {
        using F = Floats<Arch>;
        const F height_size = xsimd::abs(height), approach_size = xsimd::abs(approach);
        const Mask<Arch> sure = (height_size > height_error) & (approach_size > approach_error);
        const Mask<Arch> behind = (height > zero<Arch>()) ^ (approach > zero<Arch>());
        const F least = (height_size - height_error) / (approach_size + approach_error);
        const F most = (height_size + height_error) / (approach_size - approach_error);
        // Empty lanes hold NaN.
        return {(height_size >= zero<Arch>()) & ~(sure & behind),
                xsimd::select(least > zero<Arch>(), least * F(1 - 4 * half_ulp), zero<Arch>()),
                sure & ~behind, most * F(1 + 4 * half_ulp)};
    }
};

template <class Arch>
struct PlaneFilter {
    Vectors<Arch> point, normal;

    template <class Reader>
    explicit PlaneFilter(Reader reader)
        : point(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)) {}

    Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        return FlatBounds<Arch>(point - rays.origin, normal, rays).bounds();
    }
};

} // namespace raylane::simd
