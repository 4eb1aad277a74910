#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/oracle/root.hpp"

#include <array>
#include <optional>

/// Where a line crosses a shape, in exact numbers, and by other formulas than the solvers use
/// (quadratics in cross products with cleared fractions, Cramer's rule, faces one by one), so that
/// the two do not share a mistake.
namespace raylane::oracle {

using core::Face;

/// A crossing of the line, t of either sign.
struct Hit {
    Root root;
    Number t; ///< its value
    bool entering;
    Face face = core::body;

    Hit(const Root& at, bool enters, Face which = core::body)
        : root(at), t(at), entering(enters), face(which) {}
};

inline int compare(const Hit& a, const Hit& b) {
    return compare(a.root, a.t, b.root, b.t);
}

/// A ray from a point of its shape.
struct Line {
    Vector f, d;

    template <class Real>
    Line(const core::Ray<Real>& ray, const core::Vec3f& anchor)
        : f(vector(ray.origin) - vector(anchor)), d(vector(ray.direction)) {}
};

/// Whether |f + t d - offset| is at most this.
inline bool is_within(const Line& line, const Root& t, const Vector& offset, const Exact& radius) {
    const Vector f = line.f - offset;
    return sign_at(t, inner(f, f) - radius * radius, Exact(2) * inner(f, line.d),
                   inner(line.d, line.d)) <= 0;
}

template <class Real>
std::vector<Hit> crossings(const core::Sphere& sphere, const core::Ray<Real>& ray) {
    const Line line(ray, sphere.center);
    const Exact r(sphere.radius);
    std::vector<Hit> hits;
    for (const FoundRoot& root :
         roots(inner(line.d, line.d), inner(line.f, line.d), inner(line.f, line.f) - r * r))
        hits.emplace_back(root.t, root.falling);
    return hits;
}

/// normal . (f + t d) = height
inline std::optional<Hit> plane_crossing(const Line& line, const Vector& normal,
                                         const Exact& height = {}, Face face = core::body) {
    const Exact approach = inner(normal, line.d);
    if (approach.sign() == 0) return std::nullopt;
    return Hit(Root::quotient(height - inner(normal, line.f), approach), approach.sign() < 0, face);
}

template <class Real>
std::vector<Hit> crossings(const core::Plane& plane, const core::Ray<Real>& ray) {
    const auto hit = plane_crossing(Line(ray, plane.point), vector(plane.normal));
    return hit ? std::vector<Hit>{*hit} : std::vector<Hit>();
}

template <class Real>
std::vector<Hit> crossings(const core::Disc& disc, const core::Ray<Real>& ray) {
    const Line line(ray, disc.center);
    const auto hit = plane_crossing(line, vector(disc.normal));
    if (!hit || !is_within(line, hit->root, {}, Exact(disc.radius))) return {};
    return {*hit};
}

/// Cramer's rule for f + t d = u e + v g.
template <class Real, class AnyTriangle>
std::vector<Hit> triangle_crossing(const AnyTriangle& triangle, const core::Ray<Real>& ray) {
    const Line line(ray, triangle.a);
    const Vector e = vector(triangle.b) - vector(triangle.a),
                 g = vector(triangle.c) - vector(triangle.a);
    const Exact determinant = inner(e, outer(line.d, g));
    const int s = determinant.sign();
    if (s == 0) return {};
    const Exact u = inner(line.f, outer(line.d, g)), v = inner(line.d, outer(line.f, e));
    if (s * u.sign() < 0 || s * v.sign() < 0 || s * (determinant - u - v).sign() < 0) return {};
    return {Hit(Root::quotient(inner(g, outer(line.f, e)), determinant),
                inner(outer(e, g), line.d).sign() < 0)};
}

template <class Real>
std::vector<Hit> crossings(const core::Triangle& triangle, const core::Ray<Real>& ray) {
    return triangle_crossing(triangle, ray);
}

template <class Real>
std::vector<Hit> crossings(const core::SmoothTriangle& triangle, const core::Ray<Real>& ray) {
    return triangle_crossing(triangle, ray);
}

/// Of a convex solid given by where the line crosses its faces: the first of those by which it
/// enters and the last of those by which it leaves, by the lowest face where these are several. A
/// line that lies in faces enters and leaves by the others.
inline std::vector<Hit> first_and_last(const std::vector<Hit>& on_faces) {
    std::optional<Hit> first, last;
    const auto choose = [](std::optional<Hit>& chosen, const Hit& hit, int wanted) {
        const int order = chosen ? compare(hit, *chosen) : wanted;
        if (order == wanted || (order == 0 && hit.face < chosen->face)) chosen = hit;
    };
    for (const Hit& hit : on_faces)
        hit.entering ? choose(first, hit, -1) : choose(last, hit, 1);
    if (!first || !last) return {};
    return {*first, *last};
}

/// The outward normal of the faces opposite the corner, or inward.
inline std::array<Vector, 3> face_normals(const core::Box& box) {
    const Vector edges[3] = {vector(box.edge_u), vector(box.edge_v), vector(box.edge_w)};
    return {outer(edges[1], edges[2]), outer(edges[2], edges[0]), outer(edges[0], edges[1])};
}

/// Each face's plane, if its two other coordinates are within the face.
template <class Real>
std::vector<Hit> crossings(const core::Box& box, const core::Ray<Real>& ray) {
    std::array<Vector, 3> normals = face_normals(box);
    Exact volume = inner(normals[0], vector(box.edge_u));
    if (volume.sign() < 0) {
        volume = -volume;
        for (Vector& normal : normals)
            normal = Exact(-1) * normal;
    }
    const Line line(ray, box.corner);
    std::vector<Hit> on_faces;
    for (int i = 0; i < 3; ++i)
        for (int side = 0; side < 2; ++side) {
            auto hit = plane_crossing(line, normals[i], side == 0 ? Exact() : volume,
                                      static_cast<Face>(2 * i + side));
            if (!hit) continue;
            if (side == 0) hit->entering = !hit->entering;
            bool inside = true;
            for (int j = 0; j < 3; ++j) {
                if (j == i) continue;
                const Exact at = inner(normals[j], line.f), along = inner(normals[j], line.d);
                inside = inside && sign_at(hit->root, at, along) >= 0 &&
                         sign_at(hit->root, at - volume, along) <= 0;
            }
            if (inside) on_faces.push_back(*hit);
        }
    return first_and_last(on_faces);
}

/// What a cylinder or cone is along a line: with f and d relative to the base, heights h and widths
/// w in units that clear all fractions,
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
        // Through the apex from nappe to nappe: the crossing with the mirror image does not count.
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
    // The double root of a line that touches the body in its middle stands for both.
    return first_and_last(hits);
}

