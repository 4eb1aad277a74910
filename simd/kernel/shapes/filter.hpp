#pragma once

#include "simd/kernel/shapes/crossings.hpp"
#include "simd/kernel/shapes/shape.hpp"

/// Filters bound a ray's crossing with a shape in float arithmetic. They cannot be wrong, because
/// they return bounds on the crossing, not the crossing itself. Shapes that a filter cannot rule
/// out are solved in double.
///
/// Each filter serves one kind of shape and is constructed from a reader (shape.hpp). It has
///   Bounds<Arch> bounds(const FilterRays<Arch>&) const
/// It may also have
///   Mask<Arch> may_meet(const FilterRays<Arch>&) const
/// which is true wherever there is a crossing, and
///   Obstacle<Arch> obstacle(const FilterRays<Arch>&, asked, perhaps_before, surely_before) const
/// which holds for the lanes in `asked` and is as sharp as the bounds at less cost. The bounds hold
/// whether or not mul_add is fused, and for every ray whose floats are within the stated errors.
///
/// In the derivations u = half_ulp and |v| is a vector's length. The constants are rounded up to
/// cover terms in u^2. To be safe from overflow, errors are computed from sums that overflow before
/// the values that they belong to. Each decision is the negation of a proved statement, so infinite
/// errors and NaN decide nothing.
namespace raylane::simd {

/// Rays that were rounded to float. The exact ray has a direction of length 1 +- 2^-40, which is
/// within half an ulp of this direction in each component. The distance of its origin from this one
/// is less than (slack - slack_floor) / (1 + 2^-16). The rest of slack covers the roundings of
/// slack itself and squares of lengths that underflow.
template <class Arch>
struct FilterRays {
    Vectors<Arch> origin, direction;
    Floats<Arch> slack;
};

/// Bounds on a ray's first crossing with one shape at t > 0, per lane. A member that the caller
/// does not use costs nothing.
template <class Arch>
struct Bounds {
    Mask<Arch> possible; ///< false: no crossing exists
    Floats<Arch> lower;  ///< where possible: t >= lower >= 0; finite if there is a crossing
    Mask<Arch> certain;  ///< there is a crossing
    Floats<Arch> upper;  ///< where certain: t of the first crossing <= upper
};

/// A shape that may block a ray (any-hit query), per lane.
template <class Arch>
struct Obstacle {
    Mask<Arch> possible; ///< false: it does not block
    Mask<Arch> certain;  ///< where possible: it blocks
};

/// Bounds on where lines cross a convex shape. Crossings behind a ray's origin count, too.
template <class Arch>
struct Chord {
    Floats<Arch> entry, entry_end; ///< the first crossing is between these
    Floats<Arch> exit, exit_end;   ///< the last crossing is between these
};

/// True for filters, and for the shape numbers they read, whose shapes may be packed.
template <class Filter>
constexpr bool of_spheres() {
    if constexpr (requires { Filter::is_of_spheres; })
        return Filter::is_of_spheres;
    else
        return false;
}

/// True for filters that use solvers.
template <class Filter>
constexpr bool solves_shapes() {
    return requires {
        Filter::is_solver;
    };
}

/// Returns the obstacle of the lanes in `asked` (bits): whether the shape may be crossed before
/// `perhaps_before`, and whether it is certainly crossed before `surely_before`, which is not
/// later. Uses the filter's obstacle() if it has one, otherwise its bounds.
template <class Arch, class Filter, class Rays>
[[gnu::always_inline]] inline Obstacle<Arch>
obstacle_of(const Filter& filter, const Rays& rays, std::uint32_t asked,
            const Floats<Arch>& perhaps_before, const Floats<Arch>& surely_before) {
    if constexpr (requires { filter.obstacle(rays, asked, perhaps_before, surely_before); }) {
        return filter.obstacle(rays, asked, perhaps_before, surely_before);
    } else {
        const Bounds<Arch> bounds = filter.bounds(rays);
        return {bounds.possible & (bounds.lower < perhaps_before),
                bounds.certain & (bounds.upper < surely_before)};
    }
}

/// True for a filter that has may_meet(), which rules out crossings at less cost than bounds().
template <class Filter, class Rays>
inline constexpr bool has_may_meet = requires(const Filter& filter, const Rays& rays) {
    filter.may_meet(rays);
};

/// True if calling may_meet() first pays for a packet of rays, of which usually a few meet the
/// shape.
template <class Filter, class Rays>
inline constexpr bool sifts_packets = has_may_meet<Filter, Rays>&& requires {
    Filter::is_costly;
};

/// Half an ulp of 1: the relative error of one operation.
inline constexpr float half_ulp = 0x1p-24F;

/// More than the total error of a few products that underflow.
inline constexpr float underflow = 0x1p-120F;

/// Returns a * b + c, fused where the processor has one instruction for it.
template <class Arch>
Floats<Arch> fast_mul_add(const Floats<Arch>& a, const Floats<Arch>& b, const Floats<Arch>& c) {
    if constexpr (Lanes<Arch>::has_mul_add)
        return Lanes<Arch>::mul_add(a, b, c);
    else
        return a * b + c;
}

template <class Arch>
Vectors<Arch> fast_mul_add(const Floats<Arch>& s, const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {fast_mul_add<Arch>(s, a.x, b.x), fast_mul_add<Arch>(s, a.y, b.y),
            fast_mul_add<Arch>(s, a.z, b.z)};
}

/// Returns a . b + c; off by at most 4 u of the sum of the products' sizes, plus 3 u of |c|.
template <class Arch>
Floats<Arch> fast_dot(const Vectors<Arch>& a, const Vectors<Arch>& b, const Floats<Arch>& c) {
    return fast_mul_add<Arch>(a.x, b.x,
                              fast_mul_add<Arch>(a.y, b.y, fast_mul_add<Arch>(a.z, b.z, c)));
}

/// Returns a . b; off by at most 3 u of the sum of the products' sizes.
template <class Arch>
Floats<Arch> fast_dot(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return fast_mul_add<Arch>(a.x, b.x, fast_mul_add<Arch>(a.y, b.y, a.z * b.z));
}

/// Returns a x b. The error of each component is at most 2 u of that component of absolute_cross(a,
/// b).
template <class Arch>
Vectors<Arch> fast_cross(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {fast_mul_add<Arch>(a.y, b.z, negated(a.z * b.y)),
            fast_mul_add<Arch>(a.z, b.x, negated(a.x * b.z)),
            fast_mul_add<Arch>(a.x, b.y, negated(a.y * b.x))};
}

template <class Arch>
Vectors<Arch> absolute(const Vectors<Arch>& a) {
    return {abs(a.x), abs(a.y), abs(a.z)};
}

/// Returns a x b with sums of absolute products in place of differences, plus c. Its length
/// is <= 1.155 |a| |b| if c = 0.
template <class Arch>
Vectors<Arch> absolute_cross(const Vectors<Arch>& a, const Vectors<Arch>& b,
                             const Floats<Arch>& c) {
    const Vectors<Arch> p = absolute(a), q = absolute(b);
    return {fast_mul_add<Arch>(p.y, q.z, fast_mul_add<Arch>(p.z, q.y, c)),
            fast_mul_add<Arch>(p.z, q.x, fast_mul_add<Arch>(p.x, q.z, c)),
            fast_mul_add<Arch>(p.x, q.y, fast_mul_add<Arch>(p.y, q.x, c))};
}

/// Returns s |a| + c for each component.
template <class Arch>
Vectors<Arch> error_of(float s, const Vectors<Arch>& a, const Floats<Arch>& c) {
    return fast_mul_add<Arch>(Floats<Arch>(s), absolute(a), {c, c, c});
}

template <class Arch>
Floats<Arch> sign_bit(const Floats<Arch>& a) {
    return a & Floats<Arch>(-0.0F);
}

/// Returns a if a > 0, otherwise 0. Returns 0 for NaN.
template <class Arch>
Floats<Arch> positive_part(const Floats<Arch>& a) {
    return select(a > zero<Arch>(), a, zero<Arch>());
}

/// True where `difference` is not NaN. Coordinates are at most 1e30, so the difference of two
/// numbers is a number.
template <class Arch>
Mask<Arch> is_number(const Floats<Arch>& difference) {
    return difference == difference;
}

/// Returns an upper bound of sqrt(a) for a >= 0, at most 2^-9 (relative) and 2^-50 (absolute) above
/// it.
template <class Arch>
Floats<Arch> root_above(const Floats<Arch>& a) {
    const Floats<Arch> positive = a + Floats<Arch>(0x1p-100F);
    return positive * rsqrt(positive) * Floats<Arch>(1 + 0x1p-10F);
}

} // namespace raylane::simd
