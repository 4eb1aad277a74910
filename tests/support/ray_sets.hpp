#pragma once

#include "core/shapes/ray.hpp"
#include "tests/shapes/shapes.hpp"

#include <glm/common.hpp>

#include <iterator>
#include <string_view>

/// Random rays, and rays on which methods fail. All numbers are floats. So a ray that is aimed at a
/// limb, a rim or an apex misses it by the rounding of the aim, except in the set `lattice`, whose
/// small integers meet it exactly.
namespace raylane::ray_sets {

enum class Set { random, inside, on_surface, grazing, parallel, zeros, far, lattice };
inline constexpr Set all_sets[] = {Set::random,   Set::inside, Set::on_surface, Set::grazing,
                                   Set::parallel, Set::zeros,  Set::far,        Set::lattice};
inline constexpr std::string_view set_names[] = {"random",   "inside", "on_surface", "grazing",
                                                 "parallel", "zeros",  "far",        "lattice"};

/// Returns any set but `lattice`, which needs shapes of small integers.
inline Set any_set(Random& random) {
    return all_sets[random.integer(0, static_cast<int>(std::size(all_sets)) - 2)];
}

/// Returns one ray of a set, for this shape. Its direction has any length.
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
