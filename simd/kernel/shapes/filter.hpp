#pragma once

#include "simd/kernel/shapes/crossings.hpp"
#include "simd/kernel/shapes/shape.hpp"

/// Filters: float arithmetic that cannot be wrong, because it does not say where a ray crosses a
/// shape, but between which bounds. What survives them is solved in double.
///
/// Each filter stands for one kind of shape, is made of a reader (shape.hpp), and
/// has
///   Bounds<Arch> bounds(const FilterRays<Arch>&) const
/// and may have
///   Mask<Arch> may_meet(const FilterRays<Arch>&) const
/// which is true wherever there is a crossing, and
///   Obstacle<Arch> obstacle(const FilterRays<Arch>&, asked, perhaps_before, surely_before) const
/// which is true of the lanes that are asked about, and as sharp as the bounds, for less.
/// The bounds hold whether or not mul_add is fused, and for every ray whose floats are within the
/// stated errors.
///
/// In the derivations u = half_ulp, terms in u^2 go into what constants are rounded up by, and |v|
/// is a vector's length. To be safe from overflow, errors are made of sums that overflow before
/// what they are the errors of does, and each decision is the negation of what is sure: infinite
/// errors and NaN then decide nothing.
namespace raylane::simd {

/// Rays that were rounded to float. The ray meant has a direction of length 1 +- 2^-40 and is
/// within half an ulp of this direction in each component. Its origin is closer to this one than
/// (slack - slack_floor) / (1 + 2^-16), a length: the rest pays for roundings of slack itself and
/// for squares of lengths that underflow.
template <class Arch>
struct FilterRays {
    Vectors<Arch> origin, direction;
    Floats<Arch> slack;
};

inline constexpr float slack_floor = 0x1p-68F;

/// Bounds on a ray's first crossing with one shape, of those with t > 0, per lane. What a caller
/// does not use of them costs nothing.
template <class Arch>
struct Bounds {
    Mask<Arch> possible; ///< false: there is none
    Floats<Arch> lower;  ///< where possible: none is before this; >= 0, finite if there is one
    Mask<Arch> certain;  ///< there is one
    Floats<Arch> upper;  ///< where certain: the first is not behind this
};

/// Any-hit: a shape in the way of rays, per lane.
template <class Arch>
struct Obstacle {
    Mask<Arch> possible; ///< false: it is not
    Mask<Arch> certain;  ///< where possible: it is
};

/// Where lines cross a convex shape, behind the rays' origins, too.
template <class Arch>
struct Chord {
    Floats<Arch> entry, entry_end; ///< the first crossing is between these
    Floats<Arch> exit, exit_end;   ///< and the last between these
};

/// True of filters, and of what they are made of, whose shapes may be packed.
template <class Filter>
constexpr bool of_spheres() {
    if constexpr (requires { Filter::is_of_spheres; })
        return Filter::is_of_spheres;
    else
        return false;
}

/// True of filters that are made of solvers.
template <class Filter>
constexpr bool solves_shapes() {
    return requires {
        Filter::is_solver;
    };
}

/// Obstacle of lanes that are asked about, as bits: whether the shape may be entered before one t,
/// and is before another, which is not later. By the filter's own way, or its bounds.
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

/// True of a filter that can tell for less than its bounds cost that there are none.
template <class Filter, class Rays>
inline constexpr bool has_may_meet = requires(const Filter& filter, const Rays& rays) {
    filter.may_meet(rays);
};

/// True if that is worth it for a packet of rays, a few of which meet the shape as a rule.
template <class Filter, class Rays>
inline constexpr bool sifts_packets = has_may_meet<Filter, Rays>&& requires {
    Filter::is_costly;
};

/// Half an ulp of 1: what one operation is off by, relative to its result.
inline constexpr float half_ulp = 0x1p-24F;

/// More than what some products that underflow are off by together.
inline constexpr float underflow = 0x1p-120F;

/// a * b + c, fused where the processor does it in one instruction.
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

/// a . b + c; off by at most 3 u of the sum of the products' absolute values (and u of c).
template <class Arch>
Floats<Arch> fast_dot(const Vectors<Arch>& a, const Vectors<Arch>& b, const Floats<Arch>& c) {
    return fast_mul_add<Arch>(a.x, b.x,
                              fast_mul_add<Arch>(a.y, b.y, fast_mul_add<Arch>(a.z, b.z, c)));
}

template <class Arch>
Floats<Arch> fast_dot(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return fast_mul_add<Arch>(a.x, b.x, fast_mul_add<Arch>(a.y, b.y, a.z * b.z));
}

/// a x b; each component is off by at most 2 u of its part of absolute_cross(a, b).
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

/// The sums of what a x b has the differences of, plus c. Of length <= 1.155 |a| |b| if c = 0.
template <class Arch>
Vectors<Arch> absolute_cross(const Vectors<Arch>& a, const Vectors<Arch>& b,
                             const Floats<Arch>& c) {
    const Vectors<Arch> p = absolute(a), q = absolute(b);
    return {fast_mul_add<Arch>(p.y, q.z, fast_mul_add<Arch>(p.z, q.y, c)),
            fast_mul_add<Arch>(p.z, q.x, fast_mul_add<Arch>(p.x, q.z, c)),
            fast_mul_add<Arch>(p.x, q.y, fast_mul_add<Arch>(p.y, q.x, c))};
}

/// s |a| + c, component by component.
template <class Arch>
Vectors<Arch> error_of(float s, const Vectors<Arch>& a, const Floats<Arch>& c) {
    return fast_mul_add<Arch>(Floats<Arch>(s), absolute(a), {c, c, c});
}

template <class Arch>
Floats<Arch> sign_bit(const Floats<Arch>& a) {
    return a & Floats<Arch>(-0.0F);
}

/// a > 0 ? a : 0, which is also what NaN becomes.
template <class Arch>
Floats<Arch> positive_part(const Floats<Arch>& a) {
    return select(a > zero<Arch>(), a, zero<Arch>());
}

/// True where the input was numbers. Differences of coordinates, which are at most 1e30, are then
/// numbers as well.
template <class Arch>
Mask<Arch> is_number(const Floats<Arch>& difference) {
    return difference == difference;
}

/// sqrt(a), or up to 2^-9 and 2^-50 more, for a >= 0.
template <class Arch>
Floats<Arch> root_above(const Floats<Arch>& a) {
    const Floats<Arch> positive = a + Floats<Arch>(0x1p-100F);
    return positive * rsqrt(positive) * Floats<Arch>(1 + 0x1p-10F);
}

} // namespace raylane::simd
