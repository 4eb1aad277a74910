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

/// The shapes with their formulas. types.hpp has the types alone.
namespace raylane::core {

/// True if the normals for shading differ from those of the surface.
template <class Shape>
inline constexpr bool has_shading_normals = requires(const Shape& shape, const Vec3d& point) {
    shading_normal(shape, point);
};

/// Returns the unit normal for shading, given that of the surface.
template <class Real, class Shape>
Vec3<Real> shading_normal_at(const Shape& shape, const Vec3<Real>& point,
                             const Vec3<Real>& normal) {
    if constexpr (has_shading_normals<Shape>)
        return shading_normal(shape, point);
    else
        return normal;
}

} // namespace raylane::core
