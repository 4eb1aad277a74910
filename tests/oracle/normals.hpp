#pragma once

#include "tests/oracle/shapes.hpp"

namespace raylane::oracle {

/// v0 + t v1 at a root: of any length.
struct Normal {
    Root t;
    Vector v0, v1;

    static Normal fixed(const Vector& v) { return {{{}, Exact(1), 0, {}}, v, {}}; }
    int sign(int axis) const { return sign_at(t, v0[axis], v1[axis]); }
    bool vanishes() const { return sign(0) == 0 && sign(1) == 0 && sign(2) == 0; }
};
inline Vector opposite(const Vector& v) {
    return Exact(-1) * v;
}

/// Which is more: the size of a component of the unit vector, or this.
inline int compare_size(const Normal& n, int axis, const Exact& size) {
    const Exact square = size * size;
    return sign_at(n.t, n.v0[axis] * n.v0[axis] - square * inner(n.v0, n.v0),
                   Exact(2) * (n.v0[axis] * n.v1[axis] - square * inner(n.v0, n.v1)),
                   n.v1[axis] * n.v1[axis] - square * inner(n.v1, n.v1));
}

/// The unit vector's components, each the nearest float, ties to even.
inline core::Vec3f rounded(const Normal& n) {
    core::Vec3<Number> v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = n.sign(axis) == 0 ? Number(0) : abs(value_at(n.t, n.v0[axis], n.v1[axis]));
    const Number length = sqrt(Number(v.x * v.x + v.y * v.y + v.z * v.z));
    core::Vec3f result(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
        const int sign = n.sign(axis);
        if (sign == 0) continue;
        result[axis] =
            static_cast<float>(sign) * nearest_float(Number(v[axis] / length), [&](double middle) {
                return compare_size(n, axis, Exact(middle));
            });
    }
    return result;
}

/// The normal outside (in front) of a shape at one of its crossings; at an apex what stands in for
/// it: the axis, to the outside.
template <class Real>
Normal normal(const core::Sphere& sphere, const core::Ray<Real>& ray, const Hit& hit) {
    const Line line(ray, sphere.center);
    return {hit.root, line.f, line.d};
}
template <class Real>
Normal normal(const core::Plane& plane, const core::Ray<Real>&, const Hit&) {
    return Normal::fixed(vector(plane.normal));
}
template <class Real>
Normal normal(const core::Disc& disc, const core::Ray<Real>&, const Hit&) {
    return Normal::fixed(vector(disc.normal));
}
template <class AnyTriangle>
Normal triangle_normal(const AnyTriangle& triangle) {
    return Normal::fixed(
        outer(vector(triangle.b) - vector(triangle.a), vector(triangle.c) - vector(triangle.a)));
}
template <class Real>
Normal normal(const core::Triangle& triangle, const core::Ray<Real>&, const Hit&) {
    return triangle_normal(triangle);
}
template <class Real>
Normal normal(const core::SmoothTriangle& triangle, const core::Ray<Real>&, const Hit&) {
    return triangle_normal(triangle);
}
template <class Real>
Normal normal(const core::Box& box, const core::Ray<Real>&, const Hit& hit) {
    const std::array<Vector, 3> normals = face_normals(box);
    const bool left_handed = inner(normals[0], vector(box.edge_u)).sign() < 0;
    const Vector& far = normals[hit.face / 2];
    return Normal::fixed(left_handed == (hit.face % 2 == 0) ? far : opposite(far));
}

/// The offset from the axis, less what the body narrows: times a.a a.a,
///   (f a.a - a (f.a)) a.a - a s (r0 a.a + s f.a), and so for d.
template <class Real, class AnyAxial>
Normal axial_normal(const AnyAxial& shape, const Exact& r0, const Exact& r1,
                    const core::Ray<Real>& ray, const Hit& hit) {
    const Vector axis = vector(shape.axis);
    if (hit.face != core::body)
        return Normal::fixed(hit.face == core::top_cap ? axis : opposite(axis));
    const Line line(ray, shape.base);
    const AxialForm form(shape, line, r0, r1);
    const Vector v0 = form.aa * (form.aa * line.f - form.h0 * axis) - form.s * form.w0 * axis;
    const Vector v1 = form.aa * (form.aa * line.d - form.h1 * axis) - form.s * form.w1 * axis;
    const Normal normal{hit.root, v0, v1};
    if (!normal.vanishes()) return normal;
    return Normal::fixed(form.s.sign() < 0 ? axis : opposite(axis));
}
template <core::Ends ends, class Real>
Normal normal(const core::Cylinder<ends>& c, const core::Ray<Real>& ray, const Hit& hit) {
    return axial_normal(c, Exact(c.radius), Exact(c.radius), ray, hit);
}
template <core::Ends ends, class Real>
Normal normal(const core::Cone<ends>& c, const core::Ray<Real>& ray, const Hit& hit) {
    return axial_normal(c, Exact(c.base_radius), Exact(c.top_radius), ray, hit);
}
template <class Real>
Normal normal(const core::Quadric& q, const core::Ray<Real>& ray, const Hit& hit) {
    const Line line(ray, q.center);
    const Vector linear = vector(core::Vec3f(q.x, q.y, q.z));
    const Normal normal{hit.root, product(q, line.f) + linear, product(q, line.d)};
    return normal.vanishes() ? Normal::fixed({Exact(0), Exact(0), Exact(1)}) : normal;
}

} // namespace raylane::oracle
