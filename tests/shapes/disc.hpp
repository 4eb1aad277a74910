#pragma once

#include "tests/shapes/parts.hpp"

#include <cmath>
#include <vector>

namespace raylane::ray_sets {

template <>
struct Target<core::Disc> {
    static core::Disc make(Random& r, bool lattice) {
        if (lattice)
            return {r.small_integers(3), r.small_integers_not_zero(1), rounded(r.integer(1, 5))};
        return {rounded(r.cube(10.0)), rounded(r.direction() * r.log_uniform(0.1, 10.0)),
                rounded(r.log_uniform(1e-3, 10.0))};
    }
    static SurfacePoint surface(const core::Disc& d, Random& r) {
        const Vec3d n = core::normalized(core::convert<double>(d.normal));
        const double rim = r.integer(0, 1) == 0 ? 1.0 : std::sqrt(r.uniform(0.0, 1.0));
        return {core::convert<double>(d.center) +
                    across(n, r) * (rim * static_cast<double>(d.radius)),
                n};
    }
    static Vec3d center(const core::Disc& d) { return core::convert<double>(d.center); }
    static Vec3d special(const core::Disc& d, Random& r) {
        return nearly_across(core::convert<double>(d.normal), r);
    }
    static double size(const core::Disc& d) { return static_cast<double>(d.radius); }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <>
struct Nature<core::Disc> : Flat {
    static constexpr bool has_displacement = true;
};

inline core::Disc placed(const core::Disc& d, const Placing& by) {
    return {by.point(d.center), d.normal, d.radius * by.factor()};
}

template <>
struct NestOf<core::Disc> {
    static CloseShells make(double size, Random& r) {
        const core::Disc disc{Vec3f(0), rounded(r.direction() * r.log_uniform(0.1, 10.0)),
                              rounded(size * r.uniform(1.0, 2.0))};
        const auto step = [&] { return step_across(core::convert<double>(disc.normal), size, r); };
        if (r.integer(0, 1) == 0)
            return {disc, core::Plane{step(), disc.normal}, core::Plane{-step(), disc.normal}, true,
                    true};
        return {disc, core::Disc{step(), disc.normal, 2 * disc.radius},
                core::Disc{-step(), disc.normal, 2 * disc.radius}, false};
    }
};

template <>
struct Restated<core::Disc> {
    static core::Disc make(int i) {
        return {{0, 0.5F, 0}, Vec3f(1, 2, 2) * static_cast<float>(i + 1), 2};
    }
};

inline double distance_to_face(const core::Disc& disc, core::Face, const Vec3d& point) {
    return std::abs(core::dot(point - core::convert<double>(disc.center),
                              core::normalized(core::convert<double>(disc.normal))));
}

template <>
struct Written<core::Disc> {
    static constexpr const char* text =
        R"("type": "disc", "center": [1, 2, 3], "normal": [0, 0, -2], "radius": 0.3)";
    template <class Disc>
    static Disc by_name() {
        return {.center = {1, 2, 3}, .normal = {0, 0, -2}, .radius = 0.3};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

template <class Real>
std::vector<Hit> crossings(const core::DiscOf<double>& disc, const core::Ray<Real>& ray) {
    const Line line(ray, disc.center);
    const auto hit = plane_crossing(line, vector(disc.normal));
    if (!hit || !is_within(line, hit->root, {}, Exact(disc.radius))) return {};
    return {*hit};
}

template <class Real>
Normal normal(const core::DiscOf<double>& disc, const core::Ray<Real>&, const Hit&) {
    return Normal::fixed(vector(disc.normal));
}

inline Ball ball_around(const core::DiscOf<double>& d) {
    return ball(d.center, d.radius);
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <>
struct Touching<core::Disc> {
    /// The origin is near the disc's centre, or on its rim.
    static core::Disc make(const Frame& frame, int r, Random& random) {
        const bool rim = random.integer(0, 1) == 0;
        return {rim ? frame.exact(3, 4, 0) : frame.exact(random.integer(-1, 1), 0, 0),
                frame.exact(0, 0, random.integer(1, 3)), radius_of(frame, rim ? 5 : r + 1)};
    }
    static core::Disc shell(const Frame& frame, int r) {
        return {frame.exact(0, 0, 0), frame.exact(0, 0, 1), radius_of(frame, r)};
    }
};

} // namespace raylane::meetings
