#pragma once

#include "core/kinds.hpp"
#include "tests/shapes/box.hpp"
#include "tests/shapes/cone.hpp"
#include "tests/shapes/cylinder.hpp"
#include "tests/shapes/disc.hpp"
#include "tests/shapes/ellipsoid.hpp"
#include "tests/shapes/plane.hpp"
#include "tests/shapes/quadric.hpp"
#include "tests/shapes/sphere.hpp"
#include "tests/shapes/triangle.hpp"

#include <concepts>
#include <tuple>
#include <type_traits>

/// Includes everything that tests know of shapes, and lists the shapes to test.
namespace raylane::tests {

#define RAYLANE_THEN(Shape, name, text) , Shape
#define RAYLANE_BUT_FIRST(first, ...) __VA_ARGS__
#define RAYLANE_BUT_FIRST_OF(...) RAYLANE_BUT_FIRST(__VA_ARGS__)
/// List for TEMPLATE_TEST_CASE, by the names within raylane::core. If the list were a type, Catch2
/// would number the tests.
#define RAYLANE_ALL_SHAPES RAYLANE_BUT_FIRST_OF(none RAYLANE_SHAPES(RAYLANE_THEN))

namespace detail {

template <class Sort, class Shapes>
struct AllOf;
template <class Sort, class... Shapes>
struct AllOf<Sort, std::tuple<Shapes...>> {
    using Type =
        decltype(std::tuple_cat(std::conditional_t<std::is_base_of_v<Sort, Nature<Shapes>>,
                                                   std::tuple<Shapes>, std::tuple<>>()...));
};

} // namespace detail

/// List for TEMPLATE_LIST_TEST_CASE: all shapes of one sort, which is Solid, Flat or Curved.
template <class Sort>
using AllOf = typename detail::AllOf<Sort, core::Shapes>::Type;
using AllSolids = AllOf<Solid>;
using AllFlat = AllOf<Flat>;
using AllCurved = AllOf<Curved>;

template <class Shape>
inline constexpr bool is_solid = std::is_base_of_v<Solid, Nature<Shape>>;
template <class Shape>
inline constexpr bool is_flat = std::is_base_of_v<Flat, Nature<Shape>>;
template <class Shape>
inline constexpr bool is_bounded = Nature<Shape>::is_bounded;

} // namespace raylane::tests

/// Shapes of floats are tested as shapes of the same doubles.
namespace raylane::oracle {

template <class Shape>
concept InFloats = std::same_as < core::NumberOf<Shape>,
float > ;

template <InFloats Shape, class Real>
std::vector<Hit> crossings(const Shape& shape, const core::Ray<Real>& ray) {
    return crossings(core::to_doubles(shape), ray);
}
template <InFloats Shape, class Real>
Normal normal(const Shape& shape, const core::Ray<Real>& ray, const Hit& hit) {
    return normal(core::to_doubles(shape), ray, hit);
}
template <InFloats Shape>
Ball ball_around(const Shape& shape) {
    return ball_around(core::to_doubles(shape));
}

} // namespace raylane::oracle
