#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/dyadic.hpp"

#include <utility>

namespace raylane::core {

/// F(t) = A t^2 + 2 B t + C in exact numbers.
struct ExactQuadratic {
    Dyadic A, B, C;

    /// t - value
    static ExactQuadratic minus(const Dyadic& value) { return {0.0, 0.5, -value}; }
    /// F' / 2
    ExactQuadratic half_derivative() const { return {0.0, 0.5 * A, B}; }
};

/// A real root of a quadratic, which need not be a number that can be written down. What is asked
/// of it are signs, and those follow from the coefficients by sums and products alone: as few as
/// resultants need (Deakin and Snoeyink, "Sorting line-quadric intersections at low degree", arXiv
/// 1605.05629; Karavelas and Emiris, "Root comparison techniques applied to computing the
/// additively weighted Voronoi diagram", 2003).
class ExactRoot {
  public:
    /// The root where F rises, or else falls; of a linear F, which is not constant, its only one.
    /// A double root is both.
    ExactRoot(ExactQuadratic F, bool rises) : F_(std::move(F)), rises_(rises) {}
    static ExactRoot at(double t) { return {ExactQuadratic::minus(t), true}; }

    /// The sign of another quadratic there.
    int sign_of(const ExactQuadratic& G) const;
    /// Sign of the root itself.
    int sign() const { return sign_of(ExactQuadratic::minus(0.0)); }
    /// Order of two roots: -1 if a is less, 0 if they are the same.
    friend int compare(const ExactRoot& a, const ExactRoot& b);
    /// The float that root * 2^exponent is nearest to, ties to even, of those from low to high,
    /// which are >= 0. It must not be nearer to another.
    float rounded_between(float low, float high, int exponent) const;
    /// Within 2^-100 of itself. Double knows it already, but for an error.
    Bounded<DoubleDouble> in_wide(double t, double error) const;
    /// Within 2^exponent, likewise.
    Dyadic near(double t, double error, int exponent) const;

  private:
    bool is_linear() const { return F_.A.sign() == 0; }

    ExactQuadratic F_;
    bool rises_;
};

int compare(const ExactRoot& a, const ExactRoot& b);

} // namespace raylane::core
