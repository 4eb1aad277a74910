#pragma once

#include "core/shapes/types.hpp"
#include "core/solids/solid.hpp"

#include <array>

/// Ellipsoids of displacements as in ORTEP (Johnson, Oak Ridge ORNL-3794, 1965).
namespace raylane::scenes {

core::Ellipsoid ellipsoid_at(const core::Vec3f& center, const std::array<core::Vec3d, 3>& axes);

/// Returns the principal ellipses of an ellipsoid with perpendicular axes. Each is a flat ellipsoid
/// of which a narrow rim stands out of the surface, by 2 % of the axes.
std::array<core::Ellipsoid, 3> principal_ellipses(const core::Ellipsoid& ellipsoid);

/// Returns an ellipsoid with its principal ellipses, without the octant that faces the camera.
/// `to_camera`: direction, of any length.
core::Solid without_octant(const core::Ellipsoid& ellipsoid, const core::Vec3d& to_camera,
                           core::MaterialIndex material, core::MaterialIndex of_ellipses,
                           core::MaterialIndex of_cut);

} // namespace raylane::scenes
