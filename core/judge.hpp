#pragma once

#include "core/bounded.hpp"

#include <cmath>

namespace raylane::core {

/// Answers the yes-or-no questions that a solver asks of its numbers. For a plain real type the
/// answer is the number's own. For numbers with bounds it remembers whether any answer was within
/// the error.
template <class Real>
class Judge {
  public:
    int sign(const Real& a) { return a > Real(0) ? 1 : a < Real(0) ? -1 : 0; }
    bool negative(const Real& a) { return a < Real(0); }
    bool positive(const Real& a) { return a > Real(0); }
    bool less(const Real& a, const Real& b) { return a < b; }
    /// To be called of every t that is a result.
    void result(const Real&) {}
    bool doubt() const { return false; }
};

/// The relative accuracy that a t must have: an eighth of half an ulp of float, so that it rounds
/// to the right float or to a neighbour.
inline constexpr double needed_accuracy = 0x1p-27;

/// In double: an answer within the error, or a t that is not accurate enough, is a doubt, and the
/// question has to be asked again in a wider type.
template <>
class Judge<Bounded<double>> {
  public:
    using Real = Bounded<double>;

    int sign(const Real& a) {
        if (!(std::abs(a.value) > a.error)) doubt_ |= a.error != 0.0 || std::isnan(a.value);
        return a.value > 0.0 ? 1 : a.value < 0.0 ? -1 : 0;
    }
    bool negative(const Real& a) { return sign(a) < 0; }
    bool positive(const Real& a) { return sign(a) > 0; }
    bool less(const Real& a, const Real& b) { return negative(a - b); }
    void result(const Real& t) { doubt_ |= !(t.error <= needed_accuracy * std::abs(t.value)); }
    bool doubt() const { return doubt_; }

  private:
    bool doubt_ = false;
};

/// In double-double, the widest: what cannot be told from 0 is 0. That is exact wherever the
/// inputs' bits fit, which is where exact ties happen: tangents, rims and corners on simple
/// coordinates.
template <>
class Judge<Bounded<DoubleDouble>> {
  public:
    using Real = Bounded<DoubleDouble>;

    int sign(const Real& a) {
        if (!(a.magnitude() > a.error)) return 0;
        return a.value.high > 0.0 ? 1 : -1;
    }
    bool negative(const Real& a) { return sign(a) < 0; }
    bool positive(const Real& a) { return sign(a) > 0; }
    bool less(const Real& a, const Real& b) { return negative(a - b); }
    void result(const Real&) {}
    bool doubt() const { return false; }
};

} // namespace raylane::core
