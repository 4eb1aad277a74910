#pragma once

#include "core/shapes/shape.hpp"

/// The shapes. Each *is* its numbers, floats or doubles: its surface is the one that real
/// arithmetic gives for exactly these values. Nothing is normalised, transformed or rounded when a
/// shape is added.
///
/// Lengths are in the scene's unit. Normals and axes may have any length but zero.
///
/// A solid (sphere, ellipsoid, box, capped cylinder, capped cone) is closed: its surface belongs to
/// it. A line that only touches it hits it, and so does a line within a face.
///
/// A surface (all other shapes) ends at its rim, and the rim belongs to it. A line that touches it
/// hits it. A line that lies in it (in a flat surface's plane, along an open cylinder's or cone's
/// side, or in a quadric) does not.
namespace raylane::core {

template <class Number>
struct SphereOf {
    Vec3<Number> center;
    Number radius; ///< > 0

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = false, .meets_again = MeetsAgain::inward};
};

/// The unbounded plane through `point`; its front is where `normal` points.
template <class Number>
struct PlaneOf {
    Vec3<Number> point;
    Vec3<Number> normal;

    static constexpr ShapeTraits traits{
        .bounded = false, .flat_faces = true, .meets_again = MeetsAgain::never};
};

template <class Number>
struct DiscOf {
    Vec3<Number> center;
    Vec3<Number> normal;
    Number radius; ///< > 0

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = true, .meets_again = MeetsAgain::never};
};

/// Front: the side from which a, b, c run counter-clockwise.
template <class Number>
struct TriangleOf {
    Vec3<Number> a, b, c;

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = true, .meets_again = MeetsAgain::never};
};

/// A triangle with a normal at each corner, interpolated for shading only; the surface is the flat
/// triangle's.
template <class Number>
struct SmoothTriangleOf {
    Vec3<Number> a, b, c;
    Vec3<Number> normal_a, normal_b, normal_c;

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = false, .meets_again = MeetsAgain::never};
};

namespace detail {

template <class Shape>
inline constexpr bool is_triangle = false;
template <class Number>
inline constexpr bool is_triangle<TriangleOf<Number>> = true;
template <class Number>
inline constexpr bool is_triangle<SmoothTriangleOf<Number>> = true;

} // namespace detail

template <class Shape>
concept AnyTriangle = detail::is_triangle<Shape>;

/// Any parallelepiped, solid: corner + u edge_u + v edge_v + w edge_w for u, v, w in [0, 1].
template <class Number>
struct BoxOf {
    Vec3<Number> corner;
    Vec3<Number> edge_u, edge_v, edge_w;

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = true, .meets_again = MeetsAgain::inward};
};

/// Points at distance `radius` from the line base + s axis, with s in [0, 1]. Capped: solid.
template <class Number, Ends ends>
struct CylinderOf {
    Vec3<Number> base;
    Vec3<Number> axis;
    Number radius; ///< > 0

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = false, .meets_again = MeetsAgain::inward};
};

/// Points at distance base_radius + s (top_radius - base_radius) from base + s axis, s in [0, 1].
/// Capped: solid.
template <class Number, Ends ends>
struct ConeOf {
    Vec3<Number> base;
    Vec3<Number> axis;
    Number base_radius; ///< >= 0
    Number top_radius;  ///< >= 0, not both 0

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = false, .meets_again = MeetsAgain::inward};
};

/// The surface Q(p) = 0 for p = x - center, inside the axis-aligned box lower <= p <= upper, where
///   Q(p) = xx px^2 + yy py^2 + zz pz^2 + 2 (xy px py + xz px pz + yz py pz) + 2 (x px + y py + z
///   pz) + one,
/// that is (p, 1) M (p, 1)^T for the symmetric 4x4 matrix M. Its outside is where Q > 0.
template <class Number>
struct QuadricOf {
    Vec3<Number> center;
    Number xx, yy, zz, xy, xz, yz, x, y, z, one;
    Vec3<Number> lower, upper;

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = false, .meets_again = MeetsAgain::always};
};

/// The points center + a axis_u + b axis_v + c axis_w with a^2 + b^2 + c^2 <= 1, solid. The
/// semi-axes span a volume; they need not be perpendicular to each other.
template <class Number>
struct EllipsoidOf {
    Vec3<Number> center;
    Vec3<Number> axis_u, axis_v, axis_w;

    static constexpr ShapeTraits traits{
        .bounded = true, .flat_faces = false, .meets_again = MeetsAgain::inward};
};

template <class Shape>
inline constexpr bool is_bounded = Shape::traits.bounded;

/// True for solids: shapes that enclose an inside by themselves.
template <class Shape>
inline constexpr bool is_solid =
    kind_of<Shape> == Kind::sphere || kind_of<Shape> == Kind::ellipsoid ||
    kind_of<Shape> == Kind::box || kind_of<Shape> == Kind::capped_cylinder ||
    kind_of<Shape> == Kind::capped_cone;

/// True for possible parts of a solid: solids, and shapes with a half-space on their inside.
template <class Shape>
inline constexpr bool has_inside =
    is_solid<Shape> || kind_of<Shape> == Kind::plane || kind_of<Shape> == Kind::quadric;

constexpr const ShapeTraits& traits_of(Kind kind) {
    return with_shape_type(kind, []<class Shape>(std::type_identity<Shape>) -> const ShapeTraits& {
        return Shape::traits;
    });
}

/// Re-entry: returns true if a ray that leaves a shape may meet it again.
constexpr bool may_meet_again(Kind kind, bool inward) {
    const MeetsAgain rays = traits_of(kind).meets_again;
    return rays == MeetsAgain::always || (rays == MeetsAgain::inward && inward);
}

} // namespace raylane::core
