#include "tests/oracle/exact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace raylane::oracle {

Exact::Exact() = default;
Exact::Exact(const Exact&) = default;
Exact::Exact(Exact&&) noexcept = default;
Exact& Exact::operator=(const Exact&) = default;
Exact& Exact::operator=(Exact&&) noexcept = default;
Exact::~Exact() = default;

Exact::Exact(int value) : whole_(value) {}
Exact::Exact(float value) : Exact(static_cast<double>(value)) {}
Exact::Exact(double value) {
    int power = 0;
    const double mantissa = std::frexp(value, &power);
    auto numerator = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
    if (numerator == 0) return;
    exponent_ = power - 53;
    const int zeros = __builtin_ctzll(static_cast<std::uint64_t>(numerator));
    numerator /= std::int64_t{1} << zeros;
    exponent_ += zeros;
    whole_ = numerator;
}

Exact::operator Number() const {
    const Number integer(whole_); // rounded if it has more than 100 digits
    return ldexp(integer, exponent_);
}

Exact operator-(Exact a) {
    a.whole_ = -a.whole_;
    return a;
}

Exact operator+(const Exact& a, const Exact& b) {
    if (a.sign() == 0) return b;
    if (b.sign() == 0) return a;
    Exact sum;
    sum.exponent_ = std::min(a.exponent_, b.exponent_);
    sum.whole_ =
        (a.whole_ << (a.exponent_ - sum.exponent_)) + (b.whole_ << (b.exponent_ - sum.exponent_));
    return sum;
}

Exact operator-(const Exact& a, const Exact& b) {
    return a + -b;
}

Exact operator*(const Exact& a, const Exact& b) {
    Exact product;
    product.whole_ = a.whole_ * b.whole_;
    product.exponent_ = a.exponent_ + b.exponent_;
    return product;
}

int sign(const Surd& a, const Exact& D) {
    const int p = a.P.sign(), q = D.sign() == 0 ? 0 : a.Q.sign();
    if (q == 0 || p == q) return p;
    if (p == 0) return q;
    return p * (a.P * a.P - a.Q * a.Q * D).sign();
}

int sign(const Surd& a, const Exact& D, const Exact& R, const Exact& E) {
    const int left = sign(a, D), right = E.sign() == 0 ? 0 : R.sign();
    if (right == 0 || left == right) return left;
    if (left == 0) return right;
    const Surd difference{a.P * a.P + a.Q * a.Q * D - R * R * E, Exact(2) * a.P * a.Q};
    return left * sign(difference, D);
}

Number value(const Surd& a, const Exact& D) {
    const Number root = sqrt(Number(D)), p(a.P), q(a.Q);
    if (a.P.sign() * a.Q.sign() >= 0) return p + q * root;
    return Number(a.P * a.P - a.Q * a.Q * D) / (p - q * root);
}

Vector vector(const core::Vec3f& v) {
    return {Exact(v.x), Exact(v.y), Exact(v.z)};
}

Vector vector(const core::Vec3d& v) {
    return {Exact(v.x), Exact(v.y), Exact(v.z)};
}

Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

Vector operator*(const Exact& s, const Vector& a) {
    return {s * a.x, s * a.y, s * a.z};
}

Exact inner(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector outer(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace raylane::oracle
