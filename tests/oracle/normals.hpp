#pragma once

#include "tests/oracle/shapes.hpp"

namespace raylane::oracle {

using Direction = core::Vec3<Number>;

/// v0 + t v1 at a root, of length 1. Each component has all its digits, and is 0 where it is 0.
inline std::optional<Direction> unit_at(const Root& t, const Vector& v0, const Vector& v1) {
    Direction v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = sign_at(t, v0[axis], v1[axis]) == 0 ? Number(0) : value_at(t, v0[axis], v1[axis]);
    const Number length = sqrt(Number(v.x * v.x + v.y * v.y + v.z * v.z));
    if (length == 0) return std::nullopt;
    return Direction(v.x / length, v.y / length, v.z / length);
}
inline Direction unit(const Vector& v) {
    return *unit_at(Root{{}, Exact(1), 0, {}}, v, {});
}
inline Direction opposite(const Direction& v) {
    return {-v.x, -v.y, -v.z};
}

/// The unit normal outside (in front) of a shape at one of its crossings; at an apex what stands in
/// for it: the axis, to the outside.
template <class Real>
Direction normal(const core::Sphere& sphere, const core::Ray<Real>& ray, const Hit& hit) {
    const Line line(ray, sphere.center);
    return *unit_at(hit.root, line.f, line.d);
}
template <class Real>
Direction normal(const core::Plane& plane, const core::Ray<Real>&, const Hit&) {
    return unit(vector(plane.normal));
}
template <class Real>
Direction normal(const core::Disc& disc, const core::Ray<Real>&, const Hit&) {
    return unit(vector(disc.normal));
}
template <class AnyTriangle>
Direction triangle_normal(const AnyTriangle& triangle) {
    return unit(
        outer(vector(triangle.b) - vector(triangle.a), vector(triangle.c) - vector(triangle.a)));
}
template <class Real>
Direction normal(const core::Triangle& triangle, const core::Ray<Real>&, const Hit&) {
    return triangle_normal(triangle);
}
template <class Real>
Direction normal(const core::SmoothTriangle& triangle, const core::Ray<Real>&, const Hit&) {
    return triangle_normal(triangle);
}
template <class Real>
Direction normal(const core::Box& box, const core::Ray<Real>&, const Hit& hit) {
    const std::array<Vector, 3> normals = face_normals(box);
    const bool left_handed = inner(normals[0], vector(box.edge_u)).sign() < 0;
    const Direction far = unit(normals[hit.face / 2]);
    return left_handed == (hit.face % 2 == 0) ? far : opposite(far);
}

/// The offset from the axis, less what the body narrows: times a.a a.a,
///   (f a.a - a (f.a)) a.a - a s (r0 a.a + s f.a), and so for d.
template <class Real, class AnyAxial>
Direction axial_normal(const AnyAxial& shape, const Exact& r0, const Exact& r1,
                       const core::Ray<Real>& ray, const Hit& hit) {
    const Vector axis = vector(shape.axis);
    if (hit.face != core::body)
        return hit.face == core::top_cap ? unit(axis) : opposite(unit(axis));
    const Line line(ray, shape.base);
    const AxialForm form(shape, line, r0, r1);
    const Vector v0 = form.aa * (form.aa * line.f - form.h0 * axis) - form.s * form.w0 * axis;
    const Vector v1 = form.aa * (form.aa * line.d - form.h1 * axis) - form.s * form.w1 * axis;
    const auto normal = unit_at(hit.root, v0, v1);
    if (normal) return *normal;
    return form.s.sign() < 0 ? unit(axis) : opposite(unit(axis));
}
template <core::Ends ends, class Real>
Direction normal(const core::Cylinder<ends>& c, const core::Ray<Real>& ray, const Hit& hit) {
    return axial_normal(c, Exact(c.radius), Exact(c.radius), ray, hit);
}
template <core::Ends ends, class Real>
Direction normal(const core::Cone<ends>& c, const core::Ray<Real>& ray, const Hit& hit) {
    return axial_normal(c, Exact(c.base_radius), Exact(c.top_radius), ray, hit);
}
template <class Real>
Direction normal(const core::Quadric& q, const core::Ray<Real>& ray, const Hit& hit) {
    const Line line(ray, q.center);
    const Vector linear = vector(core::Vec3f(q.x, q.y, q.z));
    const auto normal = unit_at(hit.root, product(q, line.f) + linear, product(q, line.d));
    return normal ? *normal : Direction(0, 0, 1);
}

} // namespace raylane::oracle
