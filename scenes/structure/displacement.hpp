#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/structure/structure.hpp"

#include <array>
#include <optional>

namespace raylane::scenes {

/// The principal axes of the surface that holds half of a displacement's probability, 1.5382
/// standard deviations away, in angstrom; nothing for a tensor that is none of an ellipsoid.
std::optional<std::array<core::Vec3d, 3>> axes_of(const Anisotropy& displacement);

/// The radius of that surface for a mean displacement in angstrom^2, the same in all directions.
double radius_of_displacement(double isotropic);

} // namespace raylane::scenes
