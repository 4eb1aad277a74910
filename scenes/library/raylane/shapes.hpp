#pragma once

#include "raylane/api.h"
#include "raylane/vector.hpp"

#include <concepts>
#include <cstdint>
#include <limits>

/// The shapes, of floats (Sphere) or of doubles (SphereOf<double>). Each *is* its numbers: the
/// surface meant is the one that real arithmetic gives for exactly these values. A scene whose
/// numbers are all floats, of either type, takes the least memory and time.
///
/// Coordinates and lengths are from -1e30 to 1e30, and doubles that are no floats at least 1.2e-38
/// in size. Normals and axes may have any length but zero.
/// A solid (sphere, ellipsoid, box, capped cylinder, capped cone) is closed: its surface belongs to
/// it, a line that only touches it hits it, as does one within a face. A surface (the others) ends
/// at its rim, and the rim belongs to it. A line that touches it hits it; one that lies in it, in a
/// flat surface's plane, along an open cylinder's or cone's side or in a quadric, does not.
namespace RAYLANE_API raylane {

template <class Number>
struct SphereOf {
    Vec3Of<Number> center;
    Number radius = 0; ///< > 0
};

/// The unbounded plane through `point`; its front is where `normal` points.
template <class Number>
struct PlaneOf {
    Vec3Of<Number> point;
    Vec3Of<Number> normal;
};

template <class Number>
struct DiscOf {
    Vec3Of<Number> center;
    Vec3Of<Number> normal; ///< points to its front
    Number radius = 0;     ///< > 0
};

/// Front: the side from which a, b, c run counter-clockwise. They are not in one line.
template <class Number>
struct TriangleOf {
    Vec3Of<Number> a, b, c;
};

/// A triangle with a normal at each corner, interpolated for shading only; the surface is the flat
/// triangle's.
template <class Number>
struct SmoothTriangleOf {
    Vec3Of<Number> a, b, c;
    Vec3Of<Number> normal_a, normal_b, normal_c;
};

/// Any parallelepiped, solid: corner + u edge_u + v edge_v + w edge_w for u, v, w in [0, 1]. The
/// edges span a volume.
template <class Number>
struct BoxOf {
    Vec3Of<Number> corner;
    Vec3Of<Number> edge_u, edge_v, edge_w;
};

/// Points at distance `radius` from the line base + s axis, with s in [0, 1]. A surface without
/// ends.
template <class Number>
struct OpenCylinderOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number radius = 0; ///< > 0
};

/// The solid between an OpenCylinder and the discs that close it.
template <class Number>
struct CappedCylinderOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number radius = 0; ///< > 0
};

/// Points at distance base_radius + s (top_radius - base_radius) from base + s axis, s in [0, 1]. A
/// surface without ends.
template <class Number>
struct OpenConeOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number base_radius = 0; ///< >= 0
    Number top_radius = 0;  ///< >= 0, not both 0
};

/// The solid between an OpenCone and the discs that close it: a cone, or its frustum.
template <class Number>
struct CappedConeOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number base_radius = 0; ///< >= 0
    Number top_radius = 0;  ///< >= 0, not both 0
};

/// The surface Q(p) = 0 for p = x - center, inside the axis-aligned box lower <= p <= upper, where
///   Q(p) = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz)
///        + 2 (x px + y py + z pz) + one,
/// that is (p, 1) M (p, 1)^T for the symmetric 4x4 matrix M. Its outside is where Q > 0.
template <class Number>
struct QuadricOf {
    Vec3Of<Number> center;
    Number xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
    Number x = 0, y = 0, z = 0, one = 0;
    Vec3Of<Number> lower, upper; ///< lower < upper on each axis
};

/// The points center + a axis_u + b axis_v + c axis_w with a^2 + b^2 + c^2 <= 1, solid. The
/// semi-axes span a volume; they need not be perpendicular to each other.
template <class Number>
struct EllipsoidOf {
    Vec3Of<Number> center;
    Vec3Of<Number> axis_u, axis_v, axis_w;
};

using Sphere = SphereOf<float>;
using Plane = PlaneOf<float>;
using Disc = DiscOf<float>;
using Triangle = TriangleOf<float>;
using SmoothTriangle = SmoothTriangleOf<float>;
using Box = BoxOf<float>;
using OpenCylinder = OpenCylinderOf<float>;
using CappedCylinder = CappedCylinderOf<float>;
using OpenCone = OpenConeOf<float>;
using CappedCone = CappedConeOf<float>;
using Quadric = QuadricOf<float>;
using Ellipsoid = EllipsoidOf<float>;

namespace detail {

template <class>
inline constexpr bool is_shape = false;
template <class Number>
inline constexpr bool is_shape<SphereOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<PlaneOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<DiscOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<TriangleOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<SmoothTriangleOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<BoxOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<OpenCylinderOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<CappedCylinderOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<OpenConeOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<CappedConeOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<QuadricOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;
template <class Number>
inline constexpr bool is_shape<EllipsoidOf<Number>> =
    std::same_as<Number, float> || std::same_as<Number, double>;

} // namespace detail

/// Shapes that a scene can be made of.
template <class Shape>
concept AnyShape = detail::is_shape<Shape>;

/// The number of a shape in its scene: 0, 1, 2, ... in the order in which shapes were added. In a
/// scene from a file, the order of the file.
using ShapeId = std::uint32_t;

/// The id that no shape has: what a ray that hits nothing has hit.
inline constexpr ShapeId no_shape = std::numeric_limits<ShapeId>::max();

} // namespace raylane
