#pragma once

#include "raylane/api.hpp"
#include "raylane/vector.hpp"

/// Generators of many shapes, for SceneBuilder::add. Positions are computed in double and rounded
/// to the nearest floats.
namespace RAYLANE_API raylane {

/// The "balls" of the Standard Procedural Databases (Haines 1987): a sphere with nine spheres of a
/// third of its radius around it, each of which has nine again, and so on.
struct Sphereflake {
    Vec3 center{};             ///< of the central sphere
    float radius = 1.0F;       ///< of the central sphere, > 0
    int depth = 0;             ///< 0 to 8: one sphere, 10, 91, 820, ..., 48427561
    Vec3 up{0.0F, 0.0F, 1.0F}; ///< direction of the first three of the nine, any length but zero
};

/// A cubic grid of n^3 spheres, followed by the 3 n^2 (n - 1) open cylinders between neighbours.
struct Lattice {
    Vec3Of<double> corner{};    ///< node with the smallest coordinates
    int n = 1;                  ///< nodes per side, 1 to 256
    float spacing = 1.0F;       ///< distance between neighbouring nodes, > 0
    float sphere_radius = 0.1F; ///< > 0
    float strut_radius = 0.05F; ///< radius of the cylinders, > 0
};

/// Returns the lattice with all of its nodes around `center`.
RAYLANE_API Lattice centered_at(Lattice lattice, const Vec3Of<double>& center);

} // namespace raylane
