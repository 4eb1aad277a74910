#pragma once

#include "core/shapes/ball.hpp"
#include "core/shapes/checks.hpp"
#include "core/shapes/form.hpp"
#include "core/shapes/types.hpp"

#include <array>
#include <type_traits>

namespace raylane::core {

template <class Number>
void validate(const EllipsoidOf<Number>& e) {
    checks::require_point("center", e.center);
    checks::require_spanning("axes", e.axis_u, e.axis_v, e.axis_w);
}

/// Along a coordinate, the extent is the length of the vector of the axes' components.
template <class Number>
Bounds bounds_of(const EllipsoidOf<Number>& e) {
    const Vec3d center = convert<double>(e.center), u = convert<double>(e.axis_u),
                v = convert<double>(e.axis_v), w = convert<double>(e.axis_w);
    Vec3d extent;
    for (int axis = 0; axis < 3; ++axis)
        extent[axis] = length(Vec3d(u[axis], v[axis], w[axis]));
    return bounds_around(center, extent, absolute(center) + extent);
}

/// Linear map of the ellipsoid to a ball about the origin: the coordinate a of p, relative to the
/// centre, is ((v x w) . p) / ((v x w) . u), likewise b and c. A ray crosses the ball at the same t
/// as the ellipsoid.
template <class Real>
struct ToBall {
    std::array<Vec3<Real>, 3> rows;
    Real radius; ///< of either sign

    template <class Number>
    explicit ToBall(const EllipsoidOf<Number>& e) {
        const Vec3<Real> u = convert<Real>(e.axis_u), v = convert<Real>(e.axis_v),
                         w = convert<Real>(e.axis_w);
        rows = {cross(v, w), cross(w, u), cross(u, v)};
        radius = dot(rows[0], u);
        // The sixth power of a length overflows float. Other types do not divide, so small integers
        // stay exact.
        if constexpr (std::is_same_v<Real, float>) {
            for (Vec3<Real>& row : rows)
                row = row / radius;
            radius = 1.0F;
        }
    }

    Vec3<Real> operator()(const Vec3<Real>& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
    /// Returns half the gradient of |to_ball(p)|^2, given to_ball(p).
    Vec3<Real> normal(const Vec3<Real>& in_ball) const {
        return mul_add(in_ball.x, rows[0],
                       mul_add(in_ball.y, rows[1], Vec3<Real>(rows[2] * in_ball.z)));
    }
};

template <class Real, class Number>
Crossings<Real> crossings(const EllipsoidOf<Number>& ellipsoid, const Ray<Real>& ray,
                          const Start& start, ErrorPredicate<Real>& predicate) {
    const ToBall<Real> to_ball(ellipsoid);
    return ball_crossings(to_ball(Vec3<Real>(ray.origin - convert<Real>(ellipsoid.center))),
                          to_ball(ray.direction), to_ball.radius, start, predicate);
}

template <class Real, class Number>
Vec3<Real> outward_direction(const EllipsoidOf<Number>& ellipsoid, const Vec3<Real>& point, Face) {
    const ToBall<Real> to_ball(ellipsoid);
    return to_ball.normal(to_ball(Vec3<Real>(point - convert<Real>(ellipsoid.center))));
}

template <class Number>
ExactQuadratic form_along(const EllipsoidOf<Number>& ellipsoid, const ExactRay& ray, Face) {
    const ToBall<Dyadic> to_ball(ellipsoid);
    return ball_along(to_ball(Vec3<Dyadic>(ray.origin - convert<Dyadic>(ellipsoid.center))),
                      to_ball(ray.direction), to_ball.radius);
}

template <class Real, class Number>
NormalAlong<Real> normal_along(const EllipsoidOf<Number>& ellipsoid, const Ray<Real>& ray, Face) {
    const ToBall<Real> to_ball(ellipsoid);
    return {to_ball.normal(to_ball(Vec3<Real>(ray.origin - convert<Real>(ellipsoid.center)))),
            to_ball.normal(to_ball(ray.direction))};
}

template <class Real, class Number>
std::array<Real, 1> forms_at(const EllipsoidOf<Number>& ellipsoid, const Vec3<Real>& point) {
    const ToBall<Real> to_ball(ellipsoid);
    return {ball_at(to_ball(Vec3<Real>(point - convert<Real>(ellipsoid.center))), to_ball.radius)};
}

} // namespace raylane::core
