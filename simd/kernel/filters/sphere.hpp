#pragma once

#include "simd/kernel/filters/filter.hpp"

namespace raylane::simd {

/// With f = origin - center, tau = -f . d and q = f + tau d (the foot of the perpendicular), a ray
/// with unit d crosses at tau -+ sqrt(r^2 - q^2).
///
/// The point that the floats mean at t is within e = slack + u |f| + u t of the true one: at a
/// crossing, |f + t d| = r -+ e. As a polynomial in t - tau this is Q + 2 b (t - tau) +
/// |d|^2 (t - tau)^2, where sqrt(Q) is within u (|tau| + |q|) of |q|, |b| <= 3 u |f| + 2 u |tau|
/// for the rounding of tau and for |d|^2 = 1 -+ 2 u. Here |f| <= |tau| + |q|, t <= |tau| + r and,
/// where it matters, |q| <= r. So, with room for the rounding of the squares,
///   (r -+ e)^2 - Q + b^2 is within (r -+ E)^2 - q^2 for E = slack + u (6 |tau| + 7 r),
/// and tau -+ sqrt() is then off by |b| + u (2 |tau| + 4 r) < u (7 |tau| + 8 r).
template <class Arch>
struct SphereFilter {
    Vectors<Arch> center;
    Floats<Arch> radius;

    template <class Reader>
    explicit SphereFilter(Reader reader)
        : center(next_vector<Arch>(reader)), radius(reader.next()) {}

    /// Whether a ray may meet the sphere, for less than its bounds.
    [[gnu::always_inline]] Mask<Arch> may_meet(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> from_center = rays.origin - center;
        const F behind = fast_dot(from_center, rays.direction); // the ray's origin, of the foot
        const Vectors<Arch> foot = fast_mul_add<Arch>(negated(behind), rays.direction, from_center);
        const F outer = radius * F(1 + 12 * half_ulp) +
                        fast_mul_add<Arch>(F(12 * half_ulp), abs(behind), rays.slack);
        // A ray that has its foot behind it starts inside, if it meets the sphere at all: its
        // distance from the centre, and so `behind`, is r + slack at most, and 6 u r for rounding.
        // What overflows proves nothing.
        const Mask<Arch> missed = (outer * outer < fast_dot(foot, foot)) | (outer < behind);
        return is_number<Arch>(from_center.x) & ~missed;
    }

    /// Without a root, unless what is left in doubt is asked about: a ray that starts more than a
    /// radius before its foot enters behind its start and before the foot, if it meets the sphere.
    [[gnu::always_inline]] Obstacle<Arch> obstacle(const FilterRays<Arch>& rays,
                                                   std::uint32_t asked,
                                                   const Floats<Arch>& perhaps_before,
                                                   const Floats<Arch>& surely_before) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const auto [there, tau, foot_squared, rounding, outer, inner] = near(rays);
        const F first = tau - outer - rounding;
        const Mask<Arch> missed = (outer * outer < foot_squared) | (tau + outer + rounding < o) |
                                  (first >= perhaps_before);
        const Mask<Arch> possible = there & ~missed;
        const Mask<Arch> certain = (inner > o) & (inner * inner > foot_squared) & (first > o) &
                                   (tau + rounding < surely_before);
        if ((Lanes<Arch>::bits(possible & ~certain) & asked) == 0) return {possible, certain};
        const Bounds<Arch> all = bounds(rays);
        return {all.possible & (all.lower < perhaps_before),
                all.certain & (all.upper < surely_before)};
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const auto [there, tau, foot_squared, rounding, outer, inner] = near(rays);
        const F outer_chord = outer * outer - foot_squared; // not fused: both overflow, or none
        const F outer_half = sqrt(outer_chord);
        const F entry = tau - outer_half - rounding;
        const F exit = tau + outer_half + rounding;
        const Mask<Arch> missed = (outer_chord < o) | (exit < o);

        const F inner_chord = inner * inner - foot_squared;
        const F inner_half = sqrt(inner_chord);
        const Mask<Arch> meets = (inner > o) & (inner_chord > o), ahead = entry > o;
        Bounds<Arch> result{there & ~missed, positive_part<Arch>(entry), meets & ahead,
                            tau - inner_half + rounding};

        // Surely inside, it is the exit that counts.
        const Mask<Arch> inside =
            (inner > o) & (fast_mul_add<Arch>(tau, tau, foot_squared) < inner * inner);
        if (Lanes<Arch>::bits(inside) != 0) [[unlikely]] {
            const F least = tau + inner_half - rounding;
            // The chord of a huge sphere overflows.
            const Mask<Arch> known = (least > o) & (least < F(__builtin_inff()));
            result.lower = select(inside, select(known, least, o), result.lower);
            result.certain = result.certain | inside;
            result.upper = select(inside, exit, result.upper);
        }
        return result;
    }

  private:
    /// A ray next to the centre.
    struct Near {
        Mask<Arch> there;               ///< the sphere is
        Floats<Arch> tau, foot_squared; ///< t of the foot, and q^2
        Floats<Arch> rounding;          ///< of t
        Floats<Arch> outer, inner;      ///< the radius and E more, or less
    };

    [[gnu::always_inline]] Near near(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> from_center = rays.origin - center;
        const F tau = negated(fast_dot(from_center, rays.direction));
        const Vectors<Arch> foot = fast_mul_add<Arch>(tau, rays.direction, from_center);
        const F foot_squared = fast_dot(foot, foot);
        const F rounding = F(10 * half_ulp) * (abs(tau) + radius);
        const F error = rounding + rays.slack;
        const F outer = radius + error, inner = radius - error;
        return {is_number<Arch>(from_center.x), tau, foot_squared, rounding, outer, inner};
    }
};

} // namespace raylane::simd
