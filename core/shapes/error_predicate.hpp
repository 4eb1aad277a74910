#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/exact.hpp"
#include "core/shapes/precision.hpp"
#include "core/shapes/ray.hpp"

#include <cmath>
#include <type_traits>
#include <utility>

namespace raylane::core {

/// Answers the yes-or-no questions of a solver about its numbers. For a plain real type, the number
/// decides. For numbers with bounds, the predicate remembers whether any answer was within the
/// error.
template <class Real>
class ErrorPredicate {
  public:
    ErrorPredicate() = default;
    explicit ErrorPredicate(Precision precision) : textbook_(precision == Precision::fast) {}

    /// Returns true if the solver must use the textbook formulas.
    bool textbook() const { return textbook_; }

    int sign(const Real& a) {
        if constexpr (std::is_same_v<Real, Exact>)
            return a.sign();
        else
            return a > Real(0.0) ? 1 : a < Real(0.0) ? -1 : 0;
    }
    bool negative(const Real& a) { return a < Real(0.0); }
    bool positive(const Real& a) { return a > Real(0.0); }
    bool less(const Real& a, const Real& b) { return a < b; }
    bool doubt() const { return false; }
    /// keep_first keeps the earlier of two crossings, where a line leaves a convex solid; keep_last
    /// keeps the later, where it enters.
    void keep_first(Crossing<Real>& kept, const Crossing<Real>& other) {
        if (less(other.t, kept.t)) kept = other;
    }
    void keep_last(Crossing<Real>& kept, const Crossing<Real>& other) {
        if (less(kept.t, other.t)) kept = other;
    }
    /// Returns true if a crossing counts, given is_in(crossing).
    template <class IsIn>
    bool counts(Crossing<Real>& crossing, const IsIn& is_in) {
        return is_in(crossing);
    }

  private:
    bool textbook_ = false;
};

/// A divisor of several numbers. In float, `/` multiplies by the reciprocal of the divisor. The
/// result has an error of an ulp, but multiplication is several times as fast as division.
template <class Real>
class Divisor {
  public:
    explicit Divisor(Real value) : by_(std::move(value)) {
        if constexpr (std::is_same_v<Real, float>) by_ = 1.0F / by_;
    }
    friend Real operator/(const Real& a, const Divisor& divisor) {
        if constexpr (std::is_same_v<Real, float>)
            return a * divisor.by_;
        else
            return a / divisor.by_;
    }

  private:
    Real by_;
};

/// The relative accuracy required of t: an eighth of half an ulp of float, so that t rounds to the
/// right float or to a neighbour.
inline constexpr double needed_accuracy = 0x1p-27;

/// A predicate of numbers with bounds. An answer within the error, or a t that is not accurate
/// enough, leaves a doubt. The caller must then solve again in a wider type.
template <class T>
class ErrorPredicate<Bounded<T>> {
  public:
    using Real = Bounded<T>;

    static constexpr bool textbook() { return false; }

    int sign(const Real& a) {
        const auto value = static_cast<double>(a);
        if (!(std::abs(value) > a.error)) doubt_ |= a.error != 0.0 || std::isnan(value);
        return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
    }
    bool negative(const Real& a) { return sign(a) < 0; }
    bool positive(const Real& a) { return sign(a) > 0; }
    bool less(const Real& a, const Real& b) { return negative(a - b); }
    void keep_first(Crossing<Real>& kept, const Crossing<Real>& other) {
        if (less(other.t, kept.t)) kept = other;
    }
    void keep_last(Crossing<Real>& kept, const Crossing<Real>& other) {
        if (less(kept.t, other.t)) kept = other;
    }
    template <class IsIn>
    bool counts(Crossing<Real>& crossing, const IsIn& is_in) {
        return is_in(crossing);
    }
    /// Judges the accuracy of a t. Call it for every t that is a result.
    void result(const Bounded<double>& t) {
        doubt_ |= !(t.error <= needed_accuracy * t.magnitude());
    }
    bool doubt() const { return doubt_; }

  private:
    bool doubt_ = false;
};

} // namespace raylane::core
