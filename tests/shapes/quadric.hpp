#pragma once

#include "core/shapes/quadric.hpp"
#include "tests/shapes/parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace raylane::ray_sets {

/// Makes ellipsoids, paraboloids, hyperboloids of one and two sheets, and random forms.
template <>
struct Target<core::Quadric> {
    static core::Quadric make(Random& r, bool lattice) {
        const auto value = [&](double size) {
            return lattice ? rounded(r.integer(-2, 2)) : rounded(r.uniform(-size, size));
        };
        const auto positive = [&] {
            return lattice ? rounded(r.integer(1, 3)) : rounded(r.log_uniform(0.1, 10.0));
        };
        core::Quadric q{};
        q.center = lattice ? r.small_integers(3) : rounded(r.cube(10.0));
        q.lower = Vec3f(-positive(), -positive(), -positive());
        q.upper = Vec3f(positive(), positive(), positive());
        q.xx = positive();
        q.yy = positive();
        switch (r.integer(0, 4)) {
        case 0:
            q.zz = positive();
            q.one = -positive();
            break; // ellipsoid
        case 1:
            q.z = -positive();
            break; // paraboloid
        case 2:
            q.zz = -positive();
            q.one = -positive();
            break; // one sheet
        case 3:
            q.zz = -positive();
            q.one = positive();
            break; // two sheets
        default:
            q = {q.center, value(2), value(2), value(2), value(2), value(2), value(2),
                 value(2), value(2), value(2), value(2), q.lower,  q.upper};
            if (q.xx == 0.0F && q.x == 0.0F) q.xx = 1.0F;
        }
        return q;
    }
    /// Starts at a random point of the box. The result is near the surface if Newton's method
    /// converges.
    static SurfacePoint surface(const core::Quadric& q, Random& r) {
        const Vec3d p = {r.uniform(static_cast<double>(q.lower.x), static_cast<double>(q.upper.x)),
                         r.uniform(static_cast<double>(q.lower.y), static_cast<double>(q.upper.y)),
                         r.uniform(static_cast<double>(q.lower.z), static_cast<double>(q.upper.z))};
        return slide(q, p, r);
    }
    static Vec3d center(const core::Quadric& q) { return core::convert<double>(q.center); }
    /// Returns a direction in which the leading term vanishes, if possible: d.M d = 0.
    static Vec3d special(const core::Quadric& q, Random& r) {
        const double ratio = -static_cast<double>(q.xx) / static_cast<double>(q.zz);
        if (r.integer(0, 1) == 0 && ratio > 0.0 && std::isfinite(ratio))
            return {1.0, 0.0, std::sqrt(ratio)};
        return {0.0, 0.0, 1.0};
    }
    static double size(const core::Quadric&) { return 1.0; }

  private:
    /// Moves a point to the surface by Newton's method along the gradient.
    static SurfacePoint slide(const core::Quadric& q, Vec3d p, Random& r) {
        Vec3d gradient = r.direction();
        for (int step = 0; step < 8; ++step) {
            const auto d = [](float f) { return static_cast<double>(f); };
            const Vec3d half = {d(q.xx) * p.x + d(q.xy) * p.y + d(q.xz) * p.z + d(q.x),
                                d(q.xy) * p.x + d(q.yy) * p.y + d(q.yz) * p.z + d(q.y),
                                d(q.xz) * p.x + d(q.yz) * p.y + d(q.zz) * p.z + d(q.z)};
            const double value =
                core::dot(p, half) + d(q.x) * p.x + d(q.y) * p.y + d(q.z) * p.z + d(q.one);
            if (!(core::squared_length(half) > 1e-12)) break;
            gradient = half;
            p -= half * (value / (2.0 * core::squared_length(half)));
        }
        return {core::convert<double>(q.center) + p, core::normalized(gradient)};
    }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <>
struct Nature<core::Quadric> : Curved {
    static constexpr bool may_come_back = true;
    static constexpr bool has_displacement = true;
};

/// Uses the form of p / factor.
inline core::Quadric placed(core::Quadric q, const Placing& by) {
    const float factor = by.factor();
    q.center = by.point(q.center);
    for (float* square : {&q.xx, &q.yy, &q.zz, &q.xy, &q.xz, &q.yz})
        *square /= factor * factor;
    for (float* linear : {&q.x, &q.y, &q.z})
        *linear /= factor;
    q.lower *= factor;
    q.upper *= factor;
    return q;
}

/// The neighbours are other level sets of the same form.
template <>
struct NestOf<core::Quadric> {
    static CloseShells make(double size, Random& r) {
        const bool closed = r.integer(0, 1) == 0;
        core::Quadric q = closed ? ellipsoid(r) : ray_sets::Target<core::Quadric>::make(r, false);
        q.center = Vec3f(0);
        const float step =
            rounded(r.log_uniform(4e-6, 0.1) * std::max(1.0, std::abs(static_cast<double>(q.one))));
        core::Quadric outer = q, inner = q;
        outer.one -= step;
        inner.one += step;
        outer.lower *= 2.0F;
        outer.upper *= 2.0F;
        const Placing larger(Vec3f(0), rounded(std::exp2(std::round(std::log2(size)))));
        return {larger(q), larger(outer), larger(inner), closed};
    }

