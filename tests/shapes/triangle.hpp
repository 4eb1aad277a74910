#pragma once

#include "tests/shapes/parts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raylane::ray_sets {

template <>
struct Target<core::Triangle> {
    static core::Triangle make(Random& r, bool lattice) {
        while (true) {
            const core::Triangle t =
                lattice
                    ? core::Triangle{r.small_integers(4), r.small_integers(4), r.small_integers(4)}
                    : core::Triangle{rounded(r.cube(10.0)), rounded(r.cube(10.0)),
                                     rounded(r.cube(10.0))};
            const Vec3d a = core::convert<double>(t.a);
            const Vec3d n = core::cross(Vec3d(core::convert<double>(t.b) - a),
                                        Vec3d(core::convert<double>(t.c) - a));
            if (core::squared_length(n) > 1e-6) return t;
        }
    }
    static SurfacePoint surface(const core::Triangle& t, Random& r) {
        double u = r.uniform(0.0, 1.0), v = r.uniform(0.0, 1.0 - u);
        switch (r.integer(0, 4)) { // edges and corners are about as frequent as the inside
        case 0:
            v = 0.0;
            break;
        case 1:
            v = 1.0 - u;
            break;
        case 2:
            u = v = 0.0;
            break;
        default:
            break;
        }
        const Vec3d a = core::convert<double>(t.a), e = core::convert<double>(t.b) - a,
                    g = core::convert<double>(t.c) - a;
        return {a + u * e + v * g, core::normalized(core::cross(e, g))};
    }
    static Vec3d center(const core::Triangle& t) { return core::convert<double>(t.a); }
    static Vec3d special(const core::Triangle& t, Random& r) {
        const Vec3d e = core::convert<double>(t.b) - core::convert<double>(t.a);
        return r.integer(0, 1) == 0 ? core::normalized(e) : nearly_across(surface(t, r).normal, r);
    }
    static double size(const core::Triangle&) { return 5.0; }
};

template <>
struct Target<core::SmoothTriangle> {
    static core::SmoothTriangle make(Random& r, bool lattice) {
        const core::Triangle t = Target<core::Triangle>::make(r, lattice);
        return {t.a, t.b, t.c, Vec3f(0, 0, 1), Vec3f(0, 1, 0), Vec3f(1, 0, 0)};
    }
    static core::Triangle flat(const core::SmoothTriangle& t) { return {t.a, t.b, t.c}; }
    static SurfacePoint surface(const core::SmoothTriangle& t, Random& r) {
        return Target<core::Triangle>::surface(flat(t), r);
    }
    static Vec3d center(const core::SmoothTriangle& t) { return core::convert<double>(t.a); }
    static Vec3d special(const core::SmoothTriangle& t, Random& r) {
        return Target<core::Triangle>::special(flat(t), r);
    }
    static double size(const core::SmoothTriangle&) { return 5.0; }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

struct Trilateral : Flat {
    static constexpr bool tiles_polygons = true;
};
template <>
struct Nature<core::Triangle> : Trilateral {};
template <>
struct Nature<core::SmoothTriangle> : Trilateral {};

inline core::Triangle placed(const core::Triangle& t, const Placing& by) {
    return {by.point(t.a), by.point(t.b), by.point(t.c)};
}
inline core::SmoothTriangle placed(const core::SmoothTriangle& t, const Placing& by) {
    return {by.point(t.a), by.point(t.b), by.point(t.c), t.normal_a, t.normal_b, t.normal_c};
}

template <>
struct NestOf<core::Triangle> {
    static CloseShells make(double size, Random& r) {
        const core::Triangle t = triangle(size, r);
        const Vec3f normal = core::cross(t.b, t.c); // exact
        const auto step = [&] { return step_across(core::convert<double>(normal), size, r); };
        if (r.integer(0, 1) == 0)
            return {t, core::Plane{step(), normal}, core::Plane{-step(), normal}, true, true};
        const auto moved = [&](const Vec3f& by) {
            return core::Triangle{t.a + by, t.b + by, t.c + by};
        };
        return {t, moved(step()), moved(-step()), false};
    }
    /// Returns a triangle whose coordinates are small integers times a power of two.
    static core::Triangle triangle(double size, Random& r) {
        const double grid = std::exp2(std::max(0.0, std::ceil(std::log2(size / 512.0))));
        while (true) {
            const Vec3f b = whole(r.direction() * (size / grid)),
                        c = whole(r.direction() * (size / grid));
            const double area = core::length(core::convert<double>(core::cross(b, c)));
            if (area * grid * grid < 0.05 * size * size) continue;
            return {Vec3f(0), b * rounded(grid), c * rounded(grid)};
        }
    }
};

template <>
struct NestOf<core::SmoothTriangle> {
    static CloseShells make(double size, Random& r) {
        CloseShells nest = NestOf<core::Triangle>::make(size, r);
        nest.shape = smooth(std::get<core::Triangle>(nest.shape), r);
        if (!nest.parted) {
            nest.outer = smooth(std::get<core::Triangle>(nest.outer), r);
            nest.inner = smooth(std::get<core::Triangle>(nest.inner), r);
        }
        return nest;
    }

