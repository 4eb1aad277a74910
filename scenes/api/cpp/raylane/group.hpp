#pragma once

#include "raylane/api.hpp"
#include "raylane/material.hpp"
#include "raylane/shapes.hpp"
#include "raylane/solid.hpp"
#include "raylane/transform.hpp"

#include <cstddef>
#include <vector>

namespace raylane::library {
struct Internals;
}

namespace RAYLANE_API raylane {

/// Objects with a common transform or material: shapes, solids, and the members of other groups.
/// Unlike the parts of a solid, they stay separate objects. A builder takes a group any number of
/// times, transformed or not: these are the instances of a file. Cheap to copy for few members.
class Group {
  public:
    /// Adds a shape. Without a material, it takes that of the group, of a group around it or of the
    /// builder. Throws InvalidValue, with a field as SceneBuilder::add does.
    template <AnyShape Shape>
    void add(const Shape& shape, MaterialIndex material = no_material);
    /// Adds a solid, which takes `material` unless it has its own.
    void add(const Solid& solid, MaterialIndex material = no_material);
    /// Adds the members of a group. Members without a material take `material`.
    void add(const Group& group, MaterialIndex material = no_material);

    /// Returns the number of members.
    std::size_t size() const { return members_.size(); }

    /// Returns the group with each number of its shapes transformed and rounded once, to the
    /// nearest double. If `transform` does not scale all lengths equally, spheres become
    /// ellipsoids, and cylinders and cones become solids of a quadric and planes, which have more
    /// ids. A quadric becomes a solid that its transformed box clips. Throws InvalidValue, field
    /// "scale", for a disc that is not scaled equally.
    Group transformed(const Transform& transform) const;
    /// Returns the group with the material for members without one.
    Group of(MaterialIndex material) const;

  private:
    friend struct library::Internals;

    std::vector<Solid> members_;
};

/// The place of a copy of a group: scaled, then rotated about the axes x, y and z, then translated,
/// as by Transform().scaled(scale).rotated(rotate).translated(translate). All numbers are from
/// -1e30 to 1e30.
struct Placement {
    Vec3Of<double> translate{0.0, 0.0, 0.0};
    Vec3Of<double> rotate{0.0, 0.0, 0.0}; ///< degrees
    double scale = 1.0;                   ///< positive
};

/// Returns the union of a group's members, which are solids and half-spaces, for use as a part of
/// another solid. The box of a quadric closes the quadric. Throws InvalidValue if the group is
/// empty.
RAYLANE_API Solid solid_of(const Group& group);

} // namespace raylane
