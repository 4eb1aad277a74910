#pragma once

#include "core/shapes/box.hpp"
#include "core/shapes/cone.hpp"
#include "core/shapes/cylinder.hpp"
#include "core/shapes/disc.hpp"
#include "core/shapes/ellipsoid.hpp"
#include "core/shapes/plane.hpp"
#include "core/shapes/quadric.hpp"
#include "core/shapes/sphere.hpp"
#include "core/shapes/triangle.hpp"

/// The shapes. Each *is* its numbers, floats or doubles: the surface meant is the one that real
/// arithmetic gives for exactly these values. Nothing is normalised, transformed or rounded on the
/// way in.
///
/// Lengths are in the scene's unit. Normals and axes may have any length but zero.
/// A solid (sphere, ellipsoid, box, capped cylinder, capped cone) is closed: its surface belongs to
/// it, a line that only touches it hits it, as does one within a face. A surface (the others) ends
/// at its rim, and the rim belongs to it. A line that touches it hits it; one that lies in it, in a
/// flat surface's plane, along an open cylinder's or cone's side or in a quadric, does not.
namespace raylane::core {

template <class Shape>
inline constexpr bool is_bounded = Shape::traits.bounded;

/// True for solids, which by themselves have an inside.
template <class Shape>
inline constexpr bool is_solid =
    kind_of<Shape> == Kind::sphere || kind_of<Shape> == Kind::ellipsoid ||
    kind_of<Shape> == Kind::box || kind_of<Shape> == Kind::capped_cylinder ||
    kind_of<Shape> == Kind::capped_cone;

/// True for what may be a part of a solid: solids, and what has a half-space on its inside.
template <class Shape>
inline constexpr bool has_inside =
    is_solid<Shape> || kind_of<Shape> == Kind::plane || kind_of<Shape> == Kind::quadric;

constexpr const ShapeTraits& traits_of(Kind kind) {
    return with_shape_type(kind, []<class Shape>(std::type_identity<Shape>) -> const ShapeTraits& {
        return Shape::traits;
    });
}

/// Re-entry: true where a ray that leaves a shape may meet it again.
constexpr bool may_meet_again(Kind kind, bool inward) {
    const MeetsAgain rays = traits_of(kind).meets_again;
    return rays == MeetsAgain::always || (rays == MeetsAgain::inward && inward);
}

/// True if a shape is shaded by other normals than its own.
template <class Shape>
inline constexpr bool has_shading_normals = requires(const Shape& shape, const Vec3d& point) {
    shading_normal(shape, point);
};

/// The unit normal to shade with, given that of the surface.
template <class Real, class Shape>
Vec3<Real> shading_normal_at(const Shape& shape, const Vec3<Real>& point,
                             const Vec3<Real>& normal) {
    if constexpr (has_shading_normals<Shape>)
        return shading_normal(shape, point);
    else
        return normal;
}

} // namespace raylane::core
