#pragma once

#include "simd/kernel/lanes/doubles.hpp"
#include "simd/kernel/shapes/crossings.hpp"
#include "simd/kernel/shapes/shape.hpp"

/// Certified solvers compute the first crossing of a ray with a shape in double, with a bound on
/// the error of t, and whether the crossing is certain. Uncertain crossings are rare. A scalar
/// solver decides them, which can repeat the computation in a wider type. So certified solvers do
/// not resolve hard cases; they only prove that a case is not hard. A lane is certain if some
/// sufficient condition holds.
///
/// Each certified solver serves one kind of shape, is constructed from a reader of doubles, and has
///   CertifiedCrossing<Arch> solve<wanted>(const Rays<Arch>&, const Starts<Arch>&) const
/// Arch is a Double<...> throughout.
///
/// In the comments u = 2^-53 is the relative error of one operation. Rays and shapes are exact, and
/// directions have a length of 1 +- 2^-48. Powers of two that exceed the value that they bound
/// leave a margin for the rounding of the bounds themselves. Comparisons are such that NaN is not
/// certain. Underflow is excluded, as in core/numbers/bounded.hpp.
namespace raylane::simd {

/// Results that the caller of a certified solver needs.
enum class Wanted {
    crossings, ///< certain crossings
    all,       ///< also certain misses, and the error of normals
};

/// The first crossing per lane, counted in the same way as by core::Searcher.
template <class Arch>
struct CertifiedCrossing {
    Mask<Arch> certain; ///< if false, only `misses` is meaningful
    Floats<Arch> t;
    Floats<Arch> error; ///< |t - true t|
    Floats<Arch> face;
    Mask<Arch> entering;
    Vectors<Arch> normal;             ///< unit, outward, within 2^-12
    Mask<Arch> misses = none<Arch>(); ///< where not certain: certainly no crossing
    /// |normal - true normal| per component, with Wanted::all. It is 0 where no rounding occurs.
    Vectors<Arch> normal_error = {zero<Arch>(), zero<Arch>(), zero<Arch>()};
};

/// True where all numbers within `error` of `value` round to the same float.
template <class Arch>
Mask<Arch> round_alike(const Floats<Arch>& value, const Floats<Arch>& error) {
    return Lanes<Arch>::round_alike(value - error, value + error);
}
/// True where, for each component of the normal, all numbers within the error of that component
/// round to the same float.
template <class Arch>
Mask<Arch> is_rounded(const CertifiedCrossing<Arch>& crossing) {
    return round_alike<Arch>(crossing.normal.x, crossing.normal_error.x) &
           round_alike<Arch>(crossing.normal.y, crossing.normal_error.y) &
           round_alike<Arch>(crossing.normal.z, crossing.normal_error.z);
}

/// The relative accuracy that t must have, same as core::needed_accuracy.
inline constexpr double needed_accuracy = 0x1p-27;

/// Returns a where `mask` is true, otherwise b.
template <class Arch>
[[gnu::always_inline]] inline CertifiedCrossing<Arch>
select(const Mask<Arch>& mask, const CertifiedCrossing<Arch>& a, const CertifiedCrossing<Arch>& b) {
    return {(mask & a.certain) | (~mask & b.certain),
            select(mask, a.t, b.t),
            select(mask, a.error, b.error),
            select(mask, a.face, b.face),
            (mask & a.entering) | (~mask & b.entering),
            select(mask, a.normal, b.normal),
            (mask & a.misses) | (~mask & b.misses),
            select(mask, a.normal_error, b.normal_error)};
}

/// True where t is accurate enough and ahead of the ray.
template <class Arch>
Mask<Arch> is_result(const Floats<Arch>& t, const Floats<Arch>& error) {
    return error < Floats<Arch>(needed_accuracy) * t;
}

/// Returns |x| + |y| + |z|, which is between |v| and 1.74 |v|.
template <class Arch>
Floats<Arch> sum_of_sizes(const Vectors<Arch>& v) {
    return abs(v.x) + abs(v.y) + abs(v.z);
}

/// True where the point at t, computed in double, is off by no more than one float ulp of its
/// largest coordinate. `error` is the error of t.
template <class Arch>
[[gnu::always_inline]] inline Mask<Arch> holds_point(const Rays<Arch>& rays, const Floats<Arch>& t,
                                                     const Floats<Arch>& error) {
    using F = Floats<Arch>;
    const Vectors<Arch> point = mul_add<Arch>(t, rays.direction, rays.origin);
    const F largest = max(max(abs(point.x), abs(point.y)), abs(point.z));
    return error + F(0x1p-51) * t <= F(0x1p-24) * largest;
}

/// Returns the error of a unit vector made from an exact vector. It is the error of bringing the
/// vector to length 1.
template <class Arch>
[[gnu::always_inline]] inline Vectors<Arch> error_of_unit(const Vectors<Arch>& unit) {
    const Floats<Arch> roundings(0x1p-50);
    return {roundings * abs(unit.x), roundings * abs(unit.y), roundings * abs(unit.z)};
}

/// Returns the error of a unit vector made from a vector of length 1 / inverse that is off by
/// `error`. Each component is off by its own error and by the error of the length, to which all
/// components contribute. (If the length's error is not small, the result is not small either.)
template <class Arch>
[[gnu::always_inline]] inline Vectors<Arch>
error_of_unit(const Vectors<Arch>& unit, const Vectors<Arch>& error, const Floats<Arch>& inverse) {
    using F = Floats<Arch>;
    const F own = F(1.0625) * inverse;
    const F common = own * (error.x + error.y + error.z) + F(0x1p-50);
    return {own * error.x + common * abs(unit.x), own * error.y + common * abs(unit.y),
            own * error.z + common * abs(unit.z)};
}

/// Returns the error of `product`, which is a x b of exact vectors. If their components are floats,
/// only the last rounding contributes.
template <class Arch>
[[gnu::always_inline]] inline Vectors<Arch>
error_of_cross(const Vectors<Arch>& a, const Vectors<Arch>& b, const Vectors<Arch>& product) {
    using F = Floats<Arch>;
    const auto lost = [](const F& p, const F& q) {
        return abs(Lanes<Arch>::product_error(p, q, p * q));
    };
    const auto component = [&](const F& p, const F& q, const F& r, const F& s,
                               const F& coordinate) {
        return F(1.0 + 0x1p-50) * (lost(p, q) + lost(r, s)) + F(0x1p-53) * abs(coordinate);
    };
    return {component(a.y, b.z, a.z, b.y, product.x), component(a.z, b.x, a.x, b.z, product.y),
            component(a.x, b.y, a.y, b.x, product.z)};
}

template <class Arch>
bool any(const Mask<Arch>& mask) {
    return Lanes<Arch>::bits(mask) != 0;
}

/// Returns v with all components negated in lanes of `mask`.
template <class Arch>
Vectors<Arch> negated_where(const Mask<Arch>& mask, const Vectors<Arch>& v) {
    const Floats<Arch> sign = select(mask, Floats<Arch>(-0.0), zero<Arch>());
    return {v.x ^ sign, v.y ^ sign, v.z ^ sign};
}

/// True where each term of a . b has a factor 0. Then a . b is exactly 0, with or without rounding.
template <class Arch>
Mask<Arch> have_no_product(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    const Floats<Arch> o = zero<Arch>();
    return ((a.x == o) | (b.x == o)) & ((a.y == o) | (b.y == o)) & ((a.z == o) | (b.z == o));
}

/// A ray relative to a point of its shape (`anchor`). The ray is moved along itself to where it is
/// closest to that point, so all further computation happens at the scale of the shape. The
/// distance of the ray's origin shows in `error` alone.
///   t = shift + s,  point(t) = anchor + start + s * direction
template <class Arch>
struct LocalRays {
    Vectors<Arch> direction;
    Floats<Arch> shift;  ///< exact, as any number is a valid shift
    Vectors<Arch> start; ///< within `error` of the true one
    Floats<Arch> size;   ///< >= |start|
    Floats<Arch> error;

