#pragma once

#include "simd/kernel/shapes/slab.hpp"

namespace raylane::simd {

/// Bounds on the first crossing with a surface of second degree, F(s) = A s^2 + 2 B s + C = 0 for
/// s > 0. They are computed from C, B and the discriminant D = B^2 - A C with their errors:
///   s = C / (sqrt(D) - B) if C > 0, and -C / (sqrt(D) + B) if C < 0.
/// There is no crossing where the divisor is not positive. This holds for either sign of A, and for
/// A = 0.
///
/// C and D are squares of lengths, and overflow before the errors that are computed from lengths.
/// Then their own errors are unknown.
template <class Arch>
struct FirstCrossing {
    Floats<Arch> low, high; ///< `high` is valid where `definite`
    Mask<Arch> none;        ///< certainly no crossing
    Mask<Arch> definite;    ///< certainly a crossing
    Mask<Arch> outside;     ///< certainly C > 0
    Mask<Arch> inside;      ///< certainly C < 0

    [[gnu::always_inline]] FirstCrossing(const Floats<Arch>& B, const Floats<Arch>& B_error,
                                         const Floats<Arch>& C, const Floats<Arch>& error_of_C,
                                         const Floats<Arch>& D, const Floats<Arch>& error_of_D) {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        // NaN, which decides nothing, if the value is infinite.
        const F C_error = fast_mul_add<Arch>(o, C, error_of_C);
        const F D_error = fast_mul_add<Arch>(o, D, error_of_D);
        const F size = abs(C), away = B ^ sign_bit<Arch>(C);
        const F most = D + D_error, least = D - D_error;
        const F divisor = sqrt(most) * F(1 + 4 * half_ulp) - away + B_error;
        const Mask<Arch> apart = size > C_error;
        outside = apart & (C > o);
        inside = apart & (C < o);
        none = (most < o) | (apart & (divisor < o));
        low = select(apart, (size - C_error) / divisor * F(1 - 4 * half_ulp), o);

        const F min_divisor = sqrt(least) * F(1 - 4 * half_ulp) - away - B_error;
        // If B overflows, so does the divisor, and `high` would be 0.
        definite = apart & (least > o) & (min_divisor > o) & (min_divisor < F(__builtin_inff()));
        high = (size + C_error) / min_divisor * F(1 + 4 * half_ulp);
    }
};

/// Returns the bounds of a surface that lies within `ends`. `crossing` is relative to the point at
/// t = `start`, which is not after the first crossing.
template <class Arch>
[[gnu::always_inline]] inline Bounds<Arch>
surface_bounds(const Mask<Arch>& is_shape, const Stay<Arch>& ends, const Floats<Arch>& start,
               const FirstCrossing<Arch>& crossing) {
    using F = Floats<Arch>;
    const F lower = (start + crossing.low) * F(1 - 4 * half_ulp);
    const F upper = (start + crossing.high) * F(1 + 4 * half_ulp);
    return {is_shape & ~(crossing.none | (ends.out_high < lower)), positive_part<Arch>(lower),
            is_shape & crossing.definite & ends.definite & (lower >= ends.in_high) &
                (upper <= ends.out_low),
            upper};
}

} // namespace raylane::simd
