#pragma once

#include "simd/kernel/filters/slab.hpp"

namespace raylane::simd {

/// Three slabs |n . f - volume / 2| <= |volume| / 2 for f = origin - corner, the normals n = v x w,
/// w x u, u x v and volume = n . u.
///
/// A normal is off by 2 u of absolute_cross(), n . f by 6 u of the sum of the absolute products,
/// half the volume by 5 u of its own, twice: in the position and in the width. What cross_slab()
/// wants paid for and the sum's rounding add 3 u of n . f and 5 u of half the volume. n . d is off
/// by 6 u. Sums are doubled, or taken eightfold, to overflow in time.
template <class Arch>
struct BoxFilter {
    Vectors<Arch> corner;
    Vectors<Arch> normals[3], normal_sizes[3];
    Floats<Arch> middle, middle_error;

    template <class Reader>
    explicit BoxFilter(Reader reader) : corner(next_vector<Arch>(reader)) {
        const Floats<Arch> tiny(underflow);
        const Vectors<Arch> u = next_vector<Arch>(reader), v = next_vector<Arch>(reader),
                            w = next_vector<Arch>(reader);
        normals[0] = fast_cross(v, w);
        normals[1] = fast_cross(w, u);
        normals[2] = fast_cross(u, v);
        normal_sizes[0] = absolute_cross(v, w, tiny);
        normal_sizes[1] = absolute_cross(w, u, tiny);
        normal_sizes[2] = absolute_cross(u, v, tiny);
        middle = Floats<Arch>(0.5F) * fast_dot(normals[0], u);
        const Floats<Arch> size = fast_dot(normal_sizes[0], absolute(u));
        middle_error =
            fast_mul_add<Arch>(Floats<Arch>(0.75F * half_ulp), Floats<Arch>(8.0F) * size, tiny);
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const Vectors<Arch> from_corner = rays.origin - corner;
        const Vectors<Arch> doubled = absolute(from_corner + from_corner),
                            d = absolute(rays.direction);
        const F middle_size = abs(middle);
        const auto stay_between = [&](int i) __attribute__((always_inline)) {
            const Vectors<Arch>& size = normal_sizes[i];
            const F error = fast_mul_add<Arch>(
                F(5 * half_ulp), fast_dot(size, doubled, middle_size),
                fast_mul_add<Arch>(size.x + size.y + size.z, rays.slack, middle_error));
            const F slope_error =
                fast_mul_add<Arch>(F(7 * half_ulp), fast_dot(size, d), F(underflow));
            return cross_slab<Arch>(fast_dot(normals[i], from_corner) - middle, middle_size, error,
                                    fast_dot(normals[i], rays.direction), slope_error);
        };
        const Stay<Arch> stay = stay_between(0) & stay_between(1) & stay_between(2);
        const F lower = positive_part<Arch>(stay.in_low);
        const Mask<Arch> outside = stay.in_low > o;
        return {is_number<Arch>(from_corner.x) & ~(stay.out_high < lower),
                select(stay.inside, positive_part<Arch>(stay.out_low), lower),
                stay.definite & (stay.in_high <= stay.out_low) & (stay.out_low > o),
                select(outside, stay.in_high, stay.out_high)};
    }
};

} // namespace raylane::simd
