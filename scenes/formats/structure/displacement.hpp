#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <optional>

namespace raylane::scenes {

/// Returns the principal axes, in angstrom, of the surface that holds half of a displacement's
/// probability, at 1.5382 standard deviations. Returns nothing if the tensor is not an ellipsoid's.
std::optional<std::array<core::Vec3d, 3>> axes_of(const Anisotropy& displacement);

/// Returns that surface's radius for an isotropic (mean square) displacement in angstrom^2.
double radius_of_displacement(double isotropic);

} // namespace raylane::scenes
