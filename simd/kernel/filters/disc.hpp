#pragma once

#include "simd/kernel/filters/plane.hpp"

namespace raylane::simd {

/// The ray meets the plane within spread + 6 u |t| of t. The point at t is then off by as much, by
/// slack + u |f| for f = origin - center, by u |t| for the direction and by u (|t| + distance) for
/// its own rounding, where |f| <= |t| + distance. Squaring and comparing adds 4 u of the radius,
/// near which alone it matters: 9 u |t| and 6 u radius.
template <class Arch>
struct DiscFilter {
    Vectors<Arch> center, normal;
    Floats<Arch> radius;

    template <class Reader>
    explicit DiscFilter(Reader reader)
        : center(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)),
          radius(reader.next()) {}

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> to_center = center - rays.origin;
        const FlatCrossing<Arch> crossing = cross_plane(to_center, normal, rays);
        const Vectors<Arch> point = fast_mul_add<Arch>(crossing.t, rays.direction, -to_center);
        const F distance_squared = fast_dot(point, point);
        const F error = fast_mul_add<Arch>(F(12 * half_ulp), abs(crossing.t) + radius,
                                           rays.slack + crossing.spread);
        const F outer = radius + error, inner = radius - error;
        const Mask<Arch> outside = crossing.clear & (distance_squared > outer * outer);
        const Mask<Arch> inside = (inner > zero<Arch>()) & (distance_squared < inner * inner);
        return {is_number<Arch>(to_center.x) & ~crossing.behind & ~outside,
                positive_part<Arch>(crossing.lower), crossing.ahead & inside, crossing.upper};
    }
};

} // namespace raylane::simd
