#pragma once

#include "core/numbers/vector.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

/// The oracle's numbers. Floats and doubles are whole numbers times powers of two; so are their
/// sums and products, and nothing is ever rounded.
namespace raylane::oracle {

/// For what is shown and measured: 100 decimal digits.
using Number = boost::multiprecision::cpp_bin_float_100;

class Exact {
  public:
    Exact();
    Exact(float value);  // NOLINT: implicit, exact
    Exact(double value); // NOLINT: implicit, exact
    Exact(int value);    // NOLINT: implicit, exact
    // Not inline: cpp_int's are long.
    Exact(const Exact&);
    Exact(Exact&&) noexcept;
    Exact& operator=(const Exact&);
    Exact& operator=(Exact&&) noexcept;
    ~Exact();

    int sign() const { return whole_.sign(); }
    explicit operator Number() const;

    friend Exact operator-(Exact a);
    friend Exact operator+(const Exact& a, const Exact& b);
    friend Exact operator-(const Exact& a, const Exact& b);
    friend Exact operator*(const Exact& a, const Exact& b);

  private:
    boost::multiprecision::cpp_int whole_;
    int exponent_ = 0;
};

/// P + Q sqrt(D), for D >= 0.
struct Surd {
    Exact P, Q;
};

/// The sign of P + Q sqrt(D): where both parts oppose each other, that of the larger square's.
int sign(const Surd& a, const Exact& D);

/// The sign of P + Q sqrt(D) + R sqrt(E).
int sign(const Surd& a, const Exact& D, const Exact& R, const Exact& E);

/// P + Q sqrt(D), to all digits: what would cancel does not.
Number value(const Surd& a, const Exact& D);

using Vector = core::Vec3<Exact>;

Vector vector(const core::Vec3f& v);
Vector vector(const core::Vec3d& v);
Vector operator-(const Vector& a, const Vector& b);
Vector operator+(const Vector& a, const Vector& b);
Vector operator*(const Exact& s, const Vector& a);
Exact inner(const Vector& a, const Vector& b);
Vector outer(const Vector& a, const Vector& b);

} // namespace raylane::oracle
