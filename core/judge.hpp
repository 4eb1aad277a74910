#pragma once

#include "core/bounded.hpp"
#include "core/exact.hpp"
#include "core/precision.hpp"
#include "core/ray.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace raylane::core {

/// Answers the yes-or-no questions that a solver asks of its numbers. For a plain real type the
/// answer is the number's own. For numbers with bounds it remembers whether any answer was within
/// the error.
template <class Real>
class Judge {
  public:
    Judge() = default;
    explicit Judge(Precision precision) : textbook_(precision == Precision::fast) {}

    /// Whether to use the textbooks' formulas.
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

  private:
    bool textbook_ = false;
};

/// The relative accuracy that a t must have: an eighth of half an ulp of float, so that it rounds
/// to the right float or to a neighbour.
inline constexpr double needed_accuracy = 0x1p-27;

/// Whether a t that is off by `error` leads to a point that is off by no more than an ulp of float
/// of its largest coordinate; or, near the coordinates' origin, by no more than double cannot help.
/// The direction may have any length. The lanes' twin (simd/kernel/finishers) knows that it is 1,
/// and may grant a little more.
inline bool holds_point(const Ray<double>& ray, double t, double error) {
    const auto sum = [](const Vec3d& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
    const Vec3d point = mul_add(t, ray.direction, ray.origin);
    const double largest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    const double speed = sum(ray.direction), off = error * speed;
    return off <= 0x1p-24 * largest || off <= 0x1p-49 * (sum(ray.origin) + t * speed);
}

/// With bounds: an answer within the error, or a t that is not accurate enough, is a doubt, and the
/// question has to be asked again in a wider type.
template <class T>
class Judge<Bounded<T>> {
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
    /// To be called of every t that is a result, with the ray that leads there.
    void result(const Real& t, const Ray<double>& ray) {
        doubt_ |= !(t.error <= needed_accuracy * t.magnitude());
        doubt_ |= !holds_point(ray, static_cast<double>(t), t.error);
    }
    bool doubt() const { return doubt_; }

  private:
    bool doubt_ = false;
};

} // namespace raylane::core
