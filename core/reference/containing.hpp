#pragma once

#include "core/reference/parts_near.hpp"
#include "core/shapes/ray.hpp"

#include <vector>

namespace raylane::core {

/// A solid that a point is inside of, or on the surface of. A compound solid has the id of its
/// first part.
struct Containing {
    ShapeId shape;
    bool on_surface;
    bool inside; ///< see Position::inside
};

/// The position of a point relative to a solid. `side` is Side::surface if the point is on the
/// surface of parts on which the result depends. `inside` tells whether the solid has the point as
/// a set, where convex parts are closed and half-spaces are open.
struct Position {
    Side side;
    bool inside;
};

/// Returns the unbounded solids of a scene.
std::vector<Solids::Index> unbounded_solids(const Scene& scene);

/// Returns the side of a solid on which a ray ends, behind all its crossings, as real arithmetic
/// decides. Returns Side::surface if the ray runs in the surface of parts on which the result
/// depends.
Side side_at_end(const Scene& scene, Solids::Index solid, const Ray<double>& ray);

/// Finds the solids that contain points. For use by one thread. Finds only the first of several
/// equal solids of one material.
class PointSearcher {
  public:
    explicit PointSearcher(const Scene& scene);

    /// Appends the solids that contain a point, in the order of their ids, as real arithmetic
    /// decides. No solid contains a point that is not finite.
    void add_containing(const Vec3d& point, std::vector<Containing>& found);

    /// Returns the position of a point relative to a node of the scene's solids. The
    /// set has a point of its parts' surfaces if and only if a line that runs in these surfaces is
    /// inside there: see SolidSurfaces.
    Position position_in(Solids::Index index, const Vec3d& point);
    Side side_of(Solids::Index index, const Vec3d& point) { return position_in(index, point).side; }

    /// Returns the unbounded solids.
    std::span<const Solids::Index> unbounded() const { return unbounded_; }

  private:
    const Scene& scene_;
    PartsNear parts_;
    std::vector<Solids::Index> unbounded_;
    std::vector<Solids::Index> solids_; // candidates for a point
};

} // namespace raylane::core
