#pragma once

#include "core/double_double.hpp"

#include <cmath>
#include <concepts>
#include <limits>

namespace raylane::core {

/// What one operation in T may be off by, relative to its result: twice what its authors prove, so
/// that the rounding of the error terms themselves is paid for.
template <class T>
inline constexpr double unit_roundoff = 0.0;
template <>
inline constexpr double unit_roundoff<double> = 0x1p-52;
template <>
inline constexpr double unit_roundoff<DoubleDouble> = 0x1p-101;

/// A number and how far it may be from the one that real arithmetic would have given: running error
/// analysis (Higham, "Accuracy and Stability of Numerical Algorithms", 3.3). A formula written once
/// for any real type thereby carries the proof of its own accuracy.
///
/// Every rule below bounds the true error from above, given that the operands' bounds do. Underflow
/// is outside of it: a product of components below 1e-150 may lose its bound.
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
};

namespace bounded {
/// `value`, the rounded result of one operation on operands whose errors make `propagated`.
template <class T>
Bounded<T> rounded(const T& value, double propagated) {
    return {value, propagated + unit_roundoff<T> * std::abs(static_cast<double>(value))};
}
} // namespace bounded

template <class T>
Bounded<T> operator-(const Bounded<T>& a) {
    return {-a.value, a.error};
}

template <class T>
Bounded<T> operator+(const Bounded<T>& a, const Bounded<T>& b) {
    return bounded::rounded<T>(a.value + b.value, a.error + b.error);
}

template <class T>
Bounded<T> operator-(const Bounded<T>& a, const Bounded<T>& b) {
    return bounded::rounded<T>(a.value - b.value, a.error + b.error);
}

template <class T>
Bounded<T> operator*(const Bounded<T>& a, const Bounded<T>& b) {
    return bounded::rounded<T>(a.value * b.value,
                               a.magnitude() * b.error + (b.magnitude() + b.error) * a.error);
}

template <class T>
Bounded<T> operator/(const Bounded<T>& a, const Bounded<T>& b) {
    const T quotient = a.value / b.value;
    const double least = b.magnitude() - b.error; // of the true divisor
    if (!(least > 0.0)) return {quotient, std::numeric_limits<double>::infinity()};
    return bounded::rounded<T>(
        quotient, (a.error + std::abs(static_cast<double>(quotient)) * b.error) / least);
}

/// Of a number that is known not to be negative; what rounding makes negative counts as 0.
template <class T>
Bounded<T> sqrt(const Bounded<T>& a) {
    using std::sqrt;
    if (!(static_cast<double>(a.value) > 0.0)) return {T(0.0), std::sqrt(a.error)};
    const T root = sqrt(a.value);
    // |sqrt(x) - sqrt(y)| = |x - y| / (sqrt(x) + sqrt(y)), which is below both.
    return bounded::rounded<T>(
        root, std::min(a.error / static_cast<double>(root), std::sqrt(a.error) * 1.0000001));
}

} // namespace raylane::core
