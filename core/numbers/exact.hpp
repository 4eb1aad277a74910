#pragma once

#include "core/numbers/dyadic.hpp"

#include <concepts>
#include <utility>

namespace raylane::core {

/// A quotient of exact numbers.
struct Rational {
    Dyadic numerator;
    Dyadic denominator; ///< > 0; 0 stands for 1, which most are

    int sign() const { return numerator.sign(); }
    Scaled approximately() const;
};

Rational operator-(const Rational& a);
Rational operator+(const Rational& a, const Rational& b);
Rational operator-(const Rational& a, const Rational& b);
Rational operator*(const Rational& a, const Rational& b);
/// `b` is not 0.
Rational operator/(const Rational& a, const Rational& b);

/// Real arithmetic, as far as a quadratic equation needs it: rational + root sqrt(radicand), in
/// integers of any size. Nothing is rounded and every question is answered. A solver takes 2 to 30
/// us by it, and memory from the heap: for the few rays that wider floats leave undecided. All
/// numbers of one computation have to come from one square root.
class Exact {
  public:
    Exact() = default;
    template <std::floating_point Real>
    Exact(Real value) // NOLINT: implicit, exact
        : rational_{Dyadic(static_cast<double>(value)), {}} {}

    int sign() const;
    /// Within 2^-48 of itself, and of its sign.
    explicit operator double() const;

    friend Exact operator-(const Exact& a);
    friend Exact operator+(const Exact& a, const Exact& b);
    friend Exact operator-(const Exact& a, const Exact& b);
    friend Exact operator*(const Exact& a, const Exact& b);
    /// 0 if `b` is 0.
    friend Exact operator/(const Exact& a, const Exact& b);
    /// Root of a number >= 0 without a root of its own.
    friend Exact sqrt(const Exact& a);

    friend bool operator<(const Exact& a, const Exact& b) { return (a - b).sign() < 0; }
    friend bool operator>(const Exact& a, const Exact& b) { return b < a; }

  private:
    explicit Exact(Rational value) : rational_(std::move(value)) {}

    bool is_rational() const { return root_.sign() == 0; }
    Exact conjugate() const;
    Rational norm() const; ///< this * conjugate
    static const Rational& radicand_of(const Exact& a, const Exact& b);

    Rational rational_;
    Rational root_;
    Rational radicand_; // > 0 unless root_ is 0
};

} // namespace raylane::core
