#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/dyadic.hpp"

#include <concepts>
#include <utility>

namespace raylane::core {

/// F(t) = A * t^2 + 2 * B * t + C in exact numbers.
struct ExactQuadratic {
    Dyadic A, B, C;

    /// t - value
    static ExactQuadratic minus(const Dyadic& value) { return {0.0, 0.5, -value}; }
    /// F' / 2
    ExactQuadratic half_derivative() const { return {0.0, 0.5 * A, B}; }
};

/// A real root of a quadratic. The root need not be representable, because only signs are computed.
/// The signs follow from the coefficients by sums and products alone, as few as resultants need
/// (Deakin and Snoeyink, "Sorting line-quadric intersections at low degree", arXiv 1605.05629;
/// Karavelas and Emiris, "Root comparison techniques applied to computing the additively weighted
/// Voronoi diagram", 2003).
class ExactRoot {
  public:
    /// Takes the root where F rises, or, if `rises` is false, the root where F falls. F must not be
    /// constant. A linear F has one root, whatever `rises` is. A double root counts as both.
    ExactRoot(ExactQuadratic F, bool rises) : F_(std::move(F)), rises_(rises) {}
    static ExactRoot at(double t) { return {ExactQuadratic::minus(t), true}; }

    /// Returns the sign of another quadratic at the root.
    int sign_of(const ExactQuadratic& G) const;
    /// Returns the sign of the root itself.
    int sign() const { return sign_of(ExactQuadratic::minus(0.0)); }
    /// Returns the order of two roots: -1 if a is less, 0 if they are equal, 1 if a is greater.
    friend int compare(const ExactRoot& a, const ExactRoot& b);
    /// Returns the float or double nearest to root * 2^exponent, ties to even. It must be one of
    /// those from `low` to `high`, which are >= 0.
    template <std::floating_point Real>
    Real rounded_between(Real low, Real high, int exponent) const;
    /// Returns the root with a relative error of at most 2^-100, or unchanged if this is not in the
    /// range of two doubles. `t` must be within `error` of the root.
    Bounded<DoubleDouble> in_wide(double t, double error) const;
    /// Returns the root with an absolute error of at most 2^exponent. `t` must be within `error` of
    /// the root. The error may be infinite if the root is positive.
    Dyadic near(double t, double error, int exponent) const;

  private:
    bool is_linear() const { return F_.A.sign() == 0; }

    ExactQuadratic F_;
    bool rises_;
};

int compare(const ExactRoot& a, const ExactRoot& b);

} // namespace raylane::core
