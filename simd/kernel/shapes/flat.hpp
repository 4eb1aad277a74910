#pragma once

#include "simd/kernel/shapes/certified_solver.hpp"
#include "simd/kernel/shapes/filter.hpp"

/// Shared parts of flat shapes.
namespace raylane::simd {

/// t = height / approach for height = n . (p - origin) and approach = n . d, which are given with
/// their errors.
template <class Arch>
struct FlatCrossing {
    Floats<Arch> t;      ///< an approximation, of either sign
    Floats<Arch> spread; ///< where clear: the error of t, beyond 6 u |t|
    Floats<Arch> lower;  ///< a crossing with t > 0 has t >= lower; may be < 0
    Floats<Arch> upper;  ///< where ahead: the crossing has t <= upper
    Mask<Arch> clear;    ///< the ray is not nearly parallel
    Mask<Arch> ahead;    ///< clear, and the plane is certainly in front
    Mask<Arch> behind;   ///< the plane is certainly not in front

    /// Computes the bounds of the crossing. With a = |approach|, h = |height| and their errors f
    /// and e, the true values h' = h +- e and a' = a +- f satisfy
    ///   (h - e) / (a + f) <= h' / a' <= (h + e) / (a - f).
    /// One division serves both bounds, since (a + f) / (a - f) = 1 / (1 - x) <= 1 + 2 x
    /// for x = 2 f / (a + f) <= 1/2.
    [[gnu::always_inline]] FlatCrossing(const Floats<Arch>& height,
                                        const Floats<Arch>& height_error,
                                        const Floats<Arch>& approach,
                                        const Floats<Arch>& approach_error) {
        using F = Floats<Arch>;
        const F one(1.0F);
        const F signed_height = height ^ sign_bit<Arch>(approach);
        const F h = abs(height), a = abs(approach);
        const F inverse = one / (a + approach_error);
        const F stretch = F(4.0F) * approach_error * inverse;
        t = signed_height * inverse;
        lower = (h - height_error) * (inverse * F(1 - 4 * half_ulp));
        upper = (h + height_error) *
                (inverse * fast_mul_add<Arch>(stretch, F(1 + 8 * half_ulp), F(1 + 8 * half_ulp)));
        spread = upper - abs(t);
        clear = stretch <= one;
        ahead = clear & (signed_height > height_error);
        behind = (a > approach_error) & (negated(signed_height) > height_error);
    }
};

/// Returns the crossing with a plane. height and approach are sums of three products. They are off
/// by 3 u of the sum of the products' absolute values, by another u for the rounded difference or
/// direction, and by another if the normal was rounded. height is also off by |n| slack.
template <class Arch>
[[gnu::always_inline]] inline FlatCrossing<Arch> cross_plane(const Vectors<Arch>& to_point,
                                                             const Vectors<Arch>& normal,
                                                             const FilterRays<Arch>& rays) {
    using F = Floats<Arch>;
    const Vectors<Arch> n = absolute(normal);
    const F relative(6 * half_ulp), reach = n.x + n.y + n.z;
    const F min_error = fast_mul_add<Arch>(F(underflow), reach, F(underflow));
    const F height_error = fast_mul_add<Arch>(relative, fast_dot(n, absolute(to_point)),
                                              fast_mul_add<Arch>(reach, rays.slack, min_error));
    const F approach_error =
        fast_mul_add<Arch>(relative, fast_dot(n, absolute(rays.direction)), min_error);
    return {fast_dot(normal, to_point), height_error, fast_dot(normal, rays.direction),
            approach_error};
}

template <class Arch>
Crossing<Arch> cross_plane(const Vectors<Arch>& to_point, const Vectors<Arch>& normal,
                           const Vectors<Arch>& direction) {
    const Floats<Arch> approach = dot(normal, direction);
    const Mask<Arch> falls = approach < zero<Arch>();
    return {falls | (approach > zero<Arch>()), dot(normal, to_point) / approach, zero<Arch>(),
            falls};
}

template <class Arch>
Crossings<Arch> only(const Crossing<Arch>& crossing) {
    return {{crossing.exists, crossing.t, crossing.face, crossing.entering},
            {none<Arch>(), zero<Arch>(), zero<Arch>(), none<Arch>()}};
}

/// Returns the result for a flat shape. A ray that starts on it does not meet it again. `passed`:
/// lanes whose line certainly does not cross the shape, for example because they are parallel.
/// `clear`: lanes where t is known, so that the shape may be proved to be behind the ray.
template <Wanted wanted, class Arch>
CertifiedCrossing<Arch> solve_flat(const Mask<Arch>& clear, const Mask<Arch>& inside,
                                   const Mask<Arch>& passed, const Floats<Arch>& t,
                                   const Floats<Arch>& error, const Floats<Arch>& approach,
                                   const Vectors<Arch>& unit_normal, const Starts<Arch>& starts) {
    CertifiedCrossing<Arch> result = {clear & inside & ~starts.on_surface &
                                          is_result<Arch>(t, error),
                                      t,
                                      error,
                                      zero<Arch>(),
                                      approach < zero<Arch>(),
                                      unit_normal};
    if constexpr (wanted == Wanted::all) {
        result.misses = (clear & (t < negated(error))) | passed;
        result.normal_error = error_of_unit<Arch>(unit_normal);
    }
    return result;
}

} // namespace raylane::simd
