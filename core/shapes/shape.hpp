#pragma once

#include "core/kinds.hpp"
#include "core/shapes/bounds.hpp"
#include "core/shapes/checks.hpp"
#include "core/shapes/precision.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>

/// Contents of each shape's file, in this order: validate(), bounds_of() if it is bounded,
/// crossings(), outward_direction() (see shapes.hpp), form_along() and normal_along() (see
/// form.hpp), and, for solids, forms_at() (see shapes.hpp). types.hpp has its numbers and traits.
namespace raylane::core {

/// Re-entry: which rays that leave a shape may meet it again.
enum class MeetsAgain : std::uint8_t {
    never,  ///< the shape is flat
    inward, ///< rays that go to the inside of a convex surface
    always,
};

/// A trait without a default: a shape that does not state it does not compile.
template <class Value>
struct Stated {
    constexpr Stated(Value stated) : value(stated) {}         // NOLINT: allows `.bounded = true`
    constexpr operator const Value&() const { return value; } // NOLINT
    Value value;
};

/// Traits of a kind of shape that the engine needs.
struct ShapeTraits {
    Stated<bool> bounded;    ///< it has bounds, and is in the hierarchy
    Stated<bool> flat_faces; ///< normals, also for shading, are constant on a face
    Stated<MeetsAgain> meets_again;
};

/// Count of a shape's numbers.
template <class Shape>
inline constexpr int number_count = sizeof(Shape) / sizeof(NumberOf<Shape>);

template <class Shape>
using Numbers = std::array<NumberOf<Shape>, number_count<Shape>>;

template <class Shape>
Numbers<Shape> numbers_of(const Shape& shape) {
    return std::bit_cast<Numbers<Shape>>(shape);
}

template <class Shape>
Shape shape_of(const Numbers<Shape>& numbers) {
    return std::bit_cast<Shape>(numbers);
}

/// Converts a shape to another number type; each number is rounded to the nearest.
template <class To, class From>
To cast_shape(const From& shape) {
    Numbers<To> numbers;
    std::ranges::transform(numbers_of(shape), numbers.begin(),
                           [](NumberOf<From> number) { return static_cast<NumberOf<To>>(number); });
    return shape_of<To>(numbers);
}
template <class Shape>
InDouble<Shape> to_doubles(const Shape& shape) {
    return cast_shape<InDouble<Shape>>(shape);
}
template <class Shape>
InFloat<Shape> to_floats(const Shape& shape) {
    return cast_shape<InFloat<Shape>>(shape);
}

/// Returns true if all of a shape's numbers are floats.
template <class Shape>
bool is_in_floats(const Shape& shape) {
    return std::ranges::all_of(numbers_of(shape), checks::is_float<NumberOf<Shape>>);
}

/// The index of a shape in its scene: 0, 1, 2, ... in the order in which shapes were added.
using ShapeId = std::uint32_t;
inline constexpr ShapeId no_shape = std::numeric_limits<ShapeId>::max();

/// The index of a material in its scene. Arrays by shape id give the material of each shape.
using MaterialIndex = std::uint32_t;

/// A range of shape ids, including first and last.
struct IdRange {
    ShapeId first;
    ShapeId last;

    /// The difference wraps below `first`, so that one comparison is enough.
    bool contains(ShapeId id) const { return id - first <= last - first; }
};

/// Returns the range that contains an id, among ascending ranges; null if none does.
inline const IdRange* range_with(std::span<const IdRange> ranges, ShapeId id) {
    const auto after =
        std::upper_bound(ranges.begin(), ranges.end(), id,
                         [](ShapeId value, const IdRange& range) { return value < range.first; });
    if (after == ranges.begin() || !std::prev(after)->contains(id)) return nullptr;
    return &*std::prev(after);
}

} // namespace raylane::core
