#include "core/numbers/exact_root.hpp"

#include "core/numbers/nearest_between.hpp"

#include <cmath>

namespace raylane::core {

/// Returns the sign of G at the root. Let t = (-B + s sqrt(D)) / A with D = B^2 - A C, s = 1 where
/// F rises and -1 where it falls, and
///   J = A B' - A' B,  K = A C' - A' C,  L = B C' - B' C
/// for G = A' t^2 + 2 B' t + C'. Then
///   A^2 G(t) = X + Y sqrt(D),  X = A K - 2 J B,  Y = 2 s J.
/// If X and Y have opposite signs, the one with the larger square decides, and
///   X^2 - Y^2 D = A^2 (K^2 - 4 J L).
int ExactRoot::sign_of(const ExactQuadratic& G) const {
    const auto& [A, B, C] = F_;
    const auto& [A2, B2, C2] = G;
    if (is_linear()) // t = -C / 2 B
        return (A2 * C * C + 4.0 * B * (B * C2 - B2 * C)).sign();
    const Dyadic J = A * B2 - A2 * B, K = A * C2 - A2 * C;
    const int y = rises_ ? J.sign() : -J.sign();
    const int x = (A * K - 2.0 * J * B).sign();
    if (y == 0 || x == y) return x;
    const int larger = (K * K - 4.0 * J * (B * C2 - B2 * C)).sign();
    return larger > 0 ? x : larger < 0 ? y : 0;
}

int compare(const ExactRoot& a, const ExactRoot& b) {
    const int of_F = a.sign_of(b.F_);
    if (b.is_linear()) return of_F * b.F_.B.sign();
    // Tells whether a is between the roots of b's polynomial, at one of them, or on one side of
    // both.
    const int opens = b.F_.A.sign();
    const bool b_is_second = b.rises_ == (opens > 0);
    if (of_F * opens < 0) return b_is_second ? -1 : 1;
    const int side = a.sign_of(b.F_.half_derivative()) * opens;
    if (of_F != 0) return side;
    return side > 0 ? (b_is_second ? 0 : 1) : side < 0 ? (b_is_second ? -1 : 0) : 0;
}

template <std::floating_point Real>
Real ExactRoot::rounded_between(Real low, Real high, int exponent) const {
    const Dyadic scale = Dyadic::power_of_2(-exponent - 1);
    return nearest_between(
        low, high, [&](const Dyadic& sum) { return sign_of(ExactQuadratic::minus(sum * scale)); });
}

template float ExactRoot::rounded_between(float, float, int) const;
template double ExactRoot::rounded_between(double, double, int) const;

Bounded<DoubleDouble> ExactRoot::in_wide(double t, double error) const {
    // Smaller numbers may lose digits, and an infinite error has no half.
    if (!(std::abs(t) > 0x1p-900 && std::isfinite(error))) return {t, error};
    DoubleDouble middle(t);
    double half = std::ldexp(1.0, std::ilogb(error) + 1); // a power of two: no sum is rounded
    while (half > 0x1p-101 * std::abs(t)) {
        half *= 0.5;
        const int side = sign_of(ExactQuadratic::minus(Dyadic(middle.high) + middle.low));
        if (side == 0) return {middle, 0.0};
        middle = middle + DoubleDouble(side * half);
    }
    return {middle, half + 0x1p-101 * std::abs(t)};
}

Dyadic ExactRoot::near(double t, double error, int exponent) const {
    Dyadic middle = t;
    if (error == 0.0) return middle;
    int half = std::ilogb(error);
    if (std::isinf(error)) {
        middle = 0.0;
        for (half = 1024; sign_of(ExactQuadratic::minus(Dyadic::power_of_2(half))) > 0;)
            half *= 2;
    }
    for (; half >= exponent; --half) {
        const int side = sign_of(ExactQuadratic::minus(middle));
        if (side == 0) break;
        middle = side > 0 ? middle + Dyadic::power_of_2(half) : middle - Dyadic::power_of_2(half);
    }
    return middle;
}

} // namespace raylane::core
