#include "core/shapes/departure.hpp"
#include "simd/isa/isa.hpp"
#include "simd/units/kernels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <cmath>
#include <string>

/// The sides of spheres to which rays go, found for many rays at a time.
using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;

namespace {

struct Departures {
    LeftSpheres spheres;
    double origin[3][LeftSpheres::size], direction[3][LeftSpheres::size];

    void set(std::size_t i, const SphereOf<double>& sphere, const Ray<double>& ray) {
        for (int axis = 0; axis < 3; ++axis) {
            spheres.center[axis][i] = sphere.center[axis];
            origin[axis][i] = ray.origin[axis];
            direction[axis][i] = ray.direction[axis];
        }
        spheres.radius[i] = sphere.radius;
    }
    SphereOf<double> sphere(std::size_t i) const {
        return {{spheres.center[0][i], spheres.center[1][i], spheres.center[2][i]},
                spheres.radius[i]};
    }
    Ray<double> ray(std::size_t i) const {
        return {{origin[0][i], origin[1][i], origin[2][i]},
                {direction[0][i], direction[1][i], direction[2][i]}};
    }
    DepartureSides sides(Isa isa, std::size_t count, double share) {
        StreamRays rays{};
        for (int axis = 0; axis < 3; ++axis) {
            rays.origin[axis] = origin[axis];
            rays.exact_direction[axis] = direction[axis];
        }
        return kernels_of(isa).stream.find_sides(count, rays, spheres, share);
    }
};

/// Returns a vector whose largest component is from 1 to 2, as rays are taken in.
Vec3d scaled(const Vec3d& direction) {
    return direction * std::ldexp(1.0, -std::ilogb(largest_component(direction)));
}

/// Fills all places with spheres and rays that leave them, or miss them, or only touch them.
void fill(Departures& departures, Random& random) {
    for (std::size_t i = 0; i < LeftSpheres::size; ++i) {
        const auto radius =
            static_cast<double>(static_cast<float>(random.log_uniform(1e-18, 1e18)));
        const Vec3d center =
            convert<double>(convert<float>(random.log_uniform(1e-18, 1e18) * random.direction()));
        const Vec3d normal = random.direction();
        const Vec3d point = center + radius * normal;
        const Vec3d origins[] = {point, convert<double>(convert<float>(point)),
                                 point + radius * random.log_uniform(1e-9, 1.0) * normal, center};
        const Vec3d tangent = cross(normal, random.direction());
        const Vec3d directions[] = {random.direction(), tangent,
                                    tangent + random.log_uniform(1e-18, 1e-9) * normal, -normal};
        departures.set(i, {center, radius},
                       {origins[random.integer(0, 3)], scaled(directions[random.integer(0, 3)])});
    }
}

} // namespace

TEST_CASE("kernels find the sides of departure that few operations decide, and no others") {
    Random random(53);
    Departures departures;
    int found[3] = {}; // inside, undecided, outside
    for (int round = 0; round < 200; ++round) {
        fill(departures, random);
        const auto count = static_cast<std::size_t>(random.integer(1, LeftSpheres::size));
        const double share = random.integer(0, 1) == 0 ? 0x1p-6 : 0x1p-10;
        for (const Isa isa : available_isas()) {
            CAPTURE(std::string(name_of(isa)), count);
            const DepartureSides sides = departures.sides(isa, count, share);
            for (std::size_t i = 0; i < LeftSpheres::size; ++i) {
                const int side = i < count ? clear_side_of_departure(departures.sphere(i),
                                                                     departures.ray(i), body, share)
                                           : 0;
                ++found[1 + side];
                CHECK(static_cast<int>(sides.outside >> i & 1) == (side > 0 ? 1 : 0));
                CHECK(static_cast<int>(sides.inside >> i & 1) == (side < 0 ? 1 : 0));
            }
        }
    }
    for (const int some : found)
        CHECK(some > 100);
}
