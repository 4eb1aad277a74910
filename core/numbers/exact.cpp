#include "core/numbers/exact.hpp"

#include "core/numbers/nearest_between.hpp"

#include <cmath>
#include <limits>

namespace raylane::core {

namespace {

Scaled product(const Scaled& a, const Scaled& b) {
    return Scaled::of(a.value * b.value, a.exponent + b.exponent);
}

Scaled quotient(const Scaled& a, const Scaled& b) {
    return Scaled::of(a.value / b.value, a.exponent - b.exponent);
}

Scaled root(const Scaled& a) {
    const bool odd = a.exponent % 2 != 0;
    return Scaled::of(std::sqrt(odd ? 2.0 * a.value : a.value), (a.exponent - (odd ? 1 : 0)) / 2);
}

Scaled sum(const Scaled& a, const Scaled& b) {
    if (a.value == 0.0) return b;
    if (b.value == 0.0) return a;
    if (a.exponent < b.exponent) return sum(b, a);
    if (a.exponent - b.exponent > 100) return a;
    return Scaled::of(a.value + std::ldexp(b.value, static_cast<int>(b.exponent - a.exponent)),
                      a.exponent);
}

/// Returns the product of two denominators, for which 0 stands for 1.
Dyadic multiplied(const Dyadic& a, const Dyadic& b) {
    return a.sign() == 0 ? b : b.sign() == 0 ? a : a * b;
}

} // namespace

Scaled Rational::approximately() const {
    const Scaled top = numerator.approximately();
    return denominator.sign() == 0 ? top : quotient(top, denominator.approximately());
}

Rational operator-(const Rational& a) {
    return {-a.numerator, a.denominator};
}

Rational operator+(const Rational& a, const Rational& b) {
    if (a.sign() == 0) return b;
    if (b.sign() == 0) return a;
    if (a.denominator == b.denominator) return {a.numerator + b.numerator, a.denominator};
    return {multiplied(a.numerator, b.denominator) + multiplied(b.numerator, a.denominator),
            multiplied(a.denominator, b.denominator)};
}

Rational operator-(const Rational& a, const Rational& b) {
    return a + -b;
}

Rational operator*(const Rational& a, const Rational& b) {
    if (a.sign() == 0 || b.sign() == 0) return {};
    return {a.numerator * b.numerator, multiplied(a.denominator, b.denominator)};
}

Rational operator/(const Rational& a, const Rational& b) {
    if (a.sign() == 0) return {};
    const bool same = a.denominator == b.denominator;
    const Dyadic top = same ? a.numerator : multiplied(a.numerator, b.denominator);
    const Dyadic bottom = same ? b.numerator : multiplied(b.numerator, a.denominator);
    return bottom.sign() < 0 ? Rational{-top, -bottom} : Rational{top, bottom};
}

const Rational& Exact::radicand_of(const Exact& a, const Exact& b) {
    return a.is_rational() ? b.radicand_ : a.radicand_;
}

Exact Exact::conjugate() const {
    Exact result = *this;
    result.root_ = -root_;
    return result;
}

Rational Exact::norm() const {
    return rational_ * rational_ - root_ * root_ * radicand_;
}

int Exact::sign() const {
    const int of_rational = rational_.sign();
    const int of_root = root_.sign();
    if (of_root == 0 || of_rational == of_root) return of_rational;
    if (of_rational == 0) return of_root;
    return of_rational * norm().sign(); // the sign of the part with the larger square
}

Exact::operator double() const {
    if (is_rational()) return rational_.approximately().to_double();
    const Scaled irrational = product(root_.approximately(), root(radicand_.approximately()));
    const Scaled part = rational_.approximately();
    if (rational_.sign() * root_.sign() >= 0) return sum(part, irrational).to_double();
    // (x - y) = (x^2 - y^2) / (x + y), which does not cancel.
    const Scaled difference = sum(part, {-irrational.value, irrational.exponent});
    return quotient(norm().approximately(), difference).to_double();
}

/// Returns the sign of u - v, where u = a - (rational part of b) has the square root of a, and v is
/// the irrational part of b. If both have one sign, their squares decide, and v^2 is rational.
int compare(const Exact& a, const Exact& b) {
    if (a.is_rational() && !b.is_rational()) return -compare(b, a);
    const Exact u = a - Exact(b.rational_);
    if (b.is_rational()) return u.sign();
    const int of_u = u.sign(), of_v = b.root_.sign();
    if (of_u != of_v) return of_u < of_v ? -1 : 1;
    return of_u * (u * u - Exact(b.root_ * b.root_ * b.radicand_)).sign();
}

namespace {

/// Returns the double nearest to a positive number, of which `approximation` has a relative error
/// of at most 2^-45, unless the number is outside of the range of normal doubles. `order_of`: see
/// nearest_between().
template <class Order>
double nearest_to(double approximation, const Order& order_of) {
    constexpr double least = std::numeric_limits<double>::denorm_min();
    constexpr double most = std::numeric_limits<double>::max();
    if (!(approximation > 0x1p-1000 && approximation < 0x1p1000))
        return nearest_between(least, most, order_of);
    return nearest_between(approximation * (1.0 - 0x1p-44), approximation * (1.0 + 0x1p-44),
                           order_of);
}

} // namespace

double nearest_double(const Exact& number) {
    const int sign = number.sign();
    if (sign == 0) return 0.0;
    const Exact size = sign < 0 ? -number : number;
    return sign * nearest_to(static_cast<double>(size),
                             [&](const Dyadic& sum) { return compare(size, Exact(0.5 * sum)); });
}

double nearest_double_root(const Exact& square) {
    if (square.sign() == 0) return 0.0;
    const auto size = static_cast<double>(square);
    const bool is_usual = size > 0x1p-1000 && size < 0x1p1000;
    return nearest_to(is_usual ? std::sqrt(size) : 0.0, [&](const Dyadic& sum) {
        const Dyadic middle = 0.5 * sum;
        return compare(square, Exact(middle * middle));
    });
}

Exact operator-(const Exact& a) {
    Exact result = a.conjugate();
    result.rational_ = -a.rational_;
    return result;
}

Exact operator+(const Exact& a, const Exact& b) {
    if (a.is_rational() && b.is_rational()) return Exact(a.rational_ + b.rational_);
    Exact result;
    result.rational_ = a.rational_ + b.rational_;
    result.root_ = a.root_ + b.root_;
    if (!result.is_rational()) result.radicand_ = Exact::radicand_of(a, b);
    return result;
}

Exact operator-(const Exact& a, const Exact& b) {
    return a + -b;
}

Exact operator*(const Exact& a, const Exact& b) {
    if (a.is_rational() && b.is_rational()) return Exact(a.rational_ * b.rational_);
    const Rational& radicand = Exact::radicand_of(a, b);
    Exact result;
    result.rational_ = a.rational_ * b.rational_ + a.root_ * b.root_ * radicand;
    result.root_ = a.rational_ * b.root_ + a.root_ * b.rational_;
    if (!result.is_rational()) result.radicand_ = radicand;
    return result;
}

Exact operator/(const Exact& a, const Exact& b) {
    if (b.sign() == 0) return {};
    if (!b.is_rational()) {
        const Exact divisor(b.norm());
        if (divisor.sign() != 0) return a * b.conjugate() / divisor;
        // The square root is rational, and b twice its rational part.
        return a / Exact(b.rational_ + b.rational_);
    }
    Exact result;
    result.rational_ = a.rational_ / b.rational_;
    result.root_ = a.root_ / b.rational_;
    result.radicand_ = a.radicand_;
    return result;
}

Exact sqrt(const Exact& a) {
    Exact result;
    if (a.sign() <= 0) return result;
    result.root_.numerator = Dyadic(1.0);
    result.radicand_ = a.rational_;
    return result;
}

} // namespace raylane::core
