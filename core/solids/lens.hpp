#pragma once

#include "core/solids/solid.hpp"

#include <array>

namespace raylane::core {

/// A lens about an axis: between two surfaces of revolution, each a sphere, a plane or a conic, and
/// in a cylinder.
struct Lens {
    Vec3d vertex{0.0};         ///< of the first surface
    Vec3d axis{0.0, 0.0, 1.0}; ///< from there to the second; of any length but 0
    /// Radii of curvature at the vertices: positive where the centre is behind the surface, going
    /// along the axis; 0: flat.
    std::array<double, 2> radii{};
    std::array<double, 2> conics{}; ///< conic constants; 0: spheres
    double thickness = 0.0;         ///< between the vertices, > 0
    double radius = 0.0;            ///< of the cylinder, > 0
};

/// The lens as a solid. Along the axis z its numbers are the shapes' own: spheres, planes, a
/// cylinder, and for conics quadrics; about others they are turned, and rounded once. Throws
/// InvalidValue for what is no lens: surfaces that meet inside of its cylinder, or do not reach it.
Solid solid_of(const Lens& lens);

} // namespace raylane::core
