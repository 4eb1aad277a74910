#pragma once

#include "raylane/api.hpp"
#include "raylane/vector.hpp"

#include <concepts>
#include <cstdint>
#include <limits>
#include <variant>

/// Shapes, in float (Sphere) or in double (SphereOf<double>). The surface of a shape is the one
/// that real arithmetic gives for exactly its numbers. A scene takes the least memory and time if
/// all its numbers are representable as floats, whichever type holds them.
///
/// Coordinates and lengths are from -1e30 to 1e30. A double that is not representable as a float
/// must have a magnitude of at least 1.2e-38. Normals and axes may have any length except zero.
///
/// Solids (sphere, ellipsoid, box, capped cylinder, capped cone) are closed sets, which include
/// their surface. A line that only touches a solid hits it, and so does a line within a face. The
/// other shapes are surfaces. The front (outside) of a plane, disc and triangle is described below;
/// that of an open cylinder or cone faces away from the axis. A surface includes its rim. A line
/// that touches a surface hits it. A line that lies in a surface (in a flat surface's plane, along
/// the side of an open cylinder or cone, or in a quadric) does not hit it.
namespace RAYLANE_API raylane {

template <class Number>
struct SphereOf {
    Vec3Of<Number> center;
    Number radius = 0; ///< > 0
};

/// The unbounded plane through `point`. `normal` points to its front.
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

/// A triangle with the corners a, b and c, which are not collinear. Its front is the side from
/// which they run counter-clockwise.
template <class Number>
struct TriangleOf {
    Vec3Of<Number> a, b, c;
};

/// A triangle with a normal at each corner. Shading interpolates the normals; the surface is the
/// flat triangle.
template <class Number>
struct SmoothTriangleOf {
    Vec3Of<Number> a, b, c;
    Vec3Of<Number> normal_a, normal_b, normal_c;
};

/// A solid parallelepiped: the points corner + u edge_u + v edge_v + w edge_w for u, v, w in
/// [0, 1]. The edges are linearly independent.
template <class Number>
struct BoxOf {
    Vec3Of<Number> corner;
    Vec3Of<Number> edge_u, edge_v, edge_w;
};

/// The points at distance `radius` from the line base + s axis, for s in [0, 1]: a surface without
/// caps.
template <class Number>
struct OpenCylinderOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number radius = 0; ///< > 0
};

/// The solid bounded by an OpenCylinder and its two caps.
template <class Number>
struct CappedCylinderOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number radius = 0; ///< > 0
};

/// The points at distance base_radius + s (top_radius - base_radius) from base + s axis, for s in
/// [0, 1]: a surface without caps.
template <class Number>
struct OpenConeOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number base_radius = 0; ///< >= 0
    Number top_radius = 0;  ///< >= 0, not both 0
};

/// The solid bounded by an OpenCone and its caps: a cone or a frustum.
template <class Number>
struct CappedConeOf {
    Vec3Of<Number> base;
    Vec3Of<Number> axis;
    Number base_radius = 0; ///< >= 0
    Number top_radius = 0;  ///< >= 0, not both 0
};

/// The surface Q(p) = 0 for p = x - center, inside the axis-aligned box lower <= p <= upper, whose
/// corners are therefore relative to `center`:
///   Q(p) = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz)
///        + 2 (x px + y py + z pz) + one,
/// that is (p, 1) M (p, 1)^T for the symmetric 4x4 matrix M. The outside is where Q > 0.
template <class Number>
struct QuadricOf {
    Vec3Of<Number> center;
    Number xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
    Number x = 0, y = 0, z = 0, one = 0;
    Vec3Of<Number> lower, upper; ///< lower < upper on each axis
};

/// A solid ellipsoid: the points center + a axis_u + b axis_v + c axis_w with a^2 + b^2 + c^2 <= 1.
/// The semi-axes are linearly independent; they need not be perpendicular.
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

/// Returns the box with faces across the axes and these opposite corners. Throws InvalidValue,
/// field "upper/0", ..., unless lower < upper on each axis. Rounds upper - lower to doubles.
RAYLANE_API BoxOf<double> aligned_box(const Vec3Of<double>& lower, const Vec3Of<double>& upper);

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

/// The shape types that a scene accepts.
template <class Shape>
concept AnyShape = detail::is_shape<Shape>;

/// A shape of any type, in double.
using ShapeVariant =
    std::variant<SphereOf<double>, PlaneOf<double>, DiscOf<double>, TriangleOf<double>,
                 SmoothTriangleOf<double>, BoxOf<double>, OpenCylinderOf<double>,
                 CappedCylinderOf<double>, OpenConeOf<double>, CappedConeOf<double>,
                 QuadricOf<double>, EllipsoidOf<double>>;

/// The number of a shape in its scene: 0, 1, 2, ... in the order in which shapes were added or, in
/// a scene from a file, in the order of the file.
using ShapeId = std::uint32_t;

/// The id of no shape: the result for a ray that hits nothing.
inline constexpr ShapeId no_shape = std::numeric_limits<ShapeId>::max();

} // namespace raylane
