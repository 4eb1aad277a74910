#pragma once

#include "core/numbers/vector.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>

/// The oracle's numbers. Floats and doubles are whole numbers times powers of two; so are their
/// sums and products, and nothing is ever rounded.
namespace raylane::oracle {

/// For what is shown and measured: 100 decimal digits.
using Number = boost::multiprecision::cpp_bin_float_100;

class Exact {
  public:
    Exact() = default;
    template <std::floating_point Real>
    Exact(Real value) { // NOLINT: implicit, exact
        int power = 0;
        const double mantissa = std::frexp(static_cast<double>(value), &power);
        auto whole = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
        if (whole == 0) return;
        exponent_ = power - 53;
        const int zeros = __builtin_ctzll(static_cast<std::uint64_t>(whole));
        whole /= std::int64_t{1} << zeros;
        exponent_ += zeros;
        whole_ = whole;
    }
    Exact(int value) : whole_(value) {} // NOLINT: implicit, exact

    int sign() const { return whole_.sign(); }
    explicit operator Number() const {
        const Number whole(whole_); // rounded, where it has more than 100 digits
        return ldexp(whole, exponent_);
    }

    friend Exact operator-(Exact a) {
        a.whole_ = -a.whole_;
        return a;
    }
    friend Exact operator+(const Exact& a, const Exact& b) {
        if (a.sign() == 0) return b;
        if (b.sign() == 0) return a;
        Exact sum;
        sum.exponent_ = std::min(a.exponent_, b.exponent_);
        sum.whole_ = (a.whole_ << (a.exponent_ - sum.exponent_)) +
                     (b.whole_ << (b.exponent_ - sum.exponent_));
        return sum;
    }
    friend Exact operator-(const Exact& a, const Exact& b) { return a + -b; }
    friend Exact operator*(const Exact& a, const Exact& b) {
        Exact product;
        product.whole_ = a.whole_ * b.whole_;
        product.exponent_ = a.exponent_ + b.exponent_;
        return product;
    }

  private:
    boost::multiprecision::cpp_int whole_;
    int exponent_ = 0;
};

/// P + Q sqrt(D), for D >= 0.
struct Surd {
    Exact P, Q;
};

/// The sign of P + Q sqrt(D): where both parts oppose each other, that of the larger square's.
inline int sign(const Surd& a, const Exact& D) {
    const int p = a.P.sign(), q = D.sign() == 0 ? 0 : a.Q.sign();
    if (q == 0 || p == q) return p;
    if (p == 0) return q;
    return p * (a.P * a.P - a.Q * a.Q * D).sign();
}

/// The sign of P + Q sqrt(D) + R sqrt(E).
inline int sign(const Surd& a, const Exact& D, const Exact& R, const Exact& E) {
    const int left = sign(a, D), right = E.sign() == 0 ? 0 : R.sign();
    if (right == 0 || left == right) return left;
    if (left == 0) return right;
    const Surd difference{a.P * a.P + a.Q * a.Q * D - R * R * E, Exact(2) * a.P * a.Q};
    return left * sign(difference, D);
}

/// P + Q sqrt(D), to all digits: what would cancel does not.
inline Number value(const Surd& a, const Exact& D) {
    const Number root = sqrt(Number(D)), p(a.P), q(a.Q);
    if (a.P.sign() * a.Q.sign() >= 0) return p + q * root;
    return Number(a.P * a.P - a.Q * a.Q * D) / (p - q * root);
}

using Vector = core::Vec3<Exact>;

inline Vector vector(const core::Vec3f& v) {
    return {Exact(v.x), Exact(v.y), Exact(v.z)};
}
inline Vector vector(const core::Vec3d& v) {
    return {Exact(v.x), Exact(v.y), Exact(v.z)};
}
inline Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator*(const Exact& s, const Vector& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Exact inner(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector outer(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace raylane::oracle
