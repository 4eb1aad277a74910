#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <optional>

namespace raylane::scenes {

/// Returns the radius of a sphere, in standard deviations, that holds a share of a normal
/// distribution in space: 1.5382 for a half. `probability`: in [0.001, 0.999].
double deviations_of(double probability);

/// Returns the principal axes, in angstrom, of a displacement's surface at a number of standard
/// deviations. They are perpendicular to each other. Returns nothing if the tensor is not
/// positive definite.
std::optional<std::array<core::Vec3d, 3>> axes_of(const Anisotropy& displacement,
                                                  double deviations);

} // namespace raylane::scenes
