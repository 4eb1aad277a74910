#pragma once

#include "core/numbers/vector.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

/// The oracle's numbers. Floats and doubles are integers times powers of two. So are their sums and
/// products, which are never rounded.
namespace raylane::oracle {

/// 100 decimal digits, for output and measurements.
using Number = boost::multiprecision::cpp_bin_float_100;

class Exact {
  public:
    Exact();
    Exact(float value);  // NOLINT: implicit, exact
    Exact(double value); // NOLINT: implicit, exact
    Exact(int value);    // NOLINT: implicit, exact
    // Not inline, as cpp_int's are long.
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

/// Returns the sign of P + Q sqrt(D). If the parts have opposite signs, the part with the larger
/// square decides.
int sign(const Surd& a, const Exact& D);

/// Returns the sign of P + Q sqrt(D) + R sqrt(E).
int sign(const Surd& a, const Exact& D, const Exact& R, const Exact& E);

/// Returns P + Q sqrt(D) to all digits, by a formula without cancellation.
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
