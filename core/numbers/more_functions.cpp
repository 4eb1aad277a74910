#include "core/numbers/more_functions.hpp"

#include "core/numbers/double_double.hpp"
#include "core/numbers/elementary.hpp"
#include "core/numbers/primitives.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace raylane::core {

namespace {

constexpr double pi = std::numbers::pi;
/// Beyond this, e^x is infinite, or e^-x is negligible beside it.
constexpr double large = 709.0;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr int max_squared = 1024; // for repeated squaring, with an error of 2^-90

/// x^n for finite x != 0 and |n| <= max_squared.
double whole_power(double x, int n) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (std::abs(m) < std::numbers::sqrt2 / 2.0) { // keeps m^n and its error terms in range
        m *= 2.0;
        --exponent;
    }
    DoubleDouble result(1.0), square(m);
    for (int rest = std::abs(n);;) {
        if (rest % 2 != 0) result = result * square;
        rest /= 2;
        if (rest == 0) break;
        square = square * square;
    }
    if (n < 0) result = DoubleDouble(1.0) / result;
    return std::ldexp(static_cast<double>(result), exponent * n);
}

/// Returns e^x / 2, which may be finite where e^x is not.
double half_of_large_exp(double x) {
    const double root = exp(0.5 * x);
    return 0.5 * root * root;
}

/// Returns log(1 + x) for x >= 0. Source: Kahan; both factors contain the error of 1 + x.
double log1p(double x) {
    const double sum = 1.0 + x;
    if (sum == 1.0) return x;
    return sum > 0x1p60 ? log(x) : log(sum) * (x / (sum - 1.0));
}

} // namespace

double power(double x, double y) {
    // Exact in every library.
    if (!std::isfinite(x) || !std::isfinite(y) || x == 0.0 || y == 0.0) return std::pow(x, y);
    const double size = std::abs(y);
    const bool is_whole = std::floor(size) == size;
    if (x < 0.0 && !is_whole) return not_a_number;
    if (y == 0.5) return std::sqrt(x);
    if (is_whole && size <= max_squared) return whole_power(x, static_cast<int>(y));
    const double result = pow(std::abs(x), y); // any y is valid for a positive base
    return x < 0.0 && std::fmod(size, 2.0) != 0.0 ? -result : result;
}

double tan(double x) {
    if (!std::isfinite(x)) return not_a_number;
    const auto [sine, cosine] = Elementary<double>::sin_cos(x);
    return sine / cosine;
}

double asin(double x) {
    return atan(x / std::sqrt((1.0 - x) * (1.0 + x)));
}

double acos(double x) {
    return 2.0 * atan(std::sqrt((1.0 - x) / (1.0 + x)));
}

double atan2(double y, double x) {
    // Exact in every library, except for multiples of pi / 4.
    if (!std::isfinite(x) || !std::isfinite(y) || x == 0.0 || y == 0.0) return std::atan2(y, x);
    const double angle = atan(std::abs(y / x));
    return std::copysign(x < 0.0 ? pi - angle : angle, y);
}

double sinh(double x) {
    if (std::isnan(x)) return x;
    const double size = std::abs(x);
    if (size > large) return std::copysign(half_of_large_exp(size), x);
    const double less_one = expm1(size);
    return std::copysign(0.5 * (less_one + less_one / (less_one + 1.0)), x);
}

double cosh(double x) {
    if (std::isnan(x)) return x;
    const double size = std::abs(x);
    if (size > large) return half_of_large_exp(size);
    const double power = exp(size);
    return 0.5 * (power + 1.0 / power);
}

double tanh(double x) {
    if (std::isnan(x)) return x;
    const double less_one = expm1(-2.0 * std::abs(x));
    return std::copysign(-less_one / (2.0 + less_one), x);
}

double asinh(double x) {
    const double size = std::abs(x);
    if (size > 0x1p30) return std::copysign(log(size) + std::numbers::ln2, x);
    const double square = size * size;
    return std::copysign(log1p(size + square / (1.0 + std::sqrt(1.0 + square))), x);
}

double acosh(double x) {
    if (x < 1.0) return not_a_number;
    if (x > 0x1p30) return log(x) + std::numbers::ln2;
    const double beyond = x - 1.0;
    return log1p(beyond + std::sqrt(2.0 * beyond + beyond * beyond));
}

double atanh(double x) {
    const double size = std::abs(x);
    if (size > 1.0) return not_a_number;
    return std::copysign(0.5 * log1p(2.0 * size / (1.0 - size)), x);
}

} // namespace raylane::core
