#pragma once

#include "core/ray.hpp"
#include "core/shapes.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <optional>
#include <vector>

/// What is true of a ray and a shape, for the floats and doubles given: in 100 decimal digits, and
/// by other formulas than the solvers use (textbook quadratics in cross products and cleared
/// fractions, Cramer's rule), so that the two do not share a mistake. Inputs have 24 or 53 bits and
/// the polynomials a degree of at most eight: 332 bits hold every discriminant exactly or very
/// nearly so.
namespace raylane::oracle {

using Number = boost::multiprecision::cpp_bin_float_100;
using Vector = core::Vec3<Number>;

struct Hit {
    Number t;
    bool entering;
};

inline Vector vector(const core::Vec3f& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}
inline Vector vector(const core::Vec3d& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}
inline Number inner(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector outer(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Signs to 80 digits: what is nearer to 0 is 0 (a rim met exactly by an irrational root does not
/// come out as 0).
inline int sign(const Number& value, const Number& scale) {
    if (abs(value) <= scale * Number("1e-80")) return 0;
    return value > 0 ? 1 : -1;
}

/// The real roots of A t^2 + 2 B t + C with the sign of its derivative there, ascending.
struct Root {
    Number t;
    bool falling;
};
inline std::vector<Root> roots(const Number& A, const Number& B, const Number& C) {
    if (A == 0) {
        if (B == 0) return {};
        return {{-C / (2 * B), B < 0}};
    }
    const Number discriminant = B * B - A * C;
    const int s = sign(discriminant, abs(B * B) + abs(A * C));
    if (s < 0) return {};
    const Number root = s == 0 ? Number(0) : Number(sqrt(discriminant));
    // One of the two cancels where B is large: 100 digits can afford it.
    const Number lower = (-B - root) / A, upper = (-B + root) / A;
    if (A > 0) return {{lower, true}, {upper, false}};
    return {{upper, false}, {lower, true}};
}

/// All crossings of the line, in any order.
template <class Real>
std::vector<Hit> crossings(const core::Sphere& sphere, const core::Ray<Real>& ray) {
    const Vector f = vector(ray.origin) - vector(sphere.center), d = vector(ray.direction);
    std::vector<Hit> hits;
    for (const Root& root :
         roots(inner(d, d), inner(f, d), inner(f, f) - Number(sphere.radius) * sphere.radius))
        hits.push_back({root.t, root.falling});
    return hits;
}

template <class Real>
std::vector<Hit> plane_crossing(const core::Ray<Real>& ray, const Vector& point,
                                const Vector& normal) {
    const Number approach = inner(normal, vector(ray.direction));
    if (approach == 0) return {};
    return {{inner(normal, point - vector(ray.origin)) / approach, approach < 0}};
}

template <class Real>
std::vector<Hit> crossings(const core::Plane& plane, const core::Ray<Real>& ray) {
    return plane_crossing(ray, vector(plane.point), vector(plane.normal));
}

template <class Real>
std::vector<Hit> crossings(const core::Disc& disc, const core::Ray<Real>& ray) {
    std::vector<Hit> hits = plane_crossing(ray, vector(disc.center), vector(disc.normal));
    if (hits.empty()) return hits;
    const Vector p = vector(ray.origin) + hits[0].t * vector(ray.direction) - vector(disc.center);
    const Number rr = Number(disc.radius) * disc.radius;
    if (sign(inner(p, p) - rr, rr) > 0) hits.clear();
    return hits;
}

/// Cramer's rule for origin + t direction = a + u (b - a) + v (c - a).
template <class Real>
std::vector<Hit> triangle_crossing(const Vector& a, const Vector& b, const Vector& c,
                                   const core::Ray<Real>& ray) {
    const Vector e = b - a, g = c - a, d = vector(ray.direction), f = vector(ray.origin) - a;
    const Number determinant = inner(e, outer(d, g));
    if (determinant == 0) return {};
    const Number u = inner(f, outer(d, g)) / determinant;
    const Number v = inner(d, outer(f, e)) / determinant;
    if (sign(u, 1) < 0 || sign(v, 1) < 0 || sign(1 - u - v, 1) < 0) return {};
    return {{inner(g, outer(f, e)) / determinant, inner(outer(e, g), d) < 0}};
}

template <class Real>
std::vector<Hit> crossings(const core::Triangle& t, const core::Ray<Real>& ray) {
    return triangle_crossing(vector(t.a), vector(t.b), vector(t.c), ray);
}

template <class Real>
std::vector<Hit> crossings(const core::SmoothTriangle& t, const core::Ray<Real>& ray) {
    return triangle_crossing(vector(t.a), vector(t.b), vector(t.c), ray);
}

/// Of a convex solid given by the crossings of its parts of surface: the first and the last of
/// them.
inline std::vector<Hit> first_and_last(const std::vector<Number>& ts) {
    if (ts.empty()) return {};
    const auto [first, last] = std::minmax_element(ts.begin(), ts.end());
    return {{*first, true}, {*last, false}};
}

/// Face by face: the crossing with the face's plane, if its two other coordinates are within the
/// face.
template <class Real>
std::vector<Hit> crossings(const core::Box& box, const core::Ray<Real>& ray) {
    const Vector edges[3] = {vector(box.edge_u), vector(box.edge_v), vector(box.edge_w)};
    const Number volume = inner(edges[0], outer(edges[1], edges[2]));
    const Vector f = vector(ray.origin) - vector(box.corner), d = vector(ray.direction);
    Number at[3], along[3];
    for (int i = 0; i < 3; ++i) {
        const Vector normal = outer(edges[(i + 1) % 3], edges[(i + 2) % 3]);
        at[i] = inner(normal, f) / volume;
        along[i] = inner(normal, d) / volume;
    }
    std::vector<Number> ts;
    for (int i = 0; i < 3; ++i) {
        if (along[i] == 0) continue;
        for (int side = 0; side < 2; ++side) {
            const Number t = (side - at[i]) / along[i];
            bool inside = true;
            for (int j = 0; j < 3; ++j) {
                if (j == i) continue;
                const Number coordinate = at[j] + t * along[j];
                inside = inside && sign(coordinate, 1) >= 0 && sign(1 - coordinate, 1) >= 0;
            }
            if (inside) ts.push_back(t);
        }
    }
    return first_and_last(ts);
}

/// |p x a|^2 a.a = (r0 a.a + (r1 - r0) p.a)^2 ... with the fractions cleared; r1 = r0 is the
/// cylinder.
template <class Real>
std::vector<Hit> axial_crossings(const core::Vec3f& base, const core::Vec3f& axis, const Number& r0,
                                 const Number& r1, bool capped, const core::Ray<Real>& ray) {
    const Vector a = vector(axis), f = vector(ray.origin) - vector(base), d = vector(ray.direction);
    const Number aa = inner(a, a), h0 = inner(f, a), hd = inner(d, a), s = r1 - r0;
    const Vector fa = outer(f, a), da = outer(d, a);
    const Number W = r0 * aa + s * h0, M = s * hd;
    const Number A = aa * inner(da, da) - M * M;
    const Number B = aa * inner(fa, da) - W * M;
    const Number C = aa * inner(fa, fa) - W * W;

    std::vector<Hit> surface;
    std::vector<Number> solid;
    for (const Root& root : roots(A, B, C)) {
        const Number height = h0 + root.t * hd;
        if (sign(height, aa) < 0 || sign(aa - height, aa) < 0) continue;
        // Through the apex from nappe to nappe: the crossing with the mirror image does not count.
        const Number width = W + root.t * M;
        if (A < 0 && sign(width, aa * (r0 + r1)) == 0 && root.falling != (M > 0)) continue;
        surface.push_back({root.t, root.falling});
        solid.push_back(root.t);
    }
    if (!capped) return surface;
    if (hd != 0) {
        for (int end = 0; end < 2; ++end) {
            const Number t = (end * aa - h0) / hd;
            const Vector p = f + t * d - Number(end) * a;
            const Number radius = end == 0 ? r0 : r1;
            if (sign(inner(p, p) - radius * radius, r0 * r0 + r1 * r1) <= 0) solid.push_back(t);
        }
    }
    return first_and_last(solid);
}

template <core::Ends ends, class Real>
std::vector<Hit> crossings(const core::Cylinder<ends>& c, const core::Ray<Real>& ray) {
    return axial_crossings(c.base, c.axis, c.radius, c.radius, ends == core::Ends::capped, ray);
}

template <core::Ends ends, class Real>
std::vector<Hit> crossings(const core::Cone<ends>& c, const core::Ray<Real>& ray) {
    return axial_crossings(c.base, c.axis, c.base_radius, c.top_radius, ends == core::Ends::capped,
                           ray);
}

template <class Real>
std::vector<Hit> crossings(const core::Quadric& q, const core::Ray<Real>& ray) {
    const Number m[4][4] = {{q.xx, q.xy, q.xz, q.x},
                            {q.xy, q.yy, q.yz, q.y},
                            {q.xz, q.yz, q.zz, q.z},
                            {q.x, q.y, q.z, q.one}};
    const Vector f = vector(ray.origin) - vector(q.center), d = vector(ray.direction);
    const Number p[4] = {f.x, f.y, f.z, 1}, v[4] = {d.x, d.y, d.z, 0};
    Number A = 0, B = 0, C = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            A += m[i][j] * v[i] * v[j];
            B += m[i][j] * p[i] * v[j];
            C += m[i][j] * p[i] * p[j];
        }
    std::vector<Hit> hits;
    for (const Root& root : roots(A, B, C)) {
        const Vector x = f + root.t * d;
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
            const Number lower(q.lower[axis]), upper(q.upper[axis]);
            const Number scale = upper - lower;
            inside =
                inside && sign(x[axis] - lower, scale) >= 0 && sign(upper - x[axis], scale) >= 0;
        }
        if (inside) hits.push_back({root.t, root.falling});
    }
    return hits;
}

/// The first crossing with t > 0.
template <class Shape, class Real>
std::optional<Hit> first_hit(const Shape& shape, const core::Ray<Real>& ray) {
    std::optional<Hit> first;
    for (const Hit& hit : crossings(shape, ray))
        if (hit.t > 0 && (!first || hit.t < first->t)) first = hit;
    return first;
}

} // namespace raylane::oracle
