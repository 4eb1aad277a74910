#pragma once

#include "simd/kernel/shapes/filter.hpp"

namespace raylane::simd {

/// The interval of a ray inside a convex set: bounds on where it enters and leaves.
template <class Arch>
struct Stay {
    Floats<Arch> in_low;   ///< not inside at 0 < t < in_low; may be < 0
    Floats<Arch> out_high; ///< not inside at t > out_high; < 0 if never inside at t > 0
    Floats<Arch> in_high;  ///< where definite: inside from here, >= 0 ...
    Floats<Arch> out_low;  ///< ... to here, if out_low >= in_high
    Mask<Arch> definite;
    Mask<Arch> inside; ///< the origin is certainly inside
};

/// Returns the interval where |position + t slope| <= half. `error` is the error of position and
/// half together, and `slope_error` that of slope. `error` must also cover 2 u (|position| + half)
/// for the roundings here.
///
/// With c = -position sign(slope), by which the ray comes closer, one division serves all bounds,
/// as in FlatCrossing.
template <class Arch>
[[gnu::always_inline]] inline Stay<Arch>
cross_slab(const Floats<Arch>& position, const Floats<Arch>& half, const Floats<Arch>& error,
           const Floats<Arch>& slope, const Floats<Arch>& slope_error) {
    using F = Floats<Arch>;
    const F one(1.0F), infinity(__builtin_inff());
    const F closer = negated(position) ^ sign_bit<Arch>(slope);
    const F inverse = one / (abs(slope) + slope_error);
    const F stretch = F(4.0F) * slope_error * inverse;
    const Mask<Arch> clear = stretch <= one;
    const F least = inverse * F(1 - 4 * half_ulp);
    const F most = inverse * fast_mul_add<Arch>(stretch, F(1 + 8 * half_ulp), F(1 + 8 * half_ulp));
    const F outer = half + error, inner = half - error;
    const F distance = abs(position);
    const Mask<Arch> inside = distance < inner;
    // A ray along the slab may leave by either side.
    const F to_leave = select(clear, closer, negated(distance));
    return {(closer - outer) * least,
            select(clear, (closer + outer) * most, infinity),
            positive_part<Arch>((closer - inner) * most),
            (to_leave + inner) * least,
            (clear | inside) & (inner > zero<Arch>()),
            inside};
}

/// Returns the interval inside both sets.
template <class Arch>
[[gnu::always_inline]] inline Stay<Arch> operator&(const Stay<Arch>& a, const Stay<Arch>& b) {
    return {max(a.in_low, b.in_low),   min(a.out_high, b.out_high), max(a.in_high, b.in_high),
            min(a.out_low, b.out_low), a.definite & b.definite,     a.inside & b.inside};
}

} // namespace raylane::simd
