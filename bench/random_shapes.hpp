#pragma once

#include "core/shapes/shape_table.hpp"

#include <random>
#include <type_traits>

/// Shapes of every kind, for measuring solvers.
namespace raylane::bench {

class Random {
  public:
    float uniform(float low, float high) {
        return low + (high - low) * (static_cast<float>(engine_() >> 8) * 0x1p-24F);
    }
    core::Vec3f cube(float size) {
        return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }
    int integer(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

  private:
    std::mt19937 engine_{1};
};

/// Vectors from which shapes are made, with components of up to 1.
struct Vectors {
    core::Vec3f a, b, c, d;
};

/// Makes shapes of one kind.
template <class Shape>
struct Maker;

template <>
struct Maker<core::Sphere> {
    static core::Sphere make(const Vectors& v, Random& r) { return {v.a, r.uniform(0.3F, 1)}; }
};
template <>
struct Maker<core::Plane> {
    static core::Plane make(const Vectors& v, Random&) { return {v.a, v.b}; }
};
template <>
struct Maker<core::Disc> {
    static core::Disc make(const Vectors& v, Random& r) {
        return {v.a, v.b, r.uniform(0.5F, 1.5F)};
    }
};
template <>
struct Maker<core::Triangle> {
    static core::Triangle make(const Vectors& v, Random&) {
        return {2.0F * v.a, 2.0F * v.b, 2.0F * v.c};
    }
};
template <>
struct Maker<core::SmoothTriangle> {
    static core::SmoothTriangle make(const Vectors& v, Random&) {
        return {2.0F * v.a, 2.0F * v.b, 2.0F * v.c, v.a, v.b, v.c};
    }
};
template <>
struct Maker<core::Box> {
    static core::Box make(const Vectors& v, Random&) { return {v.a, v.b, v.c, v.d}; }
};
template <core::Ends ends>
struct Maker<core::Cylinder<ends>> {
    static core::Cylinder<ends> make(const Vectors& v, Random& r) {
        return {v.a, 2.0F * v.b, r.uniform(0.2F, 0.8F)};
    }
};
template <core::Ends ends>
struct Maker<core::Cone<ends>> {
    static core::Cone<ends> make(const Vectors& v, Random& r) {
        return {v.a, 2.0F * v.b, r.uniform(0.3F, 1), r.uniform(0, 0.3F)};
    }
};
template <>
struct Maker<core::Quadric> {
    static core::Quadric make(const Vectors& v, Random& r) {
        const auto square = [&] { return r.uniform(0.5F, 3); };
        core::Quadric q{};
        q.center = v.a;
        q.xx = square();
        q.yy = square();
        q.zz = square();
        q.xy = q.yz = 0.1F;
        q.xz = 0.2F;
        q.one = -1;
        q.lower = core::Vec3f(-0.7F);
        q.upper = core::Vec3f(0.7F);
        return q;
    }
};

template <>
struct Maker<core::Ellipsoid> {
    static core::Ellipsoid make(const Vectors& v, Random&) { return {v.a, v.b, v.c, v.d}; }
};

/// Returns a shape of a size of about 1, within 1 of the origin.
template <class Shape>
Shape make_shape(Random& r) {
    const Vectors vectors{r.cube(1), r.cube(1), r.cube(1), r.cube(1)};
    return Maker<Shape>::make(vectors, r);
}

/// Calls visit.operator()<Shape>() for every kind in order.
template <class Visit>
void for_each_kind(const Visit& visit) {
    core::for_each_shape_type(
        [&]<class Shape>(std::type_identity<Shape>) { visit.template operator()<Shape>(); });
}

} // namespace raylane::bench
