#pragma once

#include "core/scene/shape_table.hpp"
#include "tests/ray_sets.hpp"

#include <cmath>
#include <iterator>

/// Shapes of all proportions and sizes, and rays in double at them: harder than the sets alone.
namespace raylane::hard_cases {

using namespace core;
using ray_sets::Random;
using ray_sets::Set;

inline Vec3d in_double(const Vec3f& v) {
    return convert<double>(v);
}

/// The same shape, `scale` times as large.
template <class Shape>
Shape scaled(const Shape& shape, double scale) {
    Floats<Shape> floats = floats_of(shape);
    for (float& value : floats)
        value = static_cast<float>(static_cast<double>(value) * scale);
    return shape_of<Shape>(floats);
}
template <>
inline Quadric scaled(const Quadric& q, double scale) {
    const auto f = [](double v) { return static_cast<float>(v); };
    const auto d = [](float v) { return static_cast<double>(v); };
    Quadric r = q;
    r.center = convert<float>(Vec3d(in_double(q.center) * scale));
    r.lower = convert<float>(Vec3d(in_double(q.lower) * scale));
    r.upper = convert<float>(Vec3d(in_double(q.upper) * scale));
    for (float* linear : {&r.x, &r.y, &r.z})
        *linear = f(d(*linear) * scale);
    r.one = f(d(q.one) * scale * scale);
    return r;
}

/// Long, flat, slender or blunt, that is of proportions that the usual targets do not have.
template <class Shape>
Shape extreme(const Shape& shape, Random&) {
    return shape;
}
template <Ends ends>
Cylinder<ends> extreme(Cylinder<ends> c, Random& r) {
    c.radius = static_cast<float>(static_cast<double>(c.radius) * r.log_uniform(1e-4, 1e3));
    return c;
}
template <Ends ends>
Cone<ends> extreme(Cone<ends> c, Random& r) {
    const double scale = r.log_uniform(1e-4, 1e3);
    c.base_radius = static_cast<float>(static_cast<double>(c.base_radius) * scale);
    c.top_radius = static_cast<float>(static_cast<double>(c.top_radius) * scale);
    if (r.integer(0, 2) == 0 && c.base_radius != 0.0F)
        c.top_radius = static_cast<float>(static_cast<double>(c.base_radius) *
                                          (1.0 + r.log_uniform(1e-7, 1e-1)));
    return c;
}
template <>
inline Box extreme(const Box& box, Random& r) {
    Box b = box;
    b.edge_u = convert<float>(Vec3d(in_double(b.edge_u) * r.log_uniform(1e-4, 1e3)));
    if (r.integer(0, 1) == 0)
        b.edge_v = convert<float>(Vec3d(in_double(b.edge_u) * r.log_uniform(0.1, 10.0) +
                                        in_double(b.edge_v) * r.log_uniform(1e-3, 1.0)));
    return b;
}
template <class AnyTriangle>
AnyTriangle extreme_triangle(AnyTriangle t, Random& r) {
    const Vec3d a = in_double(t.a), e = in_double(t.b) - a;
    if (r.integer(0, 1) == 0) {
        t.b = convert<float>(Vec3d(a + e * r.log_uniform(1e-4, 1e2)));
    } else {
        const Vec3d g = in_double(t.c) - a;
        t.c = convert<float>(Vec3d(a + e * r.uniform(-1.0, 2.0) + g * r.log_uniform(1e-5, 1e-1)));
    }
    return t;
}
template <>
inline Triangle extreme(const Triangle& t, Random& r) {
    return extreme_triangle(t, r);
}
template <>
inline SmoothTriangle extreme(const SmoothTriangle& t, Random& r) {
    return extreme_triangle(t, r);
}

/// Whether it is a shape at all.
template <class Shape>
bool is_shape(const Shape& shape) {
    for (const float value : floats_of(shape))
        if (!std::isfinite(value)) return false;
    return true;
}

/// Rays to try on a shape: those of the sets, and what is particular to filters.
template <class Shape>
Ray<double> attack(const Shape& shape, bool lattice, Random& random) {
    const Set set = lattice ? Set::lattice : ray_sets::any_set(random);
    const Ray<float> ray = ray_sets::make_ray(shape, set, random);
    Ray<double> result{in_double(ray.origin), in_double(ray.direction)};
    using T = ray_sets::Target<Shape>;
    switch (random.integer(0, 5)) {
    case 0: { // an origin that is not a float
        const double size = length(result.origin) * random.log_uniform(1e-16, 1e-6);
        result.origin += random.direction() * size;
        break;
    }
    case 1: { // aimed in double at the surface or just beside it
        const ray_sets::SurfacePoint target = T::surface(shape, random);
        const double size = T::size(shape);
        const double miss = random.integer(0, 1) == 0 ? 0.0 : size * random.log_uniform(1e-9, 1e-3);
        const Vec3d point = target.point + random.direction() * miss;
        const Vec3d d = random.integer(0, 1) == 0
                            ? normalized(ray_sets::across(target.normal, random) +
                                         target.normal * random.log_uniform(1e-9, 1e-2))
                            : random.direction();
        result = {point - d * (size * random.log_uniform(1e-3, 1e6)), d};
        break;
    }
    case 2: { // from just before, on or behind the surface
        const ray_sets::SurfacePoint target = T::surface(shape, random);
        const double off = T::size(shape) * random.log_uniform(1e-10, 1e-3);
        result.origin = target.point + target.normal * (random.integer(-1, 1) * off);
        break;
    }
    default:
        break;
    }
    return result;
}

template <class Shape>
Shape make_shape(Random& random, bool lattice) {
    while (true) {
        Shape shape = ray_sets::Target<Shape>::make(random, lattice);
        if (lattice) return shape;
        if (random.integer(0, 3) == 0) shape = extreme(shape, random);
        if (random.integer(0, 3) == 0) shape = scaled(shape, random.log_uniform(1e-8, 1e8));
        if (random.integer(0, 15) == 0) shape = scaled(shape, random.log_uniform(1e-15, 1e15));
        if (is_shape(shape)) return shape;
    }
}

} // namespace raylane::hard_cases
