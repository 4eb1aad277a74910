#include "scenes/formats/structure/ortep.hpp"

#include "core/shapes/shape.hpp"

namespace raylane::scenes {

using core::Vec3d;
using core::Vec3f;

core::Ellipsoid ellipsoid_at(const Vec3f& center, const std::array<Vec3d, 3>& axes) {
    return {center, core::convert<float>(axes[0]), core::convert<float>(axes[1]),
            core::convert<float>(axes[2])};
}

std::array<core::Ellipsoid, 3> principal_ellipses(const core::Ellipsoid& ellipsoid) {
    // A flat ellipsoid that is wider by the factor 1 + s, and has the relative height h, stands
    // out of the surface up to the height h sqrt(2 s).
    constexpr float wide = 1.02F, flat = 0.25F;
    const Vec3f &u = ellipsoid.axis_u, &v = ellipsoid.axis_v, &w = ellipsoid.axis_w;
    return {{{ellipsoid.center, flat * u, wide * v, wide * w},
             {ellipsoid.center, wide * u, flat * v, wide * w},
             {ellipsoid.center, wide * u, wide * v, flat * w}}};
}

core::Solid without_octant(const core::Ellipsoid& ellipsoid, const Vec3d& to_camera,
                           core::MaterialIndex material, core::MaterialIndex of_ellipses,
                           core::MaterialIndex of_cut) {
    core::Solid eighths{.made = core::Made::by_union};
    eighths.parts.push_back({.shape = core::to_doubles(ellipsoid), .material = material});
    for (const core::Ellipsoid& rim : principal_ellipses(ellipsoid))
        eighths.parts.push_back({.shape = core::to_doubles(rim), .material = of_ellipses});
    core::Solid octant{.made = core::Made::by_intersection};
    for (const Vec3f& axis : {ellipsoid.axis_u, ellipsoid.axis_v, ellipsoid.axis_w}) {
        const Vec3d inward = core::convert<double>(axis);
        const double side = core::dot(inward, to_camera) < 0.0 ? 1.0 : -1.0;
        octant.parts.push_back(
            {.shape = core::PlaneOf<double>{core::convert<double>(ellipsoid.center), side * inward},
             .material = of_cut});
    }
    core::Solid rest{.made = core::Made::by_difference};
    rest.parts.push_back(std::move(eighths));
    rest.parts.push_back(std::move(octant));
    return rest;
}

} // namespace raylane::scenes