  private:
    static core::Quadric ellipsoid(Random& r) {
        core::Quadric q{};
        q.xx = rounded(r.log_uniform(0.25, 4.0));
        q.yy = rounded(r.log_uniform(0.25, 4.0));
        q.zz = rounded(r.log_uniform(0.25, 4.0));
        q.xy = rounded(r.uniform(-0.1, 0.1));
        q.one = -1.0F;
        q.lower = Vec3f(-4.0F);
        q.upper = Vec3f(4.0F);
        return q;
    }
};

template <>
struct Restated<core::Quadric> {
    static core::Quadric make(int i) {
        const float scale = static_cast<float>(i + 1);
        core::Quadric bowl{};
        bowl.xx = bowl.yy = scale;
        bowl.zz = 0.5F * scale;
        bowl.one = -2.0F * scale;
        bowl.lower = Vec3f(-1.25F);
        bowl.upper = Vec3f(1.25F);
        return bowl;
    }
};

/// Returns the distance to first order.
inline double distance_to_face(const core::Quadric& quadric, core::Face, const Vec3d& point) {
    const Vec3d p = point - core::convert<double>(quadric.center);
    return std::abs(core::quadric_value(quadric, p)) /
           (2.0 * core::length(core::quadric_half_gradient(quadric, p)));
}

template <>
struct Written<core::Quadric> {
    static constexpr const char* text =
        R"("type": "quadric", "center": [0.1, 0.2, 0.3],
           "matrix": [[1, 2, 3, 4], [2, 5, 6, 7], [3, 6, 8, 9], [4, 7, 9, 10]],
           "lower": [-1, -2, -3], "upper": [1, 2, 3])";
    template <class Quadric>
    static Quadric by_name() {
        return {.center = {0.1, 0.2, 0.3},
                .xx = 1,
                .yy = 5,
                .zz = 8,
                .xy = 2,
                .xz = 3,
                .yz = 6,
                .x = 4,
                .y = 7,
                .z = 9,
                .one = 10,
                .lower = {-1, -2, -3},
                .upper = {1, 2, 3}};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

/// Returns M p. M p + linear is half the gradient.
inline Vector product(const core::QuadricOf<double>& q, const Vector& p) {
    return {inner(vector(core::Vec3d(q.xx, q.xy, q.xz)), p),
            inner(vector(core::Vec3d(q.xy, q.yy, q.yz)), p),
            inner(vector(core::Vec3d(q.xz, q.yz, q.zz)), p)};
}

template <class Real>
std::vector<Hit> crossings(const core::QuadricOf<double>& q, const core::Ray<Real>& ray) {
    const Line line(ray, q.center);
    const Vector linear = vector(core::Vec3d(q.x, q.y, q.z)), lower = vector(q.lower),
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

template <class Real>
Normal normal(const core::QuadricOf<double>& q, const core::Ray<Real>& ray, const Hit& hit) {
    const Line line(ray, q.center);
    const Vector linear = vector(core::Vec3d(q.x, q.y, q.z));
    const Normal normal{hit.root, product(q, line.f) + linear, product(q, line.d)};
    return normal.vanishes() ? Normal::fixed({Exact(0), Exact(0), Exact(1)}) : normal;
}

inline Ball ball_around(const core::QuadricOf<double>& q) {
    return ball(q.center, length_of(q.lower) + length_of(q.upper));
}

} // namespace raylane::oracle

namespace raylane::meetings {

/// Makes balls, pipes, sheets, cups and cones. They coincide with other shapes of the same length
/// `r`.
template <>
struct Touching<core::Quadric> {
    static core::Quadric make(const Frame& frame, int r, Random& random) {
        core::Quadric q{};
        const auto add_square = [&](int row) {
            const Vec3d v = frame.row(row);
            add(q.xx, v.x * v.x);
            add(q.yy, v.y * v.y);
            add(q.zz, v.z * v.z);
            add(q.xy, v.x * v.y);
            add(q.xz, v.x * v.z);
            add(q.yz, v.y * v.z);
        };
        double up = 0.0; // coefficient of z
        switch (random.integer(0, 4)) {
        case 0: // a ball of radius r
            add_square(0);
            add_square(1);
            add_square(2);
            up = r * frame.length() * frame.length();
            break;
        case 1: // a pipe along x
            add_square(1);
            add_square(2);
            up = r * frame.length() * frame.length();
            break;
        case 2: // a sheet
            up = random.integer(1, 3);
            break;
        case 3: // a cup
            add_square(0);
            add_square(1);
            up = r;
            break;
        default: // a cone with its apex at the origin
            add_square(0);
            add_square(1);
            add_square(2);
            q.xx -= static_cast<float>(2 * frame.row(2).x * frame.row(2).x);
            q.yy -= static_cast<float>(2 * frame.row(2).y * frame.row(2).y);
            q.zz -= static_cast<float>(2 * frame.row(2).z * frame.row(2).z);
            q.xy -= static_cast<float>(2 * frame.row(2).x * frame.row(2).y);
            q.xz -= static_cast<float>(2 * frame.row(2).x * frame.row(2).z);
            q.yz -= static_cast<float>(2 * frame.row(2).y * frame.row(2).z);
        }
        q.x = static_cast<float>(up * frame.row(2).x);
        q.y = static_cast<float>(up * frame.row(2).y);
        q.z = static_cast<float>(up * frame.row(2).z);
        // For half of them, the bounds have a face at the meeting.
        const float reach = radius_of(frame, 2 * r + random.integer(1, 3));
        q.lower = Vec3f(-reach);
        q.upper = Vec3f(reach);
        if (random.integer(0, 1) == 0) q.lower[random.integer(0, 2)] = 0.0F;
        return q;
    }

    /// Returns a ball.
    static core::Quadric shell(const Frame& frame, int r) {
        const float radius = radius_of(frame, r);
        core::Quadric ball{};
        ball.center = frame.exact(0, 0, -r);
        ball.xx = ball.yy = ball.zz = 1;
        ball.one = -radius * radius;
        ball.lower = Vec3f(-2.0F * radius);
        ball.upper = Vec3f(2.0F * radius);
        return ball;
    }

  private:
    static void add(float& to, double value) { to += static_cast<float>(value); }
};

} // namespace raylane::meetings

namespace raylane::hard_cases {

inline core::Quadric scaled(const core::Quadric& q, double scale) {
    const auto f = [](double v) { return static_cast<float>(v); };
    const auto d = [](float v) { return static_cast<double>(v); };
    core::Quadric r = q;
    r.center = core::convert<float>(core::Vec3d(in_double(q.center) * scale));
    r.lower = core::convert<float>(core::Vec3d(in_double(q.lower) * scale));
    r.upper = core::convert<float>(core::Vec3d(in_double(q.upper) * scale));
    for (float* linear : {&r.x, &r.y, &r.z})
        *linear = f(d(*linear) * scale);
    r.one = f(d(q.one) * scale * scale);
    return r;
}

inline void swap_axes(core::Quadric& q, int a, int b) {
    for (core::Vec3f* const vector : {&q.center, &q.lower, &q.upper})
        std::swap((*vector)[a], (*vector)[b]);
    float* const squares[] = {&q.xx, &q.yy, &q.zz};
    float* const mixed[] = {&q.yz, &q.xz, &q.xy}; // by the axis that each leaves out
    float* const linear[] = {&q.x, &q.y, &q.z};
    for (float* const* const terms : {squares, mixed, linear})
        std::swap(*terms[a], *terms[b]);
}

} // namespace raylane::hard_cases
