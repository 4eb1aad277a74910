#pragma once

#include "core/ray.hpp"
#include "core/shapes.hpp"

#include <glm/common.hpp>

#include <cmath>
#include <iterator>
#include <random>
#include <string_view>
#include <vector>

/// Shapes and rays that methods fail on, beside random ones. All are floats: what is aimed at a
/// limb, a rim or an apex misses it by the rounding of the aim, except in the set `lattice`, whose
/// small integers meet it exactly.
namespace raylane::ray_sets {

using core::Vec3d;
using core::Vec3f;

enum class Set { random, inside, on_surface, grazing, parallel, zeros, far, lattice };
inline constexpr Set all_sets[] = {Set::random,   Set::inside, Set::on_surface, Set::grazing,
                                   Set::parallel, Set::zeros,  Set::far,        Set::lattice};
inline constexpr std::string_view set_names[] = {"random",   "inside", "on_surface", "grazing",
                                                 "parallel", "zeros",  "far",        "lattice"};

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    int integer(int low, int high) {
        const std::int64_t count = std::int64_t{high} - low + 1;
        return static_cast<int>(
            low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(count)));
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    Vec3d cube(double size) {
        return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }
    Vec3d direction() {
        while (true) {
            const Vec3d v = cube(1.0);
            const double square = core::squared_length(v);
            if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
        }
    }
    Vec3f small_integers(int most) {
        return {static_cast<float>(integer(-most, most)), static_cast<float>(integer(-most, most)),
                static_cast<float>(integer(-most, most))};
    }
    Vec3f small_integers_not_zero(int most) {
        while (true) {
            const Vec3f v = small_integers(most);
            if (v != Vec3f(0.0F)) return v;
        }
    }

  private:
    std::mt19937_64 engine_;
};

/// Any but the lattice, which is for shapes of its own.
inline Set any_set(Random& random) {
    return all_sets[random.integer(0, static_cast<int>(std::size(all_sets)) - 2)];
}

/// Not inline: g++ 12 takes the way to float and back for none where it makes vectors of it.
[[gnu::noinline]] inline Vec3f rounded(const Vec3d& v) {
    return core::convert<float>(v);
}
inline float rounded(double v) {
    return static_cast<float>(v);
}

/// Any unit vector at right angles to v.
inline Vec3d across(const Vec3d& v, Random& random) {
    return core::normalized(core::cross(v, random.direction()));
}

/// Within the plane, or all but: tilted by 1e-7 to 1e-1.
inline Vec3d nearly_across(const Vec3d& normal, Random& random) {
    const Vec3d n = core::normalized(normal);
    const double tilt = random.integer(0, 2) == 0 ? 0.0 : random.log_uniform(1e-7, 1e-1);
    return across(n, random) + n * tilt;
}

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

/// One ray of a set, for this shape. Its direction has any length.
template <class Shape>
core::Ray<float> make_ray(const Shape& shape, Set set, Random& r) {
    using T = Target<Shape>;
    const SurfacePoint target = T::surface(shape, r);
    const double size = T::size(shape);
    const auto towards = [&](const Vec3d& point, const Vec3d& direction, double distance) {
        const Vec3f origin = rounded(point - distance * direction);
        return core::Ray<float>{
            origin, rounded((point - core::convert<double>(origin)) * r.log_uniform(0.1, 10.0))};
    };
    switch (set) {
    case Set::random: { // half of them aimed, so that small shapes are hit at all
        const Vec3f origin = rounded(r.cube(20.0));
        if (r.integer(0, 1) == 0) return {origin, rounded(r.direction())};
        const Vec3d near = T::center(shape) + r.direction() * (size * r.uniform(0.0, 1.5));
        return {origin, rounded((near - core::convert<double>(origin)) * r.log_uniform(0.1, 10.0))};
    }
    case Set::inside: {
        const Vec3d origin =
            T::center(shape) + (target.point - T::center(shape)) * r.uniform(0.0, 1.0);
        return {rounded(origin), rounded(r.direction())};
    }
    case Set::on_surface:
        return {rounded(target.point), rounded(r.direction())};
    case Set::grazing:
        return towards(target.point, across(target.normal, r), size * r.log_uniform(0.1, 1e3));
    case Set::parallel: {
        const Vec3d offset =
            r.integer(0, 3) == 0 ? Vec3d(0.0) : r.direction() * (size * r.log_uniform(1e-6, 1.0));
        const Vec3d d = T::special(shape, r);
        return {rounded(target.point + offset - d * r.uniform(-1.0, 5.0)), rounded(d)};
    }
    case Set::zeros: {
        core::Ray<float> ray = towards(target.point, r.direction(), 5.0);
        const float zero = r.integer(0, 1) == 0 ? 0.0F : -0.0F;
        const int kept = r.integer(0, 2);
        for (int axis = 0; axis < 3; ++axis)
            if (axis != kept && (r.integer(0, 2) != 0)) {
                ray.direction[axis] = zero;
                if (r.integer(0, 1) == 0) ray.origin[axis] = rounded(target.point[axis]);
            }
        if (ray.direction == Vec3f(0.0F)) ray.direction[kept] = 1.0F;
        return ray;
    }
    case Set::far:
        return towards(target.point, r.direction(), size * r.log_uniform(1e3, 1e6));
    case Set::lattice:
        break;
    }
    // Small integers, so that tangents, rims, edges and corners are met exactly, and directions
    // have zeros.
    const Vec3f origin = r.small_integers(8);
    const Vec3d reach = Vec3d(1.0 + std::ceil(size)) * Vec3d(r.direction());
    const Vec3f aim = rounded(glm::ceil(T::center(shape) + reach)) - origin;
    if (r.integer(0, 2) == 0 || aim == Vec3f(0.0F))
        return {origin, r.small_integers_not_zero(r.integer(1, 4))};
    return {origin, aim};
}

} // namespace raylane::ray_sets
