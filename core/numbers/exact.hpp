#pragma once

#include "core/numbers/dyadic.hpp"

#include <concepts>
#include <utility>

namespace raylane::core {

/// A quotient of exact numbers.
struct Rational {
    Dyadic numerator;
    Dyadic denominator; ///< > 0; 0 stands for 1, the most frequent denominator

    int sign() const { return numerator.sign(); }
    Scaled approximately() const;
};

Rational operator-(const Rational& a);
Rational operator+(const Rational& a, const Rational& b);
Rational operator-(const Rational& a, const Rational& b);
Rational operator*(const Rational& a, const Rational& b);
/// `b` must not be 0.
Rational operator/(const Rational& a, const Rational& b);

/// Real arithmetic, as far as a quadratic equation needs it: rational + root sqrt(radicand), in
/// integers of any size. No operation rounds, and every sign is decided. A solver with these
/// numbers takes 2 to 30 us and allocates memory, so it is for the few rays that wider floats leave
/// undecided. All numbers of one computation must come from the same square root.
class Exact {
  public:
    Exact() = default;
    template <std::floating_point Real>
    Exact(Real value) // NOLINT: implicit, exact
        : rational_{Dyadic(static_cast<double>(value)), {}} {}
    explicit Exact(Dyadic value) : rational_{std::move(value), {}} {}

    int sign() const;
    /// Returns the order of two numbers: -1 if a is less, 0 if they are equal, 1 if a is greater.
    /// They may come from different square roots.
    friend int compare(const Exact& a, const Exact& b);
    /// Returns the value with a relative error of at most 2^-48 and the right sign.
    explicit operator double() const;

    friend Exact operator-(const Exact& a);
    friend Exact operator+(const Exact& a, const Exact& b);
    friend Exact operator-(const Exact& a, const Exact& b);
    friend Exact operator*(const Exact& a, const Exact& b);
    /// Returns 0 if `b` is 0.
    friend Exact operator/(const Exact& a, const Exact& b);
    /// Returns the square root of a rational number >= 0.
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

int compare(const Exact& a, const Exact& b);

/// Returns the double nearest to a number, ties to even, but never 0 for another number, and never
/// infinity.
double nearest_double(const Exact& number);
/// The same for the square root of a number >= 0.
double nearest_double_root(const Exact& square);

} // namespace raylane::core
