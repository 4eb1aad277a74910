#include "scenes/formats/structure/ortep.hpp"

#include "core/shapes/shape.hpp"

namespace raylane::scenes {

using core::Vec3d;
using core::Vec3f;

core::Ellipsoid ellipsoid_at(const Vec3f& center, const std::array<Vec3d, 3>& axes) {
    return {center, core::convert<float>(axes[0]), core::convert<float>(axes[1]),
            core::convert<float>(axes[2])};
}

std::array<core::Ellipsoid, 3> principal_ellipses(const core::Ellipsoid& whole) {
    // A flat ellipsoid of relative height h stands out by s up to the height h sqrt(2 s).
    constexpr float wide = 1.02F, flat = 0.25F;
    const Vec3f &u = whole.axis_u, &v = whole.axis_v, &w = whole.axis_w;
    return {{{whole.center, flat * u, wide * v, wide * w},
             {whole.center, wide * u, flat * v, wide * w},
             {whole.center, wide * u, wide * v, flat * w}}};
}

core::Solid without_octant(const core::Ellipsoid& whole, const Vec3d& to_camera,
                           core::MaterialIndex material, core::MaterialIndex of_ellipses,
                           core::MaterialIndex of_cut) {
    core::Solid all{.made = core::Made::by_union};
    all.parts.push_back({.shape = core::to_doubles(whole), .material = material});
    for (const core::Ellipsoid& rim : principal_ellipses(whole))
        all.parts.push_back({.shape = core::to_doubles(rim), .material = of_ellipses});
    core::Solid octant{.made = core::Made::by_intersection};
    for (const Vec3f& axis : {whole.axis_u, whole.axis_v, whole.axis_w}) {
        const Vec3d inward = core::convert<double>(axis);
        const double side = core::dot(inward, to_camera) < 0.0 ? 1.0 : -1.0;
        octant.parts.push_back(
            {.shape = core::PlaneOf<double>{core::convert<double>(whole.center), side * inward},
             .material = of_cut});
    }
    core::Solid rest{.made = core::Made::by_difference};
    rest.parts.push_back(std::move(all));
    rest.parts.push_back(std::move(octant));
    return rest;
}

} // namespace raylane::scenes
