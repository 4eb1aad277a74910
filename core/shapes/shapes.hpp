#pragma once

#include "core/kinds.hpp"
#include "core/numbers/vector.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>

/// The shapes. Each *is* its floats: the surface meant is the one that real arithmetic gives for
/// exactly these values. Nothing is normalised, transformed or rounded on the way in.
///
/// Lengths are in the scene's unit. Normals and axes may have any length but zero.
/// A solid (sphere, box, capped cylinder, capped cone) is closed: its surface belongs to it, a line
/// that only touches it hits it, as does one within a face. A surface (the others) ends at its rim,
/// and the rim belongs to it. A line that touches it hits it; one that lies in it, in a flat
/// surface's plane, along an open cylinder's or cone's side or in a quadric, does not.
namespace raylane::core {

struct Sphere {
    Vec3f center;
    float radius; ///< > 0
};

/// The unbounded plane through `point`; its front is where `normal` points.
struct Plane {
    Vec3f point;
    Vec3f normal;
};

struct Disc {
    Vec3f center;
    Vec3f normal;
    float radius; ///< > 0
};

/// Front: the side from which a, b, c run counter-clockwise.
struct Triangle {
    Vec3f a, b, c;
};

/// A triangle with a normal at each corner, interpolated for shading only; the surface is the flat
/// triangle's.
struct SmoothTriangle {
    Vec3f a, b, c;
    Vec3f normal_a, normal_b, normal_c;
};

/// Any parallelepiped, solid: corner + u edge_u + v edge_v + w edge_w for u, v, w in [0, 1].
struct Box {
    Vec3f corner;
    Vec3f edge_u, edge_v, edge_w;
};

/// Points at distance `radius` from the line base + s axis, with s in [0, 1]. Capped: solid.
template <Ends ends>
struct Cylinder {
    Vec3f base;
    Vec3f axis;
    float radius; ///< > 0
};

/// Points at distance base_radius + s (top_radius - base_radius) from base + s axis, s in [0, 1].
/// Capped: solid.
template <Ends ends>
struct Cone {
    Vec3f base;
    Vec3f axis;
    float base_radius; ///< >= 0
    float top_radius;  ///< >= 0, not both 0
};

/// The surface Q(p) = 0 for p = x - center, inside the axis-aligned box lower <= p <= upper, where
///   Q(p) = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz) + 2 (x px + y py + z
///   pz) + one,
/// that is (p, 1) M (p, 1)^T for the symmetric 4x4 matrix M. Its outside is where Q > 0.
struct Quadric {
    Vec3f center;
    float xx, yy, zz, xy, xz, yz, x, y, z, one;
    Vec3f lower, upper;
};

/// How many floats a shape is.
template <class Shape>
inline constexpr int float_count = sizeof(Shape) / sizeof(float);

template <class Shape>
using Floats = std::array<float, float_count<Shape>>;

template <class Shape>
Floats<Shape> floats_of(const Shape& shape) {
    return std::bit_cast<Floats<Shape>>(shape);
}

template <class Shape>
Shape shape_of(const Floats<Shape>& floats) {
    return std::bit_cast<Shape>(floats);
}

/// The number of a shape in its scene: 0, 1, 2, ... in the order in which shapes were added.
using ShapeId = std::uint32_t;
inline constexpr ShapeId no_shape = std::numeric_limits<ShapeId>::max();

/// A range of shape ids, first to last.
struct IdRange {
    ShapeId first;
    ShapeId last;

    /// Wraps below `first`, so that one comparison does.
    bool contains(ShapeId id) const { return id - first <= last - first; }
};

/// The one of some ranges, ascending, that has an id; null if none has.
inline const IdRange* range_with(std::span<const IdRange> ranges, ShapeId id) {
    const auto after =
        std::upper_bound(ranges.begin(), ranges.end(), id,
                         [](ShapeId value, const IdRange& range) { return value < range.first; });
    if (after == ranges.begin() || !std::prev(after)->contains(id)) return nullptr;
    return &*std::prev(after);
}

} // namespace raylane::core
