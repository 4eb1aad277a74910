#pragma once

#include "core/shapes/judge.hpp"
#include "core/shapes/normal.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

/// A ray against one shape, with a stated accuracy.
namespace raylane::core {

/// float: the solver's formulas as they are, or the textbooks'. What the vector kernels reproduce
/// to the bit; its decisions and its t are as good as the formulas (see each solver). What is not
/// `fast` is robust.
template <class Shape>
Crossings<float> solve(const Shape& shape, const Ray<float>& ray, const Start& start,
                       std::uint64_t&, Precision precision = Precision::robust) {
    Judge<float> judge(precision);
    return crossings(shape, ray, start, judge);
}

namespace detail {

template <class T, class Shape>
Crossings<double> solve_bounded(const Shape& shape, const Ray<double>& ray, const Start& start,
                                Judge<Bounded<T>>& judge) {
    using Real = Bounded<T>;
    const Ray<Real> wide{convert<Real>(ray.origin), convert<Real>(ray.direction)};
    Crossings<double> result;
    for (const Crossing<Real>& crossing : crossings(shape, wide, start, judge)) {
        const int side = start.on_surface ? 1 : judge.sign(crossing.t);
        const Bounded<double> t = in_double(crossing.t);
        if (side > 0) judge.result(t);
        result.add({side == 0 ? 0.0 : t.value, crossing.face, crossing.entering, t.error});
    }
    return result;
}

template <class Shape>
Crossings<double> solve_exactly(const Shape& shape, const Ray<double>& ray, const Start& start) {
    constexpr double accuracy = 0x1p-48; // of an Exact as a double
    Crossings<double> result;
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(ray.origin[axis]) || !std::isfinite(ray.direction[axis])) return result;
    Judge<Exact> judge;
    const Ray<Exact> exact{convert<Exact>(ray.origin), convert<Exact>(ray.direction)};
    double last = -std::numeric_limits<double>::infinity();
    for (const Crossing<Exact>& crossing : crossings(shape, exact, start, judge)) {
        last = std::max(last, static_cast<double>(crossing.t)); // rounding swaps no crossings
        result.add({last, crossing.face, crossing.entering, accuracy * std::abs(last)});
    }
    return result;
}

} // namespace detail

/// double: decisions as real arithmetic takes them, and t within 2^-27 of itself. In double with
/// error bounds first; where these leave a doubt, once more in double-double, which `widened`
/// counts; and where a ray is tangent, or meets a rim or an edge, to more digits than that, in
/// integers of any size. Or, as plain_double, by the formulas as they are.
template <class Shape>
Crossings<double> solve(const Shape& shape, const Ray<double>& ray, const Start& start,
                        std::uint64_t& widened, Precision precision = Precision::exact) {
    if (precision == Precision::plain_double) {
        Judge<double> plain;
        return crossings(shape, ray, start, plain);
    }
    Judge<Bounded<double>> judge;
    const Crossings<double> result = detail::solve_bounded<double>(shape, ray, start, judge);
    if (!judge.doubt()) [[likely]]
        return result;
    ++widened;
    Judge<Bounded<DoubleDouble>> wide_judge;
    const Crossings<double> wide =
        detail::solve_bounded<DoubleDouble>(shape, ray, start, wide_judge);
    return wide_judge.doubt() ? detail::solve_exactly(shape, ray, start) : wide;
}

} // namespace raylane::core
