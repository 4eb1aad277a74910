#pragma once

#include "tests/shapes/axial.hpp"
#include "tests/shapes/parts.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace raylane::ray_sets {

template <core::Ends ends>
struct Target<core::Cone<ends>> {
    using Shape = core::Cone<ends>;
    static Shape make(Random& r, bool lattice) {
        const bool apex_at_base = r.integer(0, 2) == 0,
                   apex_at_top = !apex_at_base && r.integer(0, 1) == 0;
        const auto radius = [&](bool apex) {
            if (apex) return 0.0F;
            return lattice ? rounded(r.integer(1, 5)) : rounded(r.log_uniform(1e-2, 10.0));
        };
        const Vec3f base = lattice ? r.small_integers(3) : rounded(r.cube(10.0));
        const Vec3f axis = lattice ? r.small_integers_not_zero(3)
                                   : rounded(r.direction() * r.log_uniform(0.01, 20.0));
        return {base, axis, radius(apex_at_base), radius(apex_at_top)};
    }
    static SurfacePoint surface(const Shape& c, Random& r) {
        return axial_surface(c, static_cast<double>(c.base_radius),
                             static_cast<double>(c.top_radius), r);
    }
    static Vec3d center(const Shape& c) { return axial_center(c); }
    /// Returns a direction along the axis, across it, or along a generator.
    static Vec3d special(const Shape& c, Random& r) {
        const Vec3d axis = core::convert<double>(c.axis), out = across(axis, r);
        switch (r.integer(0, 3)) {
        case 0:
            return axis;
        case 1:
            return out;
        default:
            return core::normalized(axis + out * (static_cast<double>(c.top_radius) -
                                                  static_cast<double>(c.base_radius)));
        }
    }
    static double size(const Shape& c) {
        return static_cast<double>(std::max(c.base_radius, c.top_radius));
    }
};

} // namespace raylane::ray_sets

namespace raylane::tests {

template <core::Ends ends>
struct Nature<core::Cone<ends>> : std::conditional_t<ends == core::Ends::capped, Solid, Curved> {
    static constexpr bool is_sifted = true;
};

template <core::Ends ends>
core::Cone<ends> placed(const core::Cone<ends>& c, const Placing& by) {
    return {by.point(c.base), c.axis * by.factor(), c.base_radius * by.factor(),
            c.top_radius * by.factor()};
}

template <core::Ends ends>
struct NestOf<core::Cone<ends>> {
    static CloseShells make(double size, Random& r) {
        const Axes axes(size, r);
        double base = size * r.uniform(0.5, 2.0), top = size * r.uniform(0.5, 2.0);
        const int apex = r.integer(0, 3);
        if (apex == 0) base = 0.0;
        if (apex == 1) top = 0.0;
        base = static_cast<double>(rounded(base));
        top = static_cast<double>(rounded(top));
        const double widest = std::max(base, top);
        const double gap =
            r.log_uniform(8.0 * ulp(rounded(widest)), (apex <= 1 ? 0.01 : 0.2) * widest);
        const double taper = (top - base) / static_cast<double>(axes.count);
        // The sides are parallel to the body's, as far as the body goes.
        const auto cone = [&](float by, double wider) {
            const double beyond = static_cast<double>(by) * taper;
            return core::CappedCone{axes.base(by), axes.axis(by),
                                    rounded(std::max(0.0, base - beyond + wider)),
                                    rounded(std::max(0.0, top + beyond + wider))};
        };
        return {core::Cone<ends>{axes.base(0), axes.axis(0), rounded(base), rounded(top)},
                blunt(cone(1, gap), base, top, taper, gap), cone(-1, -gap), true};
    }