template <core::Ends ends, class Real>
std::vector<Hit> crossings(const core::Cylinder<ends>& c, const core::Ray<Real>& ray) {
    return axial_crossings(c, Exact(c.radius), Exact(c.radius), ends == core::Ends::capped, ray);
}

template <core::Ends ends, class Real>
std::vector<Hit> crossings(const core::Cone<ends>& c, const core::Ray<Real>& ray) {
    return axial_crossings(c, Exact(c.base_radius), Exact(c.top_radius), ends == core::Ends::capped,
                           ray);
}

/// M p, and half the gradient M p + linear.
inline Vector product(const core::Quadric& q, const Vector& p) {
    return {inner(vector(core::Vec3f(q.xx, q.xy, q.xz)), p),
            inner(vector(core::Vec3f(q.xy, q.yy, q.yz)), p),
            inner(vector(core::Vec3f(q.xz, q.yz, q.zz)), p)};
}

template <class Real>
std::vector<Hit> crossings(const core::Quadric& q, const core::Ray<Real>& ray) {
    const Line line(ray, q.center);
    const Vector linear = vector(core::Vec3f(q.x, q.y, q.z)), lower = vector(q.lower),
                 upper = vector(q.upper);
    std::vector<Hit> hits;
    for (const FoundRoot& root : roots(inner(line.d, product(q, line.d)),
                                       inner(line.d, product(q, line.f)) + inner(linear, line.d),
                                       inner(line.f, product(q, line.f)) +
                                           Exact(2) * inner(linear, line.f) + Exact(q.one))) {
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
            inside = inside && sign_at(root.t, line.f[axis] - lower[axis], line.d[axis]) >= 0 &&
                     sign_at(root.t, line.f[axis] - upper[axis], line.d[axis]) <= 0;
        if (inside) hits.emplace_back(root.t, root.falling);
    }
    return hits;
}

/// The first crossing with t > 0, what is entered before what is left.
template <class Shape, class Real>
std::optional<Hit> first_hit(const Shape& shape, const core::Ray<Real>& ray) {
    std::optional<Hit> first;
    for (const Hit& hit : crossings(shape, ray)) {
        if (!(hit.t > 0)) continue;
        const int order = first ? compare(hit, *first) : -1;
        if (order < 0 || (order == 0 && hit.entering && !first->entering)) first = hit;
    }
    return first;
}

} // namespace raylane::oracle
