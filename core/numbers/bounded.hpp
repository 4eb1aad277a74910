#pragma once

#include "core/numbers/double_double.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace raylane::core {

/// Result of one operation, and a bound on its roundoff.
template <class T>
struct Rounded {
    T value;
    double error;
};

namespace rounding {

/// Roundoff in double: twice the relative error of one operation, which also covers the rounding of
/// the errors themselves.
inline Rounded<double> with_roundoff(double value) {
    return {value, 0x1p-52 * std::abs(value)};
}
inline Rounded<double> sum(double a, double b) {
    return with_roundoff(a + b);
}
inline Rounded<double> product(double a, double b) {
    return with_roundoff(a * b);
}
inline Rounded<double> quotient(double a, double b) {
    return with_roundoff(a / b);
}
inline Rounded<double> root(double a) {
    return with_roundoff(std::sqrt(a));
}

/// Roundoff in double-double: twice the bound that its authors prove, provided that the lower part
/// does not underflow; or 0 if the operation is found to be exact. Numbers with few digits, as
/// people write them in scenes, are then as good as exact ones: a tie or a tangent among them is
/// recognised.
inline Rounded<DoubleDouble> with_roundoff(const DoubleDouble& value, bool is_exact) {
    const double size = std::abs(value.high);
    if (!(size > 0x1p-900)) return {value, std::numeric_limits<double>::infinity()};
    return {value, is_exact ? 0.0 : 0x1p-101 * size};
}
inline Rounded<DoubleDouble> sum(const DoubleDouble& a, const DoubleDouble& b) {
    using namespace double_double;
    // Same as operator+, but keeps the terms that it drops.
    const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
    const DoubleDouble cross = two_sum(high.low, low.high);
    const DoubleDouble upper = two_sum(high.high, cross.high);
    const DoubleDouble rest = two_sum(upper.low, low.low);
    return {two_sum(upper.high, rest.high), std::abs(cross.low) + std::abs(rest.low)};
}
inline Rounded<DoubleDouble> product(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble value = a * b;
    // A product that underflows is not exact.
    if ((a.high == 0.0 || b.high == 0.0) && value.high == 0.0) return {value, 0.0};
    return with_roundoff(value, a.low == 0.0 && b.low == 0.0);
}
/// Returns true if quotient * divisor, each of one double, equals the dividend exactly.
inline bool divides(const DoubleDouble& quotient, const DoubleDouble& divisor,
                    const DoubleDouble& dividend) {
    const DoubleDouble product = double_double::two_product(quotient.high, divisor.high);
    return quotient.low == 0.0 && divisor.low == 0.0 && product.high == dividend.high &&
           product.low == dividend.low && std::abs(dividend.high) > 0x1p-900;
}
inline Rounded<DoubleDouble> quotient(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble value = a / b;
    if (a.high == 0.0 && value.high == 0.0) return {value, 0.0};
    return with_roundoff(value, divides(value, b, a));
}
inline Rounded<DoubleDouble> root(const DoubleDouble& a) {
    const DoubleDouble value = sqrt(a);
    return with_roundoff(value, divides(value, value, a));
}

} // namespace rounding

/// A number and a bound on its distance from the result of real arithmetic: running error analysis
/// (Higham, "Accuracy and Stability of Numerical Algorithms", 3.3). A formula that is a template
/// over the real type thereby proves its accuracy as it runs.
///
/// Each rule below bounds the true error from above if the operands' bounds do. A result that
/// overflows, or that underflows where no rule allows for it, has an error that is infinite or NaN.
template <class T>
struct Bounded {
    T value{};
    double error = 0.0;

    Bounded() = default;
    template <std::floating_point Exact>
    Bounded(Exact exact) : value(static_cast<double>(exact)) {} // NOLINT: implicit, exact
    Bounded(const T& value_, double error_) : value(value_), error(error_) {}

    explicit operator double() const { return static_cast<double>(value); }
    double magnitude() const { return std::abs(static_cast<double>(value)); }
    bool is_zero() const { return error == 0.0 && static_cast<double>(value) == 0.0; }
};

inline Bounded<double> in_double(const Bounded<double>& a) {
    return a;
}
inline Bounded<double> in_double(const Bounded<DoubleDouble>& a) {
    const DoubleDouble rounded = double_double::two_sum(a.value.high, a.value.low);
    return {rounded.high, (a.error + std::abs(rounded.low)) * (1.0 + 0x1p-52)};
}

namespace bounded {

/// More than an operation in double, or one on the errors, can lose to underflow.
inline constexpr double underflow = 0x1p-1070;

/// Rounds up an error that is a sum of several, each rounded a few times.
inline double rounded_up(double error) {
    return error * (1.0 + 0x1p-49);
}

} // namespace bounded

template <class T>
Bounded<T> operator-(const Bounded<T>& a) {
    return {-a.value, a.error};
}

template <class T>
Bounded<T> operator+(const Bounded<T>& a, const Bounded<T>& b) {
    const Rounded<T> sum = rounding::sum(a.value, b.value);
    return {sum.value, bounded::rounded_up(sum.error + (a.error + b.error))};
}

template <class T>
Bounded<T> operator-(const Bounded<T>& a, const Bounded<T>& b) {
    return a + -b;
}

template <class T>
Bounded<T> operator*(const Bounded<T>& a, const Bounded<T>& b) {
    if (a.is_zero() || b.is_zero()) return {};
    const Rounded<T> product = rounding::product(a.value, b.value);
    double error = product.error;
    const bool has_underflown = static_cast<double>(product.value) == 0.0;
    if (error != 0.0 || a.error != 0.0 || b.error != 0.0 || has_underflown)
        error += a.magnitude() * b.error + (b.magnitude() + b.error) * a.error + bounded::underflow;
    return {product.value, bounded::rounded_up(error)};
}

template <class T>
Bounded<T> operator/(const Bounded<T>& a, const Bounded<T>& b) {
    const double size = b.magnitude();
    if (!(b.error <= 0.5 * size && size > 0.0)) // the true divisor may be anything
        return {T(a.value / b.value), std::numeric_limits<double>::infinity()};
    if (a.is_zero()) return {};
    const Rounded<T> quotient = rounding::quotient(a.value, b.value);
    double error = quotient.error;
    const bool has_underflown = static_cast<double>(quotient.value) == 0.0;
    if (error != 0.0 || a.error != 0.0 || b.error != 0.0 || has_underflown) {
        const double of_quotient = std::abs(static_cast<double>(quotient.value)) * b.error;
        error +=
            (a.error + of_quotient + bounded::underflow) / (size - b.error) + bounded::underflow;
    }
    return {quotient.value, bounded::rounded_up(error)};
}

/// Returns the square root of a number that is known not to be negative; a value that rounding made
/// negative counts as 0.
template <class T>
Bounded<T> sqrt(const Bounded<T>& a) {
    const double most = std::sqrt(a.error) * 1.0000001;
    if (!(static_cast<double>(a.value) > 0.0)) return {T(0.0), most};
    const Rounded<T> root = rounding::root(a.value);
    double error = root.error;
    // |sqrt(x) - sqrt(y)| = |x - y| / (sqrt(x) + sqrt(y)), which is at most a.error / sqrt(a.value)
    // and at most sqrt(a.error).
    if (a.error != 0.0)
        error += std::min(a.error / static_cast<double>(root.value), most) + bounded::underflow;
    return {root.value, bounded::rounded_up(error)};
}

} // namespace raylane::core
