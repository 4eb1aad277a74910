#pragma once

#include "raylane/api.h"
#include "raylane/material.hpp"
#include "raylane/shapes.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace raylane::core {
struct Solid;
}
namespace raylane::library {
struct Internals;
}

namespace RAYLANE_API raylane {

/// A solid that is made of others: of solid shapes (spheres, ellipsoids, boxes, capped cylinders
/// and cones) and of half-spaces (what is behind a Plane, and where a Quadric's form is less than
/// 0, wherever that is: its `lower` and `upper` do not count), by any of the functions below,
/// nested to any depth. Cheap to copy.
///
/// A ray meets a solid where being inside of it changes, and what it meets is the part whose
/// surface that is. If it meets several parts at one point, they change together: where a hole is
/// flush with a face there is no face, and of parts that change as the solid does the first stands
/// for all. What a ray only touches it does not meet. A part that is taken away is met from its
/// inside, by the solid's side: to enter the solid is to leave the part.
class Solid {
  public:
    /// Of the material of what it becomes a part of.
    template <AnyShape Shape>
    Solid(const Shape& shape); // NOLINT: implicit
    template <AnyShape Shape>
    Solid(const Shape& shape, MaterialIndex material);

    /// The same, with another material: of its parts that have none of their own.
    Solid of(MaterialIndex material) const;

  private:
    friend struct library::Internals;
    explicit Solid(std::shared_ptr<const core::Solid> solid) : solid_(std::move(solid)) {}

    std::shared_ptr<const core::Solid> solid_;
};

/// A lens about an axis: between two surfaces of revolution, each a sphere, a plane or a conic, and
/// in a cylinder.
struct Lens {
    Vec3Of<double> vertex;        ///< of the first surface
    Vec3Of<double> axis{0, 0, 1}; ///< from there to the second; of any length but 0
    /// Radii of curvature at the vertices: positive where the centre is behind the surface, going
    /// along the axis; 0: flat.
    double radii[2] = {0.0, 0.0};
    double conics[2] = {0.0, 0.0}; ///< conic constants; 0: spheres
    double thickness = 0.0;        ///< between the vertices, > 0
    double radius = 0.0;           ///< of the cylinder, > 0
};

/// Throws InvalidValue for what is no lens: surfaces that meet inside of its cylinder, or do not
/// reach it.
RAYLANE_API Solid solid_of(const Lens& lens);

/// What is in any of several parts.
RAYLANE_API Solid union_of(const std::vector<Solid>& parts);
/// What is in all of them.
RAYLANE_API Solid intersection_of(const std::vector<Solid>& parts);
/// What is in a solid, and in none of others.
RAYLANE_API Solid difference_of(const Solid& whole, const std::vector<Solid>& taken_away);
/// What of a solid's surface is in all of others: it is left open where it is cut.
RAYLANE_API Solid clipped(const Solid& whole, const std::vector<Solid>& by);

} // namespace raylane
