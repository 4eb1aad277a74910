#pragma once

#include "core/scene/validate.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/fuzz/bytes.hpp"
#include "tests/support/any_shape.hpp"

#include <algorithm>
#include <utility>
#include <vector>

/// Shapes and rays from any bytes. They often touch each other.
namespace raylane::fuzz {

using tests::AnyShape, tests::AnyShapeInDouble;

/// Returns a shape of any numbers. Wrong signs and orders are corrected.
template <class Shape>
Shape shape_of(Bytes& bytes) {
    using Number = core::NumberOf<Shape>;
    auto numbers = core::numbers_of(Shape{});
    for (Number& number : numbers)
        number = bytes.number<Number>();
    constexpr core::Kind kind = core::kind_of<Shape>;
    auto* const last = &numbers.back();
    if constexpr (kind == core::Kind::quadric)
        for (int axis = 0; axis < 3; ++axis) {
            if (last[axis - 2] < last[axis - 5]) std::swap(last[axis - 2], last[axis - 5]);
        }
    else if constexpr (kind == core::Kind::sphere || kind == core::Kind::disc ||
                       kind == core::Kind::open_cylinder || kind == core::Kind::capped_cylinder)
        last[0] = std::abs(last[0]);
    else if constexpr (kind == core::Kind::open_cone || kind == core::Kind::capped_cone)
        for (int i : {0, -1})
            last[i] = std::abs(last[i]);
    return core::shape_of<Shape>(numbers);
}

template <class Any>
Any any_shape(Bytes& bytes) {
    return core::with_shape_type(static_cast<core::Kind>(bytes.below(core::kind_count)),
                                 [&]<class Shape>(std::type_identity<Shape>) {
                                     if constexpr (std::is_same_v<Any, AnyShape>)
                                         return Any(fuzz::shape_of<Shape>(bytes));
                                     else
                                         return Any(fuzz::shape_of<core::InDouble<Shape>>(bytes));
                                 });
}

/// Returns the shape with three of its numbers changed.
template <class Any>
Any changed(Any any, Bytes& bytes, int times = 1) {
    const int first = bytes.below(4);
    std::visit(
        [&]<class Shape>(Shape& shape) {
            using Number = core::NumberOf<Shape>;
            auto numbers = core::numbers_of(shape);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t which = static_cast<std::size_t>(3 * first) + i;
                if (which < numbers.size())
                    numbers[which] += bytes.number<Number>() * static_cast<Number>(times);
            }
            shape = core::shape_of<Shape>(numbers);
        },
        any);
    return any;
}

inline bool is_valid(const auto& any) {
    try {
        std::visit([](const auto& shape) { core::validate(shape); }, any);
        return true;
    } catch (const core::InvalidValue&) {
        return false;
    }
}

/// Returns some shapes. Many have something in common with an earlier one. Others form rows, which
/// need a hierarchy.
template <class Any>
std::vector<Any> shapes_of(Bytes& bytes) {
    std::vector<Any> shapes;
    constexpr std::size_t most = 60;
    const int steps = 1 + bytes.below(8);
    for (int step = 0; step < steps && shapes.size() < most; ++step) {
        const int way = bytes.below(8);
        if (shapes.empty() || way < 4) {
            shapes.push_back(any_shape<Any>(bytes));
        } else if (way < 7) {
            const auto which = static_cast<std::size_t>(bytes.byte()) % shapes.size();
            shapes.push_back(changed(shapes[which], bytes));
        } else {
            Any next = shapes.back();
            const Bytes by = bytes;
            for (int i = bytes.below(40); i > 0; --i) {
                bytes = by;
                bytes.byte();
                next = changed(next, bytes);
                shapes.push_back(next);
            }
        }
    }
    std::erase_if(shapes, [](const Any& any) { return !is_valid(any); });
    return shapes;
}

/// Returns a point from a shape's numbers, such as its centre or its corner.
template <class Any>
core::Vec3d point_of(const Any& any, int which) {
    return std::visit(
        [&](const auto& shape) {
            const auto numbers = core::numbers_of(shape);
            core::Vec3d point(0.0);
            for (int part = 0; part <= which % 3; ++part) // with edges and axes, further points
                for (int axis = 0; axis < 3; ++axis) {
                    const auto i = static_cast<std::size_t>(3 * part + axis);
                    if (i < numbers.size()) point[axis] += static_cast<double>(numbers[i]);
                }
            return point;
        },
        any);
}

/// Returns a ray from anywhere or from a shape, to anywhere or to a shape.
template <class Real, class Any>
core::Ray<Real> ray_of(Bytes& bytes, const std::vector<Any>& shapes) {
    const int way = bytes.below(8);
    const auto end = [&](bool at_shape) {
        if (!at_shape || shapes.empty()) return bytes.vector<Real>();
        const auto which = static_cast<std::size_t>(bytes.byte());
        return core::Vec3<Real>(
            core::convert<Real>(point_of(shapes[which % shapes.size()], bytes.byte())));
    };
    const core::Vec3<Real> origin = end(way == 7);
    core::Vec3<Real> direction = end(way >= 4);
    if (way >= 4) direction = direction - origin;
    return {origin, direction};
}

/// Returns whether a ray in double, and a scene, may have such numbers.
inline bool is_usual(const core::Ray<double>& ray) {
    const double longest =
        std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
    if (!(longest > 0.0)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = std::abs(ray.origin[axis]), along = std::abs(ray.direction[axis]);
        if (!(at == 0.0 || (at >= 0x1p-149 && at < 0x1p128))) return false;
        if (!(along == 0.0 || (along >= 0x1p-149 && along < 0x1p128))) return false;
    }
    return true;
}

} // namespace raylane::fuzz
