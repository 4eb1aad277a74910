#pragma once

#include <cmath>
#include <concepts>

/// About 106 bits as the unevaluated sum of two doubles, for the few questions that double cannot
/// answer. Source: Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building
/// blocks of double-word arithmetic" (2017). Each operation below has a relative error of less than
/// 2^-102, provided that no result overflows or underflows.
namespace raylane::core {

struct DoubleDouble {
    double high = 0.0;
    double low = 0.0; ///< at most half an ulp of `high`

    DoubleDouble() = default;
    template <std::floating_point Exact>
    DoubleDouble(Exact value) : high(static_cast<double>(value)) {} // NOLINT: implicit, exact
    DoubleDouble(double high_, double low_) : high(high_), low(low_) {}

    explicit operator double() const { return high + low; }
};

namespace double_double {

/// a + b exactly (Knuth).
inline DoubleDouble two_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a + b exactly, for |a| >= |b| or a = 0 (Dekker).
inline DoubleDouble fast_two_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// a * b exactly.
inline DoubleDouble two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// Returns true if a * b = c * d, unless a product underflows or overflows. A product and its
/// rounding error represent the exact product, so their equality is that of the products.
inline bool are_equal_products(double a, double b, double c, double d) {
    const DoubleDouble first = two_product(a, b), second = two_product(c, d);
    const bool are_zero = (a == 0.0 || b == 0.0) && (c == 0.0 || d == 0.0);
    return first.high == second.high && first.low == second.low &&
           (are_zero || std::abs(first.high) > 0x1p-900);
}

} // namespace double_double

inline DoubleDouble operator-(const DoubleDouble& a) {
    return {-a.high, -a.low};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    using namespace double_double;
    const DoubleDouble high = two_sum(a.high, b.high);
    const DoubleDouble low = two_sum(a.low, b.low);
    const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
    return fast_two_sum(sum.high, sum.low + low.low);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    using namespace double_double;
    const DoubleDouble product = two_product(a.high, b.high);
    const double cross = std::fma(a.low, b.high, std::fma(a.high, b.low, a.low * b.low));
    return fast_two_sum(product.high, product.low + cross);
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    // One long division step each for the high, the middle and the low part of the quotient.
    const double high = a.high / b.high;
    const DoubleDouble rest = a - b * DoubleDouble(high);
    const double middle = rest.high / b.high;
    const double low = (rest - b * DoubleDouble(middle)).high / b.high;
    return double_double::fast_two_sum(high, middle) + DoubleDouble(low);
}

inline DoubleDouble sqrt(const DoubleDouble& a) {
    if (!(a.high > 0.0)) return {std::sqrt(a.high)};
    const double root = std::sqrt(a.high);
    const DoubleDouble rest = a - double_double::two_product(root, root);
    return double_double::fast_two_sum(root, rest.high / (2.0 * root));
}

} // namespace raylane::core