  private:
    static core::SmoothTriangle smooth(const core::Triangle& t, Random& r) {
        const Vec3d flat =
            core::normalized(core::convert<double>(core::cross(t.b - t.a, t.c - t.a)));
        const auto bent = [&] { return rounded(flat + 0.5 * r.direction()); };
        return {t.a, t.b, t.c, bent(), bent(), bent()};
    }
};

template <>
struct Restated<core::Triangle> {
    static core::Triangle make(int i) {
        const Vec3f corners[] = {{-2, -0.5F, 1}, {2, -0.25F, 0.5F}, {0.25F, 2, -1}};
        return {corners[i % 3], corners[(i + 1) % 3], corners[(i + 2) % 3]};
    }
};
/// A smooth triangle has only one description of how its normals are interpolated.
template <>
struct Restated<core::SmoothTriangle> {
    static core::SmoothTriangle make(int) {
        const core::Triangle flat = Restated<core::Triangle>::make(0);
        return {flat.a, flat.b, flat.c, {0, 1, 3}, {1, 0, 2}, {-1, 1, 2}};
    }
};

template <>
struct Written<core::Triangle> {
    static constexpr const char* text =
        R"("type": "triangle", "a": [0, 0, 0], "b": [1, 0.1, 0], "c": [0, 1, 0.2])";
    template <class Triangle>
    static Triangle by_name() {
        return {.a = {0, 0, 0}, .b = {1, 0.1, 0}, .c = {0, 1, 0.2}};
    }
};
template <>
struct Written<core::SmoothTriangle> {
    static constexpr const char* text =
        R"("type": "triangle", "a": [1, 2, 3], "b": [4, 5, 7], "c": [8, 9, 0],
           "normals": [[0, 0, 1], [0.1, 0, 1], [0, 0.2, 1]])";
    template <class Triangle>
    static Triangle by_name() {
        return {.a = {1, 2, 3},
                .b = {4, 5, 7},
                .c = {8, 9, 0},
                .normal_a = {0, 0, 1},
                .normal_b = {0.1, 0, 1},
                .normal_c = {0, 0.2, 1}};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

/// Solves f + t d = u e + v g by Cramer's rule.
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
std::vector<Hit> crossings(const core::TriangleOf<double>& triangle, const core::Ray<Real>& ray) {
    return triangle_crossing(triangle, ray);
}

template <class Real>
std::vector<Hit> crossings(const core::SmoothTriangleOf<double>& triangle,
                           const core::Ray<Real>& ray) {
    return triangle_crossing(triangle, ray);
}

template <class AnyTriangle>
Normal triangle_normal(const AnyTriangle& triangle) {
    return Normal::fixed(
        outer(vector(triangle.b) - vector(triangle.a), vector(triangle.c) - vector(triangle.a)));
}

template <class Real>
Normal normal(const core::TriangleOf<double>& triangle, const core::Ray<Real>&, const Hit&) {
    return triangle_normal(triangle);
}
template <class Real>
Normal normal(const core::SmoothTriangleOf<double>& triangle, const core::Ray<Real>&, const Hit&) {
    return triangle_normal(triangle);
}

template <class AnyTriangle>
Ball ball_around_triangle(const AnyTriangle& t) {
    return ball(t.a, std::max(length_of(t.b - t.a), length_of(t.c - t.a)));
}
inline Ball ball_around(const core::TriangleOf<double>& triangle) {
    return ball_around_triangle(triangle);
}
inline Ball ball_around(const core::SmoothTriangleOf<double>& triangle) {
    return ball_around_triangle(triangle);
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <>
struct Touching<core::Triangle> {
    /// The origin is inside, on an edge, or at a corner.
    static core::Triangle make(const Frame& frame, int r, Random& random) {
        switch (random.integer(0, 2)) {
        case 0:
            return {frame.exact(-r, -1, 0), frame.exact(r, -r, 0), frame.exact(0, r, 0)};
        case 1:
            return {frame.exact(-r, 0, 0), frame.exact(r, 0, 0), frame.exact(1, r, 0)};
        default:
            return {frame.exact(0, 0, 0), frame.exact(r, 0, 0), frame.exact(1, r, 0)};
        }
    }
};

template <>
struct Touching<core::SmoothTriangle> {
    static core::SmoothTriangle make(const Frame& frame, int r, Random& random) {
        const core::Triangle flat = Touching<core::Triangle>::make(frame, r, random);
        return {flat.a, flat.b, flat.c, Vec3f(0, 0, 1), Vec3f(0, 1, 0), Vec3f(1, 0, 0)};
    }
};

} // namespace raylane::meetings

namespace raylane::hard_cases {

template <class AnyTriangle>
AnyTriangle extreme_triangle(AnyTriangle t, Random& r) {
    const core::Vec3d a = in_double(t.a), e = in_double(t.b) - a;
    if (r.integer(0, 1) == 0) {
        t.b = core::convert<float>(core::Vec3d(a + e * r.log_uniform(1e-4, 1e2)));
    } else {
        const core::Vec3d g = in_double(t.c) - a;
        t.c = core::convert<float>(
            core::Vec3d(a + e * r.uniform(-1.0, 2.0) + g * r.log_uniform(1e-5, 1e-1)));
    }
    return t;
}

inline core::Triangle extreme(const core::Triangle& t, Random& r) {
    return extreme_triangle(t, r);
}
inline core::SmoothTriangle extreme(const core::SmoothTriangle& t, Random& r) {
    return extreme_triangle(t, r);
}

} // namespace raylane::hard_cases