  private:
    /// Makes ends of the outer cone blunt, as parallel sides come too close beyond an apex.
    static core::CappedCone blunt(core::CappedCone outer, double base, double top, double taper,
                                  double gap) {
        if (base - taper + gap < gap) outer.base_radius = rounded(2.0 * gap);
        if (top + taper + gap < gap) outer.top_radius = rounded(2.0 * gap);
        return outer;
    }
};

template <core::Ends ends>
struct Restated<core::Cone<ends>> {
    static core::Cone<ends> make(int i) {
        const Vec3f base(-1, -0.5F, 0), axis(1.5F, 1.5F, 0.5F);
        if (i % 2 == 0) return {base, axis, 1, 0.25F};
        return {base + axis, -axis, 0.25F, 1};
    }
};

template <>
struct Seamed<core::CappedCone> {
    static core::CappedCone make(Random& r) {
        const Vec3f axis = axis_of_integers(r);
        const float base_radius = five_times(0, r);
        return {r.small_integers(3), axis, base_radius, five_times(base_radius == 0.0F ? 1 : 0, r)};
    }
    static Seams seams(const core::CappedCone& c, Random&) {
        return rims(c.base, c.axis, c.base_radius, c.top_radius);
    }
};

inline double distance_to_face(const core::CappedCone& c, core::Face face, const Vec3d& point) {
    return axial_distance_to_face(c.base, c.axis, static_cast<double>(c.base_radius),
                                  static_cast<double>(c.top_radius), face, point);
}

template <core::Ends ends>
struct Written<core::Cone<ends>> {
    static constexpr const char* text =
        ends == core::Ends::open
            ? R"("type": "cone", "base": [1, 2, 3], "axis": [0, 5, 0], "base_radius": 0.9,
                 "top_radius": 0.4, "capped": false)"
            : R"("type": "cone", "base": [1, 2, 3], "axis": [0, 5, 0], "base_radius": 0.9,
                 "top_radius": 0.4)";
    template <class Cone>
    static Cone by_name() {
        return {.base = {1, 2, 3}, .axis = {0, 5, 0}, .base_radius = 0.9, .top_radius = 0.4};
    }
};

} // namespace raylane::tests

namespace raylane::oracle {

template <core::Ends ends, class Real>
std::vector<Hit> crossings(const core::ConeOf<double, ends>& c, const core::Ray<Real>& ray) {
    return axial_crossings(c, Exact(c.base_radius), Exact(c.top_radius), ends == core::Ends::capped,
                           ray);
}

template <core::Ends ends, class Real>
Normal normal(const core::ConeOf<double, ends>& c, const core::Ray<Real>& ray, const Hit& hit) {
    return axial_normal(c, Exact(c.base_radius), Exact(c.top_radius), ray, hit);
}

template <core::Ends ends>
Ball ball_around(const core::ConeOf<double, ends>& c) {
    return ball(c.base, length_of(c.axis) + std::max(c.base_radius, c.top_radius));
}

} // namespace raylane::oracle

namespace raylane::meetings {

template <core::Ends ends>
struct Touching<core::Cone<ends>> {
    static core::Cone<ends> make(const Frame& frame, int r, Random& random) {
        const int length = random.integer(1, 4);
        switch (random.integer(0, 3)) {
        case 0: // the apex, at either end
            if (random.integer(0, 1) == 0)
                return {frame.exact(0, 0, -length), frame.exact(0, 0, length), radius_of(frame, r),
                        0};
            return {frame.exact(0, 0, 0), frame.exact(0, 0, -length), 0, radius_of(frame, r)};
        case 1: // an end, with the origin on its rim
            return {frame.exact(3, 4, -length), frame.exact(0, 0, length), radius_of(frame, r),
                    radius_of(frame, 5)};
        default: {
            // A lying cone. It narrows by 3 in 4 along e = (4, 0, 3) / 5; across is (-3, 0, 4) / 5.
            const int width = 5 * random.integer(1, 2), back = 5 * random.integer(0, 2);
            const int on = 5 * random.integer(back == 0 ? 1 : 0, width / 5);
            const auto point = [&](double across, double along) {
                return frame.exact((4 * along - 3 * across) / 5, 0, (4 * across + 3 * along) / 5);
            };
            const double base_radius = width + 0.75 * back, top_radius = width - 0.75 * on;
            const Vec3f base = point(-width, -back), top = point(-width, on);
            return {base, top - base, radius_of(frame, base_radius), radius_of(frame, top_radius)};
        }
        }
    }
    static core::Cone<ends> shell(const Frame& frame, int r) requires(ends == core::Ends::capped) {
        const float radius = radius_of(frame, r);
        return {frame.exact(-2, 0, -r), frame.exact(2, 0, 0), 0.5F * radius, radius};
    }
};

} // namespace raylane::meetings

namespace raylane::hard_cases {

template <core::Ends ends>
core::Cone<ends> extreme(core::Cone<ends> c, Random& r) {
    const double scale = r.log_uniform(1e-4, 1e3);
    c.base_radius = static_cast<float>(static_cast<double>(c.base_radius) * scale);
    c.top_radius = static_cast<float>(static_cast<double>(c.top_radius) * scale);
    if (r.integer(0, 2) == 0 && c.base_radius != 0.0F)
        c.top_radius = static_cast<float>(static_cast<double>(c.base_radius) *
                                          (1.0 + r.log_uniform(1e-7, 1e-1)));
    return c;
}

} // namespace raylane::hard_cases
