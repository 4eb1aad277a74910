#pragma once

#include "core/shapes/shapes.hpp"
#include "tests/random.hpp"

#include <algorithm>
#include <cmath>

/// Random shapes, and where to aim at them.
namespace raylane::ray_sets {

/// A shape with a way to point at it: points on it, tangents there, and the directions special to
/// it.
template <class Shape>
struct Target;

struct SurfacePoint {
    Vec3d point;
    Vec3d normal;
};

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
        switch (r.integer(0, 4)) { // edges and corners count as much as the inside
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

template <>
struct Target<core::Box> {
    static core::Box make(Random& r, bool lattice) {
        if (r.integer(0, 1) == 0) { // along the axes
            const auto edge = [&] {
                return lattice ? rounded(r.integer(1, 4)) : rounded(r.log_uniform(1e-2, 10.0));
            };
            const Vec3f corner = lattice ? r.small_integers(3) : rounded(r.cube(10.0));
            return {corner, {edge(), 0, 0}, {0, edge(), 0}, {0, 0, edge()}};
        }
        while (true) {
            const core::Box b = lattice ? core::Box{r.small_integers(3), r.small_integers(3),
                                                    r.small_integers(3), r.small_integers(3)}
                                        : core::Box{rounded(r.cube(10.0)), rounded(r.cube(5.0)),
                                                    rounded(r.cube(5.0)), rounded(r.cube(5.0))};
            const Vec3d u = core::convert<double>(b.edge_u), v = core::convert<double>(b.edge_v);
            if (std::abs(core::dot(core::cross(u, v), core::convert<double>(b.edge_w))) > 1e-3)
                return b;
        }
    }
    static SurfacePoint surface(const core::Box& b, Random& r) {
        const Vec3d edges[3] = {core::convert<double>(b.edge_u), core::convert<double>(b.edge_v),
                                core::convert<double>(b.edge_w)};
        double at[3] = {r.uniform(0.0, 1.0), r.uniform(0.0, 1.0), r.uniform(0.0, 1.0)};
        const int face = r.integer(0, 2);
        at[face] = r.integer(0, 1);
        if (r.integer(0, 2) == 0) at[(face + 1) % 3] = r.integer(0, 1); // an edge
        return {core::convert<double>(b.corner) + at[0] * edges[0] + at[1] * edges[1] +
                    at[2] * edges[2],
                core::normalized(core::cross(edges[(face + 1) % 3], edges[(face + 2) % 3]))};
    }
    static Vec3d center(const core::Box& b) {
        return core::convert<double>(b.corner) +
               0.5 * (core::convert<double>(b.edge_u) + core::convert<double>(b.edge_v) +
                      core::convert<double>(b.edge_w));
    }
    static Vec3d special(const core::Box& b, Random& r) {
        return core::convert<double>(r.integer(0, 1) == 0 ? b.edge_u : b.edge_w);
    }
    static double size(const core::Box& b) { return core::length(core::convert<double>(b.edge_u)); }
};

/// Cylinders and cones: a point of the body, of a rim, of a cap or the apex.
template <class Shape>
SurfacePoint axial_surface(const Shape& c, double r0, double r1, Random& r) {
    const Vec3d base = core::convert<double>(c.base), axis = core::convert<double>(c.axis);
    double s = r.uniform(0.0, 1.0), inwards = 1.0;
    const int part = r.integer(0, 3);
    if (part <= 1) s = r.integer(0, 1);           // a rim, or the apex
    if (part == 1) inwards = r.uniform(0.0, 1.0); // a cap
    const Vec3d out = across(axis, r);
    const Vec3d normal =
        part == 1 ? core::normalized(axis)
                  : core::normalized(out - axis * ((r1 - r0) / core::squared_length(axis)));
    return {base + s * axis + (inwards * (r0 + s * (r1 - r0))) * out, normal};
}

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
    static Vec3d center(const Shape& c) {
        return core::convert<double>(c.base) + 0.5 * core::convert<double>(c.axis);
    }
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
    static Vec3d center(const Shape& c) {
        return core::convert<double>(c.base) + 0.5 * core::convert<double>(c.axis);
    }
    /// Along the axis, across it, or along a generator.
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

/// Ellipsoids, paraboloids, hyperboloids of one and two sheets, and any form at all.
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
    /// Not on the surface in general: a point of the box, and the form's normal there.
    static SurfacePoint surface(const core::Quadric& q, Random& r) {
        const Vec3d p = {r.uniform(static_cast<double>(q.lower.x), static_cast<double>(q.upper.x)),
                         r.uniform(static_cast<double>(q.lower.y), static_cast<double>(q.upper.y)),
                         r.uniform(static_cast<double>(q.lower.z), static_cast<double>(q.upper.z))};
        return slide(q, p, r);
    }
    static Vec3d center(const core::Quadric& q) { return core::convert<double>(q.center); }
    /// Directions in which the leading term vanishes, where there are any: d.M d = 0.
    static Vec3d special(const core::Quadric& q, Random& r) {
        const double ratio = -static_cast<double>(q.xx) / static_cast<double>(q.zz);
        if (r.integer(0, 1) == 0 && ratio > 0.0 && std::isfinite(ratio))
            return {1.0, 0.0, std::sqrt(ratio)};
        return {0.0, 0.0, 1.0};
    }
    static double size(const core::Quadric&) { return 1.0; }

  private:
    /// Newton's method along the gradient.
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

/// For TEMPLATE_TEST_CASE, by the names that they have within raylane::core: given a list that is a
/// type, it would number the tests.
#define RAYLANE_ALL_SHAPES                                                                         \
    Sphere, Plane, Disc, Triangle, SmoothTriangle, Box, OpenCylinder, CappedCylinder, OpenCone,    \
        CappedCone, Quadric

} // namespace raylane::ray_sets
