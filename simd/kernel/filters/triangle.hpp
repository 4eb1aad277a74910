#pragma once

#include "simd/kernel/filters/plane.hpp"

namespace raylane::simd {

/// With edges e = b - a, g = c - a, normal n = e x g and s = a - origin, the point a + v e + w g is
/// met at t if t d = s + v e + w g, so that (Moeller and Trumbore, "Fast, Minimum Storage
/// Ray/Triangle Intersection", 1997)
///   t (n . d) = n . s,  v (n . d) = g . (s x d),  w (n . d) = -e . (s x d).
///
/// n is off by 4 u of absolute_cross(e, g), so n . s and n . d by 8 u of the sum of the absolute
/// products. s x d is off by 4 u of absolute_cross(s, d), its products with edges by 8 u; moving
/// the origin by slack moves them by slack |edge| or less. 11 u instead of 8 u pay for the sum that
/// 1 - v - w is, too.
template <class Arch>
struct TriangleFilter {
    Vectors<Arch> a, edge_e, edge_g, normal, normal_size;

    template <class Reader>
    explicit TriangleFilter(Reader reader) : a(next_vector<Arch>(reader)) {
        edge_e = next_vector<Arch>(reader) - a;
        edge_g = next_vector<Arch>(reader) - a;
        normal = fast_cross(edge_e, edge_g);
        normal_size = absolute_cross(edge_e, edge_g, Floats<Arch>(underflow));
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F tiny(underflow);
        const Vectors<Arch> to_a = a - rays.origin;
        const F relative(11 * half_ulp);
        const F height = fast_dot(normal, to_a);
        const F height_error = fast_mul_add<Arch>(
            relative, fast_dot(normal_size, absolute(to_a)),
            fast_mul_add<Arch>(normal_size.x + normal_size.y + normal_size.z, rays.slack, tiny));
        const F approach = fast_dot(normal, rays.direction);
        const F approach_error =
            fast_mul_add<Arch>(relative, fast_dot(normal_size, absolute(rays.direction)), tiny);
        const FlatCrossing<Arch> crossing(height, height_error, approach, approach_error);

        // v, w and 1 - v - w, times |approach|.
        const Vectors<Arch> moment = fast_cross(to_a, rays.direction);
        const Vectors<Arch> moment_size = absolute_cross(to_a, rays.direction, zero<Arch>());
        const auto error_along = [&](const Vectors<Arch>& edge) __attribute__((always_inline)) {
            const Vectors<Arch> e = absolute(edge);
            return fast_mul_add<Arch>(relative, fast_dot(e, moment_size),
                                      fast_mul_add<Arch>(e.x + e.y + e.z, rays.slack, tiny));
        };
        const F flip = sign_bit<Arch>(approach);
        const F v = fast_dot(edge_g, moment) ^ flip;
        const F w = negated(fast_dot(edge_e, moment)) ^ flip;
        const F v_error = error_along(edge_g);
        const F w_error = error_along(edge_e);
        const F steepness = abs(approach);
        const F beyond = (v + w) - steepness;
        const F beyond_error = v_error + w_error + approach_error;

        const Mask<Arch> faces = steepness > approach_error;
        const Mask<Arch> outside =
            faces & ((v < negated(v_error)) | (w < negated(w_error)) | (beyond > beyond_error));
        const Mask<Arch> inside = (v > v_error) & (w > w_error) & (beyond < negated(beyond_error));
        return {is_number<Arch>(to_a.x) & ~crossing.behind & ~outside,
                positive_part<Arch>(crossing.lower), crossing.ahead & inside, crossing.upper};
    }
};

} // namespace raylane::simd
