#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace raylane::core {

/// A function of two parameters a and b in [-1, 1], known to first order:
///   |f(a, b) - (value + a across + b upward)| <= error
/// A Taylor model of degree one (Makino and Berz, "Taylor Models and Other Validated Functional
/// Inclusion Methods", 2003). A formula that is a template over the real type is thereby evaluated
/// for all rays of a beam at once. Terms that depend on the parameters in the same way cancel; the
/// remainder is of second order in the beam's width. Roundoff is part of the error.
struct Affine {
    double value = 0.0;
    double across = 0.0;
    double upward = 0.0;
    double error = 0.0;

    Affine() = default;
    template <class Exact>
    requires std::is_arithmetic_v<Exact> Affine(Exact exact)
        : value(static_cast<double>(exact)) {} // NOLINT: implicit, exact
    Affine(double value_, double across_, double upward_, double error_ = 0.0)
        : value(value_), across(across_), upward(upward_), error(error_) {}

    /// Returns the value at the middle, without the error.
    explicit operator double() const { return value; }
    double slope() const { return std::abs(across) + std::abs(upward); }
    /// Returns the largest possible difference from the value at the middle.
    double spread() const { return slope() + error; }
    double magnitude() const { return std::abs(value) + spread(); }
    double lower() const { return value - spread(); }
    double upper() const { return value + spread(); }
};

namespace affine {

/// Returns an upper bound on a handful of roundings of numbers up to `magnitude`, including those
/// of the errors.
inline double roundoff(double magnitude) {
    return 0x1p-49 * magnitude + 0x1p-1060;
}

/// Returns f(x) for a function of one variable, given its value and its derivative at x.value, and
/// a bound `off` on the error of its tangent within x.spread().
inline Affine along_tangent(const Affine& x, double value, double derivative, double off) {
    const double slope = std::abs(derivative);
    return {value, derivative * x.across, derivative * x.upward,
            slope * x.error + off + roundoff(std::abs(value) + slope * x.spread())};
}

} // namespace affine

inline Affine operator-(const Affine& x) {
    return {-x.value, -x.across, -x.upward, x.error};
}

inline Affine operator+(const Affine& x, const Affine& y) {
    Affine sum{x.value + y.value, x.across + y.across, x.upward + y.upward, x.error + y.error};
    sum.error += affine::roundoff(std::abs(sum.value) + sum.spread());
    return sum;
}

inline Affine operator-(const Affine& x, const Affine& y) {
    return x + -y;
}

inline Affine operator*(const Affine& x, const Affine& y) {
    const double of_x = x.spread(), of_y = y.spread();
    const double size_of_x = std::abs(x.value), size_of_y = std::abs(y.value);
    return {x.value * y.value, x.value * y.across + y.value * x.across,
            x.value * y.upward + y.value * x.upward,
            size_of_x * y.error + size_of_y * x.error + of_x * of_y +
                affine::roundoff((size_of_x + of_x) * (size_of_y + of_y))};
}

/// Returns 1 / x; the error is infinite if x may be 0.
inline Affine reciprocal(const Affine& x) {
    const double spread = x.spread(), least = std::abs(x.value) - spread;
    const double value = 1.0 / x.value;
    if (!(least > 0.0)) return {value, 0.0, 0.0, std::numeric_limits<double>::infinity()};
    const double ratio = spread * value;
    return affine::along_tangent(x, value, -value * value, ratio * ratio / least);
}

inline Affine operator/(const Affine& x, const Affine& y) {
    return x * reciprocal(y);
}

/// Returns the square root of a number that is known not to be negative. If x may be 0, the result
/// has slope 0.
inline Affine sqrt(const Affine& x) {
    const double spread = x.spread(), least = x.value - spread;
    if (!(least > 0.0)) {
        const double half = 0.5 * std::sqrt(std::max(x.value + spread, 0.0));
        return {half, 0.0, 0.0, half + affine::roundoff(half)};
    }
    const double root = std::sqrt(x.value);
    // The second derivative is -1/4 x^(-3/2).
    return affine::along_tangent(x, root, 0.5 / root,
                                 spread * spread / (8.0 * least * std::sqrt(least)));
}

/// Returns true if x < y for all parameters.
inline bool operator<(const Affine& x, const Affine& y) {
    return (x - y).upper() < 0.0;
}
inline bool operator>(const Affine& x, const Affine& y) {
    return y < x;
}

} // namespace raylane::core
