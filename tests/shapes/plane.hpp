#pragma once

#include "tests/shapes/parts.hpp"

#include <limits>
#include <vector>

namespace raylane::ray_sets {

template <>
struct Target<core::Plane> {
    static core::Plane make(Random& r, bool lattice) {
        if (lattice) return {r.small_integers(3), r.small_integers_not_zero(2)};
        return {rounded(r.cube(10.0)), rounded(r.direction() * r.log_uniform(0.1, 10.0))};
    }
    static SurfacePoint surface(const core::Plane& p, Random& r) {
        const Vec3d n = core::normalized(core::convert<double>(p.normal));
        return {core::convert<double>(p.point) + across(n, r) * r.uniform(0.0, 10.0), n};
    }
    static Vec3d center(const core::Plane& p) { return core::convert<double>(p.point); }
    static Vec3d special(const core::Plane& p, Random& r) {
        return nearly_across(core::convert<double>(p.normal), r);
    }
    static double size(const core::Plane&) { return 1.0; }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <>
struct Nature<core::Plane> : Flat {
    static constexpr bool is_bounded = false;
};

inline core::Plane placed(const core::Plane& p, const Placing& by) {
    return {by.point(p.point), p.normal};
}

template <>
struct NestOf<core::Plane> {
    static CloseShells make(double size, Random& r) {
        const Vec3f normal = rounded(r.direction() * r.log_uniform(0.1, 10.0));
        const auto step = [&] { return step_across(core::convert<double>(normal), size, r); };
        return {core::Plane{Vec3f(0), normal}, core::Plane{step(), normal},
                core::Plane{-step(), normal}, true, true};
    }
};

template <>
struct Restated<core::Plane> {
    static core::Plane make(int i) {
        const float step = 0.5F * static_cast<float>(i);
        return {{step, 1, 2.0F * step}, {0, 1.0F + step, 0}};
    }
};

template <>
struct Written<core::Plane> {
    static constexpr const char* text =
        R"("type": "plane", "point": [0, -9, 0], "normal": [0, 3, 0.1])";
    template <class Plane>
    static Plane by_name() {
        return {.point = {0, -9, 0}, .normal = {0, 3, 0.1}};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

template <class Real>
std::vector<Hit> crossings(const core::PlaneOf<double>& plane, const core::Ray<Real>& ray) {
    const auto hit = plane_crossing(Line(ray, plane.point), vector(plane.normal));
    return hit ? std::vector<Hit>{*hit} : std::vector<Hit>();
}

template <class Real>
Normal normal(const core::PlaneOf<double>& plane, const core::Ray<Real>&, const Hit&) {
    return Normal::fixed(vector(plane.normal));
}

inline Ball ball_around(const core::PlaneOf<double>& p) {
    return ball(p.point, std::numeric_limits<double>::infinity());
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <>
struct Touching<core::Plane> {
    static core::Plane make(const Frame& frame, int, Random& random) {
        return {frame.exact(random.integer(-2, 2), random.integer(-2, 2), 0),
                frame.exact(0, 0, random.integer(1, 3))};
    }
};

} // namespace raylane::meetings
