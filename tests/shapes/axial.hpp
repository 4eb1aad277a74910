#pragma once

#include "tests/shapes/parts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

/// Shared parts of cylinders and cones.
namespace raylane::ray_sets {

/// Returns a point of the body, of a rim, of a cap, or the apex.
template <class Shape>
SurfacePoint axial_surface(const Shape& c, double r0, double r1, Random& r) {
    const Vec3d base = core::convert<double>(c.base), axis = core::convert<double>(c.axis);
    double s = r.uniform(0.0, 1.0), inwards = 1.0;
    const int part = r.integer(0, 3);
    if (part <= 1) s = r.integer(0, 1);           // a rim, or the apex
    if (part == 1) inwards = r.uniform(0.0, 1.0); // a cap
    const Vec3d out = across(axis, r);
    const Vec3d normal =
        part == 1 ? core::normalized(axis)
                  : core::normalized(out - axis * ((r1 - r0) / core::squared_length(axis)));
    return {base + s * axis + (inwards * (r0 + s * (r1 - r0))) * out, normal};
}

template <class Shape>
Vec3d axial_center(const Shape& c) {
    return core::convert<double>(c.base) + 0.5 * core::convert<double>(c.axis);
}

} // namespace raylane::ray_sets

namespace raylane::tests {

/// Returns an axis along x, y or z, of a small integer length.
inline Vec3f axis_of_integers(Random& r) {
    Vec3f axis{0.0F};
    axis[r.integer(0, 2)] = static_cast<float>(r.integer(1, 6) * (r.integer(0, 1) == 0 ? 1 : -1));
    return axis;
}
/// Returns points where cap and wall meet, for such an axis.
inline Seams rims(const Vec3f& base, const Vec3f& axis, float r0, float r1) {
    const int along = axis.x != 0.0F ? 0 : axis.y != 0.0F ? 1 : 2;
    const auto out = [&](float u, float v) {
        Vec3f p{0.0F};
        p[(along + 1) % 3] = u / 5.0F;
        p[(along + 2) % 3] = v / 5.0F;
        return p;
    };
    return {base + r0 * out(3, 4), base + r0 * out(-5, 0), base + axis + r1 * out(4, -3),
            base + axis + r1 * out(0, 5)};
}

inline double axial_distance_to_face(const Vec3f& base, const Vec3f& axis, double base_radius,
                                     double top_radius, core::Face face, const Vec3d& point) {
    const Vec3d a = core::convert<double>(axis), from_base = point - core::convert<double>(base);
    const double height = core::dot(from_base, a) / core::squared_length(a);
    if (face == core::base_cap) return std::abs(height) * core::length(a);
    if (face == core::top_cap) return std::abs(height - 1.0) * core::length(a);
    const double radius = base_radius + height * (top_radius - base_radius);
    const double across = core::length(Vec3d(from_base - height * a));
    return std::abs(across - radius) * core::length(a) /
           std::hypot(core::length(a), top_radius - base_radius);
}

/// An axis, with the axes of the outer and the inner neighbour.
struct Axes {
    Vec3f step;
    float count;

    Axes(double size, Random& r) {
        const double gap = r.log_uniform(min_gap + 1.0, std::max(0.25 * size, 8.0));
        step = whole(r.direction() * gap);
        count = number_of_gaps(size * r.log_uniform(0.25, 4.0), gap);
    }
    Vec3f base(float by) const { return -by * step; }
    Vec3f axis(float by) const { return (count + 2 * by) * step; }
};

} // namespace raylane::tests

namespace raylane::oracle {

/// The form of a cylinder or cone along a line. f and d are relative to the base. Heights h and
/// widths w have units that clear all fractions:
///   |f x a + t d x a|^2 a.a = (w0 + t w1)^2
struct AxialForm {
    Vector a;
    Exact aa, h0, h1, w0, w1, s;

    template <class AnyAxial>
    AxialForm(const AnyAxial& shape, const Line& line, const Exact& r0, const Exact& r1)
        : a(vector(shape.axis)), aa(inner(a, a)), h0(inner(line.f, a)), h1(inner(line.d, a)),
          w0(r0 * aa + (r1 - r0) * h0), w1((r1 - r0) * h1), s(r1 - r0) {}
};

template <class Real, class AnyAxial>
std::vector<Hit> axial_crossings(const AnyAxial& shape, const Exact& r0, const Exact& r1,
                                 bool capped, const core::Ray<Real>& ray) {
    const Line line(ray, shape.base);
    const AxialForm form(shape, line, r0, r1);
    const Vector fa = outer(line.f, form.a), da = outer(line.d, form.a);
    const Exact A = form.aa * inner(da, da) - form.w1 * form.w1;
    const Exact B = form.aa * inner(fa, da) - form.w0 * form.w1;
    const Exact C = form.aa * inner(fa, fa) - form.w0 * form.w0;

    std::vector<Hit> hits;
    for (const FoundRoot& root : roots(A, B, C)) {
        if (sign_at(root.t, form.h0, form.h1) < 0 ||
            sign_at(root.t, form.h0 - form.aa, form.h1) > 0)
            continue;
        // The line passes the apex from nappe to nappe. The crossing with the mirror image does not
        // count.
        const bool in_apex = sign_at(root.t, form.w0, form.w1) == 0;
        if (A.sign() < 0 && in_apex && root.falling != (form.w1.sign() > 0)) continue;
        hits.emplace_back(root.t, root.falling);
    }
    if (!capped) return hits;
    for (int end = 0; end < 2; ++end) {
        auto hit = plane_crossing(line, form.a, end == 0 ? Exact() : form.aa,
                                  end == 0 ? core::base_cap : core::top_cap);
        if (!hit) continue;
        if (end == 0) hit->entering = !hit->entering;
        if (is_within(line, hit->root, Exact(end) * form.a, end == 0 ? r0 : r1))
            hits.push_back(*hit);
    }
    // If the line touches the body between its ends, the double root counts as both crossings.
    return first_and_last(hits);
}

/// The normal is the offset from the axis minus the body's taper, times a.a a.a:
///   (f a.a - a (f.a)) a.a - a s (r0 a.a + s f.a)
/// and the same for d.
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

} // namespace raylane::oracle
