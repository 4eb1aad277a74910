#pragma once

#include "core/scene/shape_table.hpp"

#include <random>

/// Shapes of every kind to measure solvers by.
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

/// A shape of a size of about 1 within 1 of the origin.
template <class Shape>
Shape make_shape(Random& r) {
    using core::Kind, core::Vec3f;
    constexpr Kind kind = core::kind_of<Shape>;
    const Vec3f a = r.cube(1), b = r.cube(1), c = r.cube(1), d = r.cube(1);
    if constexpr (kind == Kind::sphere) return {a, r.uniform(0.3F, 1)};
    if constexpr (kind == Kind::plane) return {a, b};
    if constexpr (kind == Kind::disc) return {a, b, r.uniform(0.5F, 1.5F)};
    if constexpr (kind == Kind::triangle) return {2.0F * a, 2.0F * b, 2.0F * c};
    if constexpr (kind == Kind::smooth_triangle) return {2.0F * a, 2.0F * b, 2.0F * c, a, b, c};
    if constexpr (kind == Kind::box) return {a, b, c, d};
    if constexpr (kind == Kind::open_cylinder || kind == Kind::capped_cylinder)
        return {a, 2.0F * b, r.uniform(0.2F, 0.8F)};
    if constexpr (kind == Kind::open_cone || kind == Kind::capped_cone)
        return {a, 2.0F * b, r.uniform(0.3F, 1), r.uniform(0, 0.3F)};
    if constexpr (kind == Kind::quadric) {
        const auto square = [&] { return r.uniform(0.5F, 3); };
        return {a, square(), square(), square(), 0.1F,         0.2F,       0.1F,
                0, 0,        0,        -1,       Vec3f(-0.7F), Vec3f(0.7F)};
    }
}

/// Calls visit.operator()<Shape>() for every kind in order.
template <class Visit>
void for_each_kind(const Visit& visit) {
    const core::Tables none;
    core::for_each_table(
        none, [&]<class Shape>(const core::Table<Shape>&) { visit.template operator()<Shape>(); });
}

} // namespace raylane::bench
