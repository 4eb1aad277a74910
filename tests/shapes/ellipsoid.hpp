#pragma once

#include "tests/shapes/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raylane::ray_sets {

template <>
struct Target<core::Ellipsoid> {
    /// Half of them have orthogonal axes.
    static core::Ellipsoid make(Random& r, bool lattice) {
        while (true) {
            core::Ellipsoid e{r.small_integers(3), r.small_integers(3), r.small_integers(3),
                              r.small_integers(3)};
            if (!lattice) {
                const Vec3d n = r.direction(), m = across(n, r);
                const auto size = [&] { return r.log_uniform(1e-2, 10.0); };
                e = r.integer(0, 1) == 0
                        ? core::Ellipsoid{rounded(r.cube(10.0)), rounded(size() * n),
                                          rounded(size() * m), rounded(size() * core::cross(n, m))}
                        : core::Ellipsoid{rounded(r.cube(10.0)), rounded(r.cube(5.0)),
                                          rounded(r.cube(5.0)), rounded(r.cube(5.0))};
            }
            const Vec3d u = core::convert<double>(e.axis_u), v = core::convert<double>(e.axis_v),
                        w = core::convert<double>(e.axis_w);
            const double sizes = core::length(u) * core::length(v) * core::length(w);
            if (std::abs(core::dot(core::cross(u, v), w)) > 1e-3 * sizes) return e;
        }
    }
    static SurfacePoint surface(const core::Ellipsoid& e, Random& r) {
        const Vec3d u = core::convert<double>(e.axis_u), v = core::convert<double>(e.axis_v),
                    w = core::convert<double>(e.axis_w), n = r.direction();
        const Vec3d gradient =
            n.x * core::cross(v, w) + n.y * core::cross(w, u) + n.z * core::cross(u, v);
        return {core::convert<double>(e.center) + n.x * u + n.y * v + n.z * w,
                core::normalized(gradient)};
    }
    static Vec3d center(const core::Ellipsoid& e) { return core::convert<double>(e.center); }
    static Vec3d special(const core::Ellipsoid& e, Random& r) {
        return r.integer(0, 1) == 0 ? r.direction() : core::convert<double>(e.axis_u);
    }
    static double size(const core::Ellipsoid& e) {
        return core::length(core::convert<double>(e.axis_u));
    }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <>
struct Nature<core::Ellipsoid> : Solid {};

inline core::Ellipsoid placed(const core::Ellipsoid& e, const Placing& by) {
    return {by.point(e.center), e.axis_u * by.factor(), e.axis_v * by.factor(),
            e.axis_w * by.factor()};
}

template <>
struct NestOf<core::Ellipsoid> {
    static CloseShells make(double size, Random& r) {
        const double gap = r.log_uniform(3.0 * min_gap, std::max(0.25 * size, 10.0));
        const Vec3d n = r.direction(), m = ray_sets::across(n, r);
        const Vec3f u = whole((n + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
        const Vec3f v = whole((m + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
        const Vec3f w = whole((core::cross(n, m) + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
        const float count = std::max(2.0F, number_of_gaps(size, gap));
        const auto ellipsoid = [&](float by) {
            const float sum = count + by;
            return core::Ellipsoid{Vec3f(0), sum * u, sum * v, sum * w};
        };
        return {ellipsoid(0), ellipsoid(1), ellipsoid(-1), true};
    }
};

template <>
struct Restated<core::Ellipsoid> {
    static core::Ellipsoid make(int i) {
        const Vec3f axes[] = {{1.25F, 0, 0.5F}, {-0.5F, 1.5F, 0}, {0, 0.25F, 2}};
        const Vec3f u = axes[i % 3], v = axes[(i + 1) % 3], w = axes[(i + 2) % 3];
        return {{0, 0.5F, 0}, u, i % 2 == 0 ? v : -v, w};
    }
};

template <>
struct Seamed<core::Ellipsoid> {
    static core::Ellipsoid make(Random& r) {
        core::Ellipsoid e = ray_sets::Target<core::Ellipsoid>::make(r, true);
        for (Vec3f* axis : {&e.axis_u, &e.axis_v, &e.axis_w})
            *axis *= 5.0F;
        return e;
    }
    static Seams seams(const core::Ellipsoid& e, Random&) {
        const Vec3f u = e.axis_u, v = e.axis_v, w = e.axis_w;
        return {e.center + u, e.center - v, e.center + (3.0F * v + 4.0F * w) / 5.0F,
                e.center + (4.0F * u - 3.0F * w) / 5.0F};
    }
};

inline double distance_to_face(const core::Ellipsoid& e, core::Face, const Vec3d& point) {
    const Vec3d u = core::convert<double>(e.axis_u), v = core::convert<double>(e.axis_v),
                w = core::convert<double>(e.axis_w), p = point - core::convert<double>(e.center);
    const double volume = core::dot(core::cross(u, v), w);
    const Vec3d rows[] = {core::cross(v, w) / volume, core::cross(w, u) / volume,
                          core::cross(u, v) / volume};
    const Vec3d b(core::dot(rows[0], p), core::dot(rows[1], p), core::dot(rows[2], p));
    const Vec3d gradient = b.x * rows[0] + b.y * rows[1] + b.z * rows[2];
    return std::abs(core::dot(b, b) - 1.0) / (2.0 * core::length(gradient));
}

template <>
struct Written<core::Ellipsoid> {
    static constexpr const char* text = R"("type": "ellipsoid", "center": [1, 2, 3],
                                           "axes": [[1, 0, 0.5], [0, 2, 0], [0, 0.1, 3]])";
    template <class Ellipsoid>
    static Ellipsoid by_name() {
        return {
            .center = {1, 2, 3}, .axis_u = {1, 0, 0.5}, .axis_v = {0, 2, 0}, .axis_w = {0, 0.1, 3}};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

/// Solves p = a u + b v + c w by the normal equations G (a, b, c) = (p . u, p . v, p . w), where G
/// has the axes' inner products. The adjugate of G gives a, b and c times the determinant of G,
/// without fractions.
struct NormalEquations {
    std::array<Vector, 3> axes, adjugate;
    Exact determinant;

    explicit NormalEquations(const core::EllipsoidOf<double>& e)
        : axes{vector(e.axis_u), vector(e.axis_v), vector(e.axis_w)} {
        std::array<Vector, 3> gram;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                gram[i][j] = inner(axes[i], axes[j]);
        adjugate = {outer(gram[1], gram[2]), outer(gram[2], gram[0]), outer(gram[0], gram[1])};
        determinant = inner(gram[0], adjugate[0]);
    }
    /// Returns the coordinates times the determinant. G is symmetric, and so is its adjugate.
    Vector coordinates(const Vector& p) const {
        return times({inner(axes[0], p), inner(axes[1], p), inner(axes[2], p)});
    }
    /// Returns half the gradient of |coordinates(p)|^2, from these coordinates.
    Vector gradient(const Vector& at) const {
        const Vector weights = times(at);
        return weights.x * axes[0] + weights.y * axes[1] + weights.z * axes[2];
    }

  private:
    Vector times(const Vector& v) const {
        return {inner(adjugate[0], v), inner(adjugate[1], v), inner(adjugate[2], v)};
    }
};

template <class Real>
std::vector<Hit> crossings(const core::EllipsoidOf<double>& e, const core::Ray<Real>& ray) {
    const NormalEquations equations(e);
    const Line line(ray, e.center);
    const Vector f = equations.coordinates(line.f), d = equations.coordinates(line.d);
    std::vector<Hit> hits;
    for (const FoundRoot& root : roots(inner(d, d), inner(f, d),
                                       inner(f, f) - equations.determinant * equations.determinant))
        hits.emplace_back(root.t, root.falling);
    return hits;
}

template <class Real>
Normal normal(const core::EllipsoidOf<double>& e, const core::Ray<Real>& ray, const Hit& hit) {
    const NormalEquations equations(e);
    const Line line(ray, e.center);
    return {hit.root, equations.gradient(equations.coordinates(line.f)),
            equations.gradient(equations.coordinates(line.d))};
}

inline Ball ball_around(const core::EllipsoidOf<double>& e) {
    return ball(e.center, length_of(e.axis_u) + length_of(e.axis_v) + length_of(e.axis_w));
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <>
struct Touching<core::Ellipsoid> {
    /// Only the third axis has a height. It leads to the top.
    static core::Ellipsoid make(const Frame& frame, int r, Random& random) {
        const int x = random.integer(-1, 1), y = random.integer(-1, 1);
        const int a = random.integer(1, 3), b = random.integer(1, 3), s = random.integer(-1, 1);
        return {frame.exact(-x, -y, -r), frame.exact(a, s, 0), frame.exact(-s, b, 0),
                frame.exact(x, y, r)};
    }
    static core::Ellipsoid shell(const Frame& frame, int r) {
        return {frame.exact(0, 0, -r), frame.exact(r, 0, 0), frame.exact(0, r, 0),
                frame.exact(0, 0, r)};
    }
};

} // namespace raylane::meetings

namespace raylane::hard_cases {

inline core::Ellipsoid extreme(core::Ellipsoid e, Random& r) {
    stretch(e.axis_u, e.axis_v, r);
    return e;
}

} // namespace raylane::hard_cases
