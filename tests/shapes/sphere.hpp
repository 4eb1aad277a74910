#pragma once

#include "tests/shapes/parts.hpp"

#include <cmath>
#include <vector>

namespace raylane::ray_sets {

template <>
struct Target<core::Sphere> {
    static core::Sphere make(Random& r, bool lattice) {
        if (lattice) return {r.small_integers(3), rounded(r.integer(1, 5))};
        return {rounded(r.cube(10.0)), rounded(r.log_uniform(1e-3, 10.0))};
    }
    static SurfacePoint surface(const core::Sphere& s, Random& r) {
        const Vec3d n = r.direction();
        return {core::convert<double>(s.center) + static_cast<double>(s.radius) * n, n};
    }
    static Vec3d center(const core::Sphere& s) { return core::convert<double>(s.center); }
    static Vec3d special(const core::Sphere&, Random& r) { return r.direction(); }
    static double size(const core::Sphere& s) { return static_cast<double>(s.radius); }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <>
struct Nature<core::Sphere> : Solid {
    static constexpr bool has_displacement = true;
    static constexpr bool is_sifted = true;
};

inline core::Sphere placed(const core::Sphere& s, const Placing& by) {
    return {by.point(s.center), s.radius * by.factor()};
}

template <>
struct NestOf<core::Sphere> {
    static CloseShells make(double size, Random& r) {
        const float radius = rounded(size * r.uniform(1.0, 2.0)), gap = gap_of_radii(radius, r);
        return {core::Sphere{Vec3f(0), radius}, core::Sphere{Vec3f(0), radius + gap},
                core::Sphere{Vec3f(0), radius - gap}, true};
    }
};

template <>
struct Restated<core::Sphere> {
    static core::Sphere make(int) { return {{0, 0.5F, 0}, 1.25F}; }
};

template <>
struct Seamed<core::Sphere> {
    static core::Sphere make(Random& r) { return {r.small_integers(3), five_times(1, r)}; }
    static Seams seams(const core::Sphere& s, Random&) {
        const float r = s.radius;
        return {s.center + Vec3f(r, 0, 0), s.center - Vec3f(0, r, 0),
                s.center + r / 5.0F * Vec3f(3, 4, 0), s.center + r / 5.0F * Vec3f(0, -4, 3)};
    }
};

inline double distance_to_face(const core::Sphere& sphere, core::Face, const Vec3d& point) {
    return std::abs(core::length(Vec3d(point - core::convert<double>(sphere.center))) -
                    static_cast<double>(sphere.radius));
}

template <>
struct Written<core::Sphere> {
    static constexpr const char* text =
        R"("type": "sphere", "center": [0.1, -2, 3], "radius": 0.7)";
    template <class Sphere>
    static Sphere by_name() {
        return {.center = {0.1, -2, 3}, .radius = 0.7};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

template <class Real>
std::vector<Hit> crossings(const core::SphereOf<double>& sphere, const core::Ray<Real>& ray) {
    const Line line(ray, sphere.center);
    const Exact r(sphere.radius);
    std::vector<Hit> hits;
    for (const FoundRoot& root :
         roots(inner(line.d, line.d), inner(line.f, line.d), inner(line.f, line.f) - r * r))
        hits.emplace_back(root.t, root.falling);
    return hits;
}

template <class Real>
Normal normal(const core::SphereOf<double>& sphere, const core::Ray<Real>& ray, const Hit& hit) {
    const Line line(ray, sphere.center);
    return {hit.root, line.f, line.d};
}

inline Ball ball_around(const core::SphereOf<double>& s) {
    return ball(s.center, s.radius);
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <>
struct Touching<core::Sphere> {
    static core::Sphere make(const Frame& frame, int r, Random&) {
        return {frame.exact(0, 0, -r), radius_of(frame, r)};
    }
    static core::Sphere shell(const Frame& frame, int r) {
        return {frame.exact(0, 0, -r), radius_of(frame, r)};
    }
};

} // namespace raylane::meetings