    LocalRays(const Rays<Arch>& rays, const Vectors<Arch>& anchor) : direction(rays.direction) {
        const Vectors<Arch> from_anchor = rays.origin - anchor;
        shift = negated(dot(from_anchor, direction));
        start = mul_add<Arch>(shift, direction, from_anchor);
        size = sum_of_sizes(start);
        // The roundings of from_anchor, shift * direction and start contribute at most
        //   u * (|from_anchor| + |shift| * |direction| + |start|).
        // |from_anchor| is at most |shift| * |direction| + |start|, and |direction| is about 1. So
        // this is at most 2 * u * (|shift| + |start|). As much again covers a direction that is off
        // by the rounding of its normalisation. The constant 2^-50 = 8 * u is twice the sum of
        // both.
        error = Floats<Arch>(0x1p-50) * (abs(shift) + size);
    }

    Vectors<Arch> at(const Floats<Arch>& s) const { return mul_add<Arch>(s, direction, start); }

    /// Returns a bound on `count` * u * (|start| + |s|), the rounding errors of a value at s.
    Floats<Arch> rounding(double count, const Floats<Arch>& s) const {
        return Floats<Arch>(count * 0x1.2p-53) * (size + abs(s));
    }

    /// Returns the error of the position at(s), including `count` roundings.
    Floats<Arch> error_at(const Floats<Arch>& s, double count = 2.0) const {
        return error + rounding(count, s);
    }

    /// Returns the error of the position at(s) per component, for an s that is off by `error_s`. It
    /// is 0 for components that are 0 in both `start` and `direction`.
    Vectors<Arch> off_at(const Floats<Arch>& s, const Floats<Arch>& error_s) const {
        using F = Floats<Arch>;
        const F along = F(0x1p-49) * abs(shift) + F(0x1p-50) * abs(s) + error_s;
        const auto off = [&](const F& from, const F& way) {
            return F(0x1p-50) * abs(from) + along * abs(way);
        };
        return {off(start.x, direction.x), off(start.y, direction.y), off(start.z, direction.z)};
    }

    /// Returns the error of t = shift + s for an s that is off by `error_s`, which need not include
    /// the last rounding of s.
    Floats<Arch> error_of_t(const Floats<Arch>& t, const Floats<Arch>& s,
                            const Floats<Arch>& error_s) const {
        return error_s + Floats<Arch>(0x1p-51) * (abs(t) + abs(s));
    }
};

} // namespace raylane::simd
