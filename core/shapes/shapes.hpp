#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/dyadic.hpp"
#include "core/shapes/box.hpp"
#include "core/shapes/cone.hpp"
#include "core/shapes/cylinder.hpp"
#include "core/shapes/disc.hpp"
#include "core/shapes/ellipsoid.hpp"
#include "core/shapes/plane.hpp"
#include "core/shapes/quadric.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/sphere.hpp"
#include "core/shapes/triangle.hpp"

#include <algorithm>

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

/// Returns the outward normal of length 1. Each shape has
///   Vec3<Real> outward_direction(shape, point, face)
/// the normal outside (in front) at a point of its surface, of any length. If it may vanish, at an
/// apex, the shape also has a replacement:
///   Vec3<Real> apex_direction<Real>(shape)
template <class Real, class Shape>
Vec3<Real> outward_normal(const Shape& shape, const Vec3<Real>& point, Face face) {
    const Vec3<Real> direction = outward_direction(shape, point, face);
    if constexpr (requires { apex_direction<Real>(shape); })
        if (face == body && !(squared_length(direction) > Real(0.0)))
            return normalized(apex_direction<Real>(shape));
    return normalized(direction);
}

/// Returns the side of a solid on which a point is, as real arithmetic decides: in double with
/// error bounds, and in exact numbers if these leave a doubt. Each solid and each half-space has
///   std::array<Real, n> forms_at(shape, point)
/// polynomials that are all less than 0 inside. Outside, at least one is more than 0.
template <class Shape>
Side side_of(const Shape& solid, const Vec3d& point) {
    bool is_known = true;
    for (const Bounded<double>& form : forms_at(solid, convert<Bounded<double>>(point))) {
        if (form.value > form.error) return Side::outside;
        is_known = is_known && form.value < -form.error;
    }
    if (is_known) return Side::inside;
    int most = -1;
    for (const Dyadic& form : forms_at(solid, convert<Dyadic>(point)))
        most = std::max(most, form.sign());
    return static_cast<Side>(most);
}

} // namespace raylane::core
