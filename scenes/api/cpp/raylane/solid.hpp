#pragma once

#include "raylane/api.hpp"
#include "raylane/material.hpp"
#include "raylane/shapes.hpp"
#include "raylane/transform.hpp"

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

/// A constructed solid (constructive solid geometry). The functions below build it from solid
/// shapes (spheres, ellipsoids, boxes, capped cylinders and cones) and from half-spaces. A Plane
/// stands for the half-space behind it. A Quadric stands for all points where its form is less than
/// 0; its `lower` and `upper` are ignored. An open cylinder stands for the inside of the infinite
/// cylinder, an open cone for that of both nappes. Solids nest up to 1024 levels deep. Cheap to
/// copy.
///
/// A ray hits a solid where it changes between the inside and the outside of the whole solid. The
/// hit names the part whose surface is crossed. If a ray crosses several parts at one point, they
/// change together: a hole that is flush with a face removes that face, and if several parts change
/// in the same direction as the solid, the hit names the first of them. A ray that only touches a
/// solid does not hit it. A ray that enters the solid through a subtracted part leaves that part;
/// `entering` and the normal refer to the solid.
class Solid {
  public:
    /// Takes the material of the solid or scene object that this becomes a part of.
    template <AnyShape Shape>
    Solid(const Shape& shape); // NOLINT: implicit
    template <AnyShape Shape>
    Solid(const Shape& shape, MaterialIndex material);

    /// Returns this solid with the given material. Parts that have their own material keep it.
    Solid of(MaterialIndex material) const;

    /// Returns the solid with each number of its shapes transformed and rounded once, to the
    /// nearest double. If `transform` does not scale all lengths equally, spheres become
    /// ellipsoids, and cylinders and cones become solids of a quadric and planes, which have more
    /// ids. Throws InvalidValue for an invalid shape, or if a number exceeds doubles.
    Solid transformed(const Transform& transform) const;

  private:
    friend struct library::Internals;
    explicit Solid(std::shared_ptr<const core::Solid> solid) : solid_(std::move(solid)) {}

    std::shared_ptr<const core::Solid> solid_;
};

/// A lens: the solid between two surfaces of revolution about an axis, each a sphere, a plane or a
/// conic surface, inside of a cylinder about the same axis. Lengths are in the scene's unit.
struct Lens {
    Vec3Of<double> vertex;        ///< vertex of the first surface
    Vec3Of<double> axis{0, 0, 1}; ///< from there to the second vertex; any length except zero
    /// Radii of curvature at the vertices: positive if the centre of curvature lies behind the
    /// surface in the direction of the axis; 0: flat.
    double radii[2] = {0.0, 0.0};
    double conics[2] = {0.0, 0.0}; ///< conic constants; 0: sphere, -1: paraboloid
    double thickness = 0.0;        ///< distance between the vertices, > 0
    double radius = 0.0;           ///< radius of the cylinder, > 0
};

/// Returns the lens as a solid. Throws InvalidValue if a field is out of range, or if the surfaces
/// meet inside of the cylinder or do not reach it.
RAYLANE_API Solid solid_of(const Lens& lens);

/// Returns the union: all points inside of at least one part. Throws InvalidValue if the result is
/// nested more than 1024 levels deep; so do the functions below.
RAYLANE_API Solid union_of(const std::vector<Solid>& parts);
/// Returns the intersection: all points inside of every part.
RAYLANE_API Solid intersection_of(const std::vector<Solid>& parts);
/// Returns the difference: all points inside of `whole` and outside of each solid in `taken_away`.
RAYLANE_API Solid difference_of(const Solid& whole, const std::vector<Solid>& taken_away);
/// Returns the part of the surface of `whole` that lies inside of all solids in `by`. The cuts stay
/// open: they get no cap faces.
RAYLANE_API Solid clipped(const Solid& whole, const std::vector<Solid>& by);

/// Returns the union, intersection or difference of two solids. Chains do not nest: a | b | c is
/// one union of three, a - b - c one difference. Each operator copies the description of `a`; for
/// hundreds of parts use the functions above.
RAYLANE_API Solid operator|(const Solid& a, const Solid& b);
RAYLANE_API Solid operator&(const Solid& a, const Solid& b);
RAYLANE_API Solid operator-(const Solid& a, const Solid& b);

} // namespace raylane
