#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/types.hpp"

#include <cstdint>
#include <type_traits>

/// Intersects a ray with one shape, with a stated accuracy.
namespace raylane::core {

template <class Shape>
inline constexpr bool is_of_doubles = std::is_same_v<NumberOf<Shape>, double>;
template <class Shape>
concept OfDoubles = is_of_doubles<Shape>;

/// float: the solver's formulas as they are, or the textbook formulas if `precision` is `fast`. All
/// other precisions count as robust. The vector kernels reproduce the result to the bit. Decisions
/// and t are as accurate as the formulas (see each solver).
template <OfDoubles Shape>
Crossings<float> solve(const Shape& shape, const Ray<float>& ray, const Start& start,
                       std::uint64_t& widened, Precision precision = Precision::robust);

/// double: decides as real arithmetic does, with a relative error of t of at most 2^-27. Computes
/// in double with error bounds first. If these leave a doubt, it computes again in double-double,
/// which `widened` counts. If a ray is tangent or meets a rim or an edge beyond those digits, it
/// computes in integers of any size. With plain_double, it uses the formulas as they are. The ray
/// may be any doubles, however large or small. A t beyond the range of doubles is the largest
/// double, with an infinite error; a t that underflows is the smallest double.
template <OfDoubles Shape>
Crossings<double> solve(const Shape& shape, const Ray<double>& ray, const Start& start,
                        std::uint64_t& widened, Precision precision = Precision::exact);

/// Converts shapes of floats to doubles, which is exact: both functions are compiled for doubles.
template <class Shape, class Real>
Crossings<Real> solve(const Shape& shape, const Ray<Real>& ray, const Start& start,
                      std::uint64_t& widened, Precision precision = precision_of<Real>) {
    return solve(to_doubles(shape), ray, start, widened, precision);
}

} // namespace raylane::core
