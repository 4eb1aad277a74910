#pragma once

#include "tests/simd/any_shape.hpp"
#include "tests/targets.hpp"

#include <glm/common.hpp>

#include <cmath>

/// Shapes between two neighbours, a small gap away on either side: a skin outside of it, and
/// another inside. All coordinates are whole numbers below 2^23 in size, so that the gaps are what
/// they are said to be, and stay so wherever a nest is placed; radii are any floats.
namespace raylane::tests {

using core::Vec3d;
using ray_sets::Random;
using ray_sets::rounded;

struct Nest {
    AnyShape shape, outer, inner;
    /// Whatever leaves `shape` outward meets `outer`.
    bool closed;
    /// Whatever leaves it inward meets `inner`.
    bool parted = false;
};

/// The smallest gap between coordinates: an ulp of the largest is 1 where a nest is far away.
inline constexpr double least_gap = 4.0;

inline double ulp(float value) {
    return static_cast<double>(std::nextafter(value, 2 * value) - value);
}

/// Between two radii: from 4 of their ulps to half of them.
inline float gap_of_radii(float radius, Random& r) {
    return rounded(r.log_uniform(4.0 * ulp(radius), 0.5 * static_cast<double>(radius)));
}

inline Vec3f whole(const Vec3d& v) {
    return rounded(glm::round(v));
}

template <class Shape>
struct NestOf;

template <>
struct NestOf<core::Sphere> {
    static Nest make(double size, Random& r) {
        const float radius = rounded(size * r.uniform(1.0, 2.0)), gap = gap_of_radii(radius, r);
        return {core::Sphere{Vec3f(0), radius}, core::Sphere{Vec3f(0), radius + gap},
                core::Sphere{Vec3f(0), radius - gap}, true};
    }
};

/// A step across planes with this normal, of at least 4 and whole numbers.
inline Vec3f step_across(const Vec3d& normal, double size, Random& r) {
    const Vec3d n = core::normalized(normal);
    while (true) {
        const Vec3f step = whole(n * r.log_uniform(least_gap, std::max(size, 8.0)));
        if (core::dot(n, core::convert<double>(step)) >= least_gap) return step;
    }
}

template <>
struct NestOf<core::Plane> {
    static Nest make(double size, Random& r) {
        const Vec3f normal = rounded(r.direction() * r.log_uniform(0.1, 10.0));
        const auto step = [&] { return step_across(core::convert<double>(normal), size, r); };
        return {core::Plane{Vec3f(0), normal}, core::Plane{step(), normal},
                core::Plane{-step(), normal}, true, true};
    }
};

template <>
struct NestOf<core::Disc> {
    static Nest make(double size, Random& r) {
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
struct NestOf<core::Triangle> {
    static Nest make(double size, Random& r) {
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
    /// With small numbers times a power of two.
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
    static Nest make(double size, Random& r) {
        Nest nest = NestOf<core::Triangle>::make(size, r);
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

/// How many gaps of this length make up some length: 4 to 2^16.
inline float number_of_gaps(double length, double gap) {
    return rounded(std::clamp(std::round(length / gap), 4.0, 0x1p16));
}

template <>
struct NestOf<core::Box> {
    static Nest make(double size, Random& r) {
        while (true) {
            const double gap = r.log_uniform(least_gap, std::max(0.25 * size, 6.0));
            const Vec3d n = r.direction(), m = ray_sets::across(n, r);
            Vec3f u = whole(n * (gap * r.uniform(1.0, 1.5)));
            Vec3f v = whole((m + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
            const Vec3f w = whole((core::cross(n, m) + r.cube(0.2)) * (gap * r.uniform(1.0, 1.5)));
            if (r.integer(0, 1) == 0) std::swap(u, v); // a left-handed one
            if (!(height(u, v, w) >= least_gap && height(v, w, u) >= least_gap &&
                  height(w, u, v) >= least_gap))
                continue;
            const float count = number_of_gaps(size, gap);
            const auto box = [&](float by) {
                return core::Box{-by * (u + v + w), (count + 2 * by) * u, (count + 2 * by) * v,
                                 (count + 2 * by) * w};
            };
            return {box(0), box(1), box(-1), true};
        }
    }

  private:
    static double height(const Vec3f& u, const Vec3f& v, const Vec3f& w) {
        const Vec3d face = core::cross(core::convert<double>(v), core::convert<double>(w));
        return std::abs(core::dot(core::convert<double>(u), core::normalized(face)));
    }
};

/// An axis, with that of the outer and the inner neighbour.
struct Axes {
    Vec3f step;
    float count;

    Axes(double size, Random& r) {
        const double gap = r.log_uniform(least_gap + 1.0, std::max(0.25 * size, 8.0));
        step = whole(r.direction() * gap);
        count = number_of_gaps(size * r.log_uniform(0.25, 4.0), gap);
    }
    Vec3f base(float by) const { return -by * step; }
    Vec3f axis(float by) const { return (count + 2 * by) * step; }
};

template <core::Ends ends>
struct NestOf<core::Cylinder<ends>> {
    static Nest make(double size, Random& r) {
        const Axes axes(size, r);
        const float radius = rounded(size * r.uniform(1.0, 2.0)), gap = gap_of_radii(radius, r);
        return {core::Cylinder<ends>{axes.base(0), axes.axis(0), radius},
                core::CappedCylinder{axes.base(1), axes.axis(1), radius + gap},
                core::CappedCylinder{axes.base(-1), axes.axis(-1), radius - gap}, true};
    }
};

template <core::Ends ends>
struct NestOf<core::Cone<ends>> {
    static Nest make(double size, Random& r) {
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
        // With sides parallel to the body's, as far as there is one.
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
    /// Beyond an apex parallels come too close.
    static core::CappedCone blunt(core::CappedCone outer, double base, double top, double taper,
                                  double gap) {
        if (base - taper + gap < gap) outer.base_radius = rounded(2.0 * gap);
        if (top + taper + gap < gap) outer.top_radius = rounded(2.0 * gap);
        return outer;
    }
};

/// The neighbours are other levels of the same form.
template <>
struct NestOf<core::Quadric> {
    static Nest make(double size, Random& r) {
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

} // namespace raylane::tests
