#pragma once

#include "raylane/api.h"
#include "raylane/vector.hpp"

#include <concepts>
#include <cstdint>
#include <limits>

/// The shapes. Each *is* its floats: the surface meant is the one that real arithmetic gives for
/// exactly these values.
///
/// Coordinates and lengths are from -1e30 to 1e30. Normals and axes may have any length but zero.
/// A solid (sphere, ellipsoid, box, capped cylinder, capped cone) is closed: its surface belongs to
/// it, a line that only touches it hits it, as does one within a face. A surface (the others) ends
/// at its rim, and the rim belongs to it. A line that touches it hits it; one that lies in it, in a
/// flat surface's plane, along an open cylinder's or cone's side or in a quadric, does not.
namespace RAYLANE_API raylane {

struct Sphere {
    Vec3 center;
    float radius = 0.0F; ///< > 0
};

/// The unbounded plane through `point`; its front is where `normal` points.
struct Plane {
    Vec3 point;
    Vec3 normal;
};

struct Disc {
    Vec3 center;
    Vec3 normal;         ///< points to its front
    float radius = 0.0F; ///< > 0
};

/// Front: the side from which a, b, c run counter-clockwise. They are not in one line.
struct Triangle {
    Vec3 a, b, c;
};

/// A triangle with a normal at each corner, interpolated for shading only; the surface is the flat
/// triangle's.
struct SmoothTriangle {
    Vec3 a, b, c;
    Vec3 normal_a, normal_b, normal_c;
};

/// Any parallelepiped, solid: corner + u edge_u + v edge_v + w edge_w for u, v, w in [0, 1]. The
/// edges span a volume.
struct Box {
    Vec3 corner;
    Vec3 edge_u, edge_v, edge_w;
};

/// Points at distance `radius` from the line base + s axis, with s in [0, 1]. A surface without
/// ends.
struct OpenCylinder {
    Vec3 base;
    Vec3 axis;
    float radius = 0.0F; ///< > 0
};

/// The solid between an OpenCylinder and the discs that close it.
struct CappedCylinder {
    Vec3 base;
    Vec3 axis;
    float radius = 0.0F; ///< > 0
};

/// Points at distance base_radius + s (top_radius - base_radius) from base + s axis, s in [0, 1]. A
/// surface without ends.
struct OpenCone {
    Vec3 base;
    Vec3 axis;
    float base_radius = 0.0F; ///< >= 0
    float top_radius = 0.0F;  ///< >= 0, not both 0
};

/// The solid between an OpenCone and the discs that close it: a cone, or its frustum.
struct CappedCone {
    Vec3 base;
    Vec3 axis;
    float base_radius = 0.0F; ///< >= 0
    float top_radius = 0.0F;  ///< >= 0, not both 0
};

/// The surface Q(p) = 0 for p = x - center, inside the axis-aligned box lower <= p <= upper, where
///   Q(p) = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz)
///        + 2 (x px + y py + z pz) + one,
/// that is (p, 1) M (p, 1)^T for the symmetric 4x4 matrix M. Its outside is where Q > 0.
struct Quadric {
    Vec3 center;
    float xx = 0.0F, yy = 0.0F, zz = 0.0F, xy = 0.0F, xz = 0.0F, yz = 0.0F;
    float x = 0.0F, y = 0.0F, z = 0.0F, one = 0.0F;
    Vec3 lower, upper; ///< lower < upper on each axis
};

/// The points center + a axis_u + b axis_v + c axis_w with a^2 + b^2 + c^2 <= 1, solid. The
/// semi-axes span a volume; they need not be perpendicular to each other.
struct Ellipsoid {
    Vec3 center;
    Vec3 axis_u, axis_v, axis_w;
};

/// Shapes that a scene can be made of.
template <class Shape>
concept AnyShape = std::same_as<Shape, Sphere> || std::same_as<Shape, Plane> ||
    std::same_as<Shape, Disc> || std::same_as<Shape, Triangle> ||
    std::same_as<Shape, SmoothTriangle> || std::same_as<Shape, Box> ||
    std::same_as<Shape, OpenCylinder> || std::same_as<Shape, CappedCylinder> ||
    std::same_as<Shape, OpenCone> || std::same_as<Shape, CappedCone> ||
    std::same_as<Shape, Quadric> || std::same_as<Shape, Ellipsoid>;

/// The number of a shape in its scene: 0, 1, 2, ... in the order in which shapes were added. In a
/// scene from a file, the order of the file.
using ShapeId = std::uint32_t;

/// The id that no shape has: what a ray that hits nothing has hit.
inline constexpr ShapeId no_shape = std::numeric_limits<ShapeId>::max();

} // namespace raylane
