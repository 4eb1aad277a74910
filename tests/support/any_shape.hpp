#pragma once

#include "tests/shapes/shapes.hpp"

#include <concepts>
#include <type_traits>
#include <vector>

/// Functions for shapes of any kind.
namespace raylane::tests {

inline core::Kind kind_of(const AnyShape& any) {
    return std::visit([]<class Shape>(const Shape&) { return core::kind_of<Shape>; }, any);
}

/// Returns whether the shape is Solid, Flat or Curved.
template <class Sort>
bool is_a(const AnyShape& any) {
    return std::visit(
        []<class Shape>(const Shape&) { return std::is_base_of_v<Sort, Nature<Shape>>; }, any);
}
inline bool may_come_back(const AnyShape& any) {
    return std::visit([]<class Shape>(const Shape&) { return Nature<Shape>::may_come_back; }, any);
}

inline bool is_bounded_kind(core::Kind kind) {
    return core::with_shape_type(
        kind, []<class Shape>(std::type_identity<Shape>) { return Nature<Shape>::is_bounded; });
}

inline AnyShape placed(const AnyShape& any, const Placing& by) {
    return std::visit([&](const auto& shape) { return AnyShape(by(shape)); }, any);
}

} // namespace raylane::tests

namespace raylane::oracle {

using tests::AnyShape, tests::AnyShapeInDouble;

template <class Any>
concept Variant = std::same_as<Any, AnyShape> || std::same_as<Any, AnyShapeInDouble>;

// Templates, so that a shape whose file lacks the function is not converted to a variant.
template <Variant Any>
std::vector<Hit> crossings(const Any& any, const core::Ray<double>& ray) {
    return std::visit([&](const auto& shape) { return crossings(shape, ray); }, any);
}
template <Variant Any>
Normal normal(const Any& any, const core::Ray<double>& ray, const Hit& hit) {
    return std::visit([&](const auto& shape) { return normal(shape, ray, hit); }, any);
}
template <Variant Any>
Ball ball_around(const Any& any) {
    return std::visit([](const auto& shape) { return ball_around(shape); }, any);
}

} // namespace raylane::oracle
