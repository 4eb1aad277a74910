#pragma once

#include "tests/shapes/axial.hpp"
#include "tests/shapes/parts.hpp"

#include <type_traits>
#include <vector>

namespace raylane::ray_sets {

template <core::Ends ends>
struct Target<core::Cylinder<ends>> {
    using Shape = core::Cylinder<ends>;
    static Shape make(Random& r, bool lattice) {
        if (lattice)
            return {r.small_integers(3), r.small_integers_not_zero(3), rounded(r.integer(1, 5))};
        return {rounded(r.cube(10.0)), rounded(r.direction() * r.log_uniform(0.01, 20.0)),
                rounded(r.log_uniform(1e-3, 10.0))};
    }
    static SurfacePoint surface(const Shape& c, Random& r) {
        return axial_surface(c, static_cast<double>(c.radius), static_cast<double>(c.radius), r);
    }
    static Vec3d center(const Shape& c) { return axial_center(c); }
    static Vec3d special(const Shape& c, Random& r) {
        const Vec3d axis = core::normalized(core::convert<double>(c.axis));
        switch (r.integer(0, 2)) {
        case 0:
            return axis;
        case 1:
            return across(axis, r);
        default:
            return core::normalized(axis + across(axis, r) * r.log_uniform(1e-7, 1e-1));
        }
    }
    static double size(const Shape& c) { return static_cast<double>(c.radius); }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <core::Ends ends>
struct Nature<core::Cylinder<ends>>
    : std::conditional_t<ends == core::Ends::capped, Solid, Curved> {
    static constexpr bool is_sifted = true;
};

template <core::Ends ends>
core::Cylinder<ends> placed(const core::Cylinder<ends>& c, const Placing& by) {
    return {by.point(c.base), c.axis * by.factor(), c.radius * by.factor()};
}

template <core::Ends ends>
struct NestOf<core::Cylinder<ends>> {
    static CloseShells make(double size, Random& r) {
        const Axes axes(size, r);
        const float radius = rounded(size * r.uniform(1.0, 2.0)), gap = gap_of_radii(radius, r);
        return {core::Cylinder<ends>{axes.base(0), axes.axis(0), radius},
                core::CappedCylinder{axes.base(1), axes.axis(1), radius + gap},
                core::CappedCylinder{axes.base(-1), axes.axis(-1), radius - gap}, true};
    }
};

template <core::Ends ends>
struct Restated<core::Cylinder<ends>> {
    static core::Cylinder<ends> make(int i) {
        const Vec3f base(-1, -0.5F, 0), axis(1.5F, 1.5F, 0.5F);
        if (i % 2 == 0) return {base, axis, 0.75F};
        return {base + axis, -axis, 0.75F};
    }
};

template <>
struct Seamed<core::CappedCylinder> {
    static core::CappedCylinder make(Random& r) {
        const Vec3f axis = axis_of_integers(r);
        return {r.small_integers(3), axis, five_times(1, r)};
    }
    static Seams seams(const core::CappedCylinder& c, Random&) {
        return rims(c.base, c.axis, c.radius, c.radius);
    }
};

inline double distance_to_face(const core::CappedCylinder& c, core::Face face, const Vec3d& point) {
    const double radius = static_cast<double>(c.radius);
    return axial_distance_to_face(c.base, c.axis, radius, radius, face, point);
}

template <core::Ends ends>
struct Written<core::Cylinder<ends>> {
    static constexpr const char* text =
        ends == core::Ends::open
            ? R"("type": "cylinder", "base": [1, 2, 3], "axis": [0, 0.1, 4], "radius": 0.6,
                 "capped": false)"
            : R"("type": "cylinder", "base": [1, 2, 3], "axis": [0, 0.1, 4], "radius": 0.6)";
    template <class Cylinder>
    static Cylinder by_name() {
        return {.base = {1, 2, 3}, .axis = {0, 0.1, 4}, .radius = 0.6};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

template <core::Ends ends, class Real>
std::vector<Hit> crossings(const core::CylinderOf<double, ends>& c, const core::Ray<Real>& ray) {
    return axial_crossings(c, Exact(c.radius), Exact(c.radius), ends == core::Ends::capped, ray);
}

template <core::Ends ends, class Real>
Normal normal(const core::CylinderOf<double, ends>& c, const core::Ray<Real>& ray, const Hit& hit) {
    return axial_normal(c, Exact(c.radius), Exact(c.radius), ray, hit);
}

template <core::Ends ends>
Ball ball_around(const core::CylinderOf<double, ends>& c) {
    return ball(c.base, length_of(c.axis) + c.radius);
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <core::Ends ends>
struct Touching<core::Cylinder<ends>> {
    static core::Cylinder<ends> make(const Frame& frame, int r, Random& random) {
        const int a = random.integer(0, 2), length = random.integer(1, 4);
        const double reach = random.integer(0, 1) == 0 ? length : -length;
        switch (random.integer(0, 3)) {
        case 0: // an end, with the origin at its centre or on its rim
            if (random.integer(0, 1) == 0)
                return {frame.exact(3, 4, -length), frame.exact(0, 0, length), radius_of(frame, 5)};
            return {frame.exact(0, 0, 0), frame.exact(0, 0, -length), radius_of(frame, r)};
        case 1: // lying, with the origin on the rim
            return {frame.exact(0, 0, -r), frame.exact(reach, 0, 0), radius_of(frame, r)};
        default: // lying
            return {frame.exact(reach > 0 ? -a : a, 0, -r), frame.exact(reach * (a + 1), 0, 0),
                    radius_of(frame, r)};
        }
    }
    static core::Cylinder<ends> shell(const Frame& frame, int r) {
        const bool capped = ends == core::Ends::capped;
        return {frame.exact(capped ? -2 : -1, 0, -r), frame.exact(capped ? 4 : 3, 0, 0),
                radius_of(frame, r)};
    }
};

} // namespace raylane::meetings

namespace raylane::hard_cases {

template <core::Ends ends>
core::Cylinder<ends> extreme(core::Cylinder<ends> c, Random& r) {
    c.radius = static_cast<float>(static_cast<double>(c.radius) * r.log_uniform(1e-4, 1e3));
    return c;
}

} // namespace raylane::hard_cases
