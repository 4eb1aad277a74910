#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/types.hpp"

#include <cstdint>
#include <type_traits>

/// A ray against one shape, with a stated accuracy.
namespace raylane::core {

template <class Shape>
inline constexpr bool is_of_doubles = std::is_same_v<NumberOf<Shape>, double>;
template <class Shape>
concept OfDoubles = is_of_doubles<Shape>;

/// float: the solver's formulas as they are, or the textbooks'. What the vector kernels reproduce
/// to the bit; its decisions and its t are as good as the formulas (see each solver). What is not
/// `fast` is robust.
template <OfDoubles Shape>
Crossings<float> solve(const Shape& shape, const Ray<float>& ray, const Start& start,
                       std::uint64_t& widened, Precision precision = Precision::robust);

/// double: decisions as real arithmetic takes them, and t within 2^-27 of itself. In double with
/// error bounds first; where these leave a doubt, once more in double-double, which `widened`
/// counts; and where a ray is tangent, or meets a rim or an edge, to more digits than that, in
/// integers of any size. Or, as plain_double, by the formulas as they are.
template <OfDoubles Shape>
Crossings<double> solve(const Shape& shape, const Ray<double>& ray, const Start& start,
                        std::uint64_t& widened, Precision precision = Precision::exact);

/// Both are compiled for shapes of doubles. Shapes of floats are converted, which is exact.
template <class Shape, class Real>
Crossings<Real> solve(const Shape& shape, const Ray<Real>& ray, const Start& start,
                      std::uint64_t& widened, Precision precision = precision_of<Real>) {
    return solve(to_doubles(shape), ray, start, widened, precision);
}

} // namespace raylane::core
