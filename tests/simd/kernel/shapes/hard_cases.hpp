#pragma once

#include "core/shapes/shape_table.hpp"
#include "tests/support/ray_sets.hpp"

#include <cmath>

/// Shapes of all proportions and sizes, and rays in double at them: harder than ray_sets alone.
namespace raylane::hard_cases {

using namespace core;
using ray_sets::Set;

/// Returns whether all numbers of a shape are finite.
template <class Shape>
bool is_shape(const Shape& shape) {
    for (const float value : numbers_of(shape))
        if (!std::isfinite(value)) return false;
    return true;
}

/// Returns a ray to try on a shape: one from the sets, or one that is hard for filters.
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
