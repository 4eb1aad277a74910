#pragma once

#include "tests/support/any_shape.hpp"
#include "tests/support/ray_sets.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raylane::tests {

using namespace core;
using ray_sets::Set;

/// Place of a nest, and its size.
struct Place {
    double size; ///< approximate size of the nest
    Vec3f offset;
    float factor;

    explicit Place(Random& r) {
        const double radii = r.log_uniform(1e-2, r.integer(0, 1) == 0 ? 10.0 : 1e6);
        size = std::clamp(0x1p23 / std::max(radii, 1.0), 8.0, 0x1p21);
        const double distance = std::min(radii * size, 0x1p23 - 0x1p5);
        offset = whole(r.direction() * distance);
        factor = rounded(std::exp2(std::round(std::log2(r.log_uniform(1e-6, 1e6) / size))));
    }
    Vec3d point(const Vec3d& p) const {
        return (p + convert<double>(offset)) * static_cast<double>(factor);
    }
};

/// Returns a ray from one of the sets, for the shape of a nest.
inline Ray<double> ray_to(const CloseShells& nest, const Place& place, Random& r) {
    constexpr Set sets[] = {Set::random,  Set::random,   Set::inside, Set::on_surface,
                            Set::grazing, Set::parallel, Set::zeros,  Set::far};
    const Set set = sets[r.integer(0, static_cast<int>(std::size(sets)) - 1)];
    const float unit = std::exp2(std::round(std::log2(rounded(place.size))));
    const Ray<float> ray = std::visit(
        [&](const auto& shape) {
            return ray_sets::make_ray(Placing(Vec3f(0), 1.0F / unit)(shape), set, r);
        },
        nest.shape);
    return {place.point(convert<double>(ray.origin) * static_cast<double>(unit)),
            normalized(convert<double>(ray.direction))};
}

/// Returns enough spheres for a hierarchy.
inline std::vector<AnyShape> far_spheres(const Place& place, Random& r) {
    std::vector<AnyShape> spheres;
    for (int i = 0; i < 30; ++i)
        spheres.push_back(
            Sphere{rounded(place.point(r.direction() * (place.size * r.log_uniform(1e2, 1e4)))),
                   rounded(place.size * static_cast<double>(place.factor))});
    return spheres;
}

} // namespace raylane::tests
