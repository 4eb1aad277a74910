#pragma once

#include "core/solids/solid.hpp"

#include <array>

namespace raylane::core {

/// A lens about an axis, inside of a cylinder and between two surfaces of revolution: spheres,
/// planes or conics.
struct Lens {
    Vec3d vertex{0.0};         ///< vertex of the first surface
    Vec3d axis{0.0, 0.0, 1.0}; ///< direction from there to the second vertex, any length but 0
    /// Radii of curvature at the vertices: positive if the centre is behind the surface, going
    /// along the axis; 0: flat.
    std::array<double, 2> radii{};
    std::array<double, 2> conics{}; ///< conic constants; 0: spheres
    double thickness = 0.0;         ///< between the vertices, > 0
    double radius = 0.0;            ///< of the cylinder, > 0
};

/// Returns the lens as a solid. With the axis z, the shapes have its numbers exactly: spheres,
/// planes, a cylinder, and quadrics for conics. With another axis, they are rotated and rounded
/// once. Throws InvalidValue if the surfaces meet inside of the cylinder, or do not reach it.
Solid solid_of(const Lens& lens);

} // namespace raylane::core
