#pragma once

#include "core/reference/parts_near.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/side.hpp"

#include <cstdint>
#include <vector>

namespace raylane::core {

/// A solid that a point is in, or on the surface of. One that is made of others goes by the id of
/// its first part.
struct Containing {
    ShapeId shape;
    bool on_surface;
};

/// The solids of a scene that have no bounds.
std::vector<Solids::Index> unbounded_solids(const Scene& scene);

/// Which side of a solid a ray is on in the end, behind all that it crosses, as real arithmetic
/// says. It is on the surface where it runs in that of parts, and neither inside nor outside
/// whatever these parts are.
Side side_at_end(const Scene& scene, Solids::Index solid, const Ray<double>& ray);

/// Finds the solids that points are in; to be used by one thread. Of solids that are the same, of
/// one material, the first alone is found.
class PointSearcher {
  public:
    explicit PointSearcher(const Scene& scene);

    /// Appends those that contain a point, by their ids: as real arithmetic says. A point that is
    /// not finite is in none.
    void add_containing(const Vec3d& point, std::vector<Containing>& found);

    /// Which side of a node of the scene's solids a point is on. It is on the surface where it is
    /// on that of parts, and neither inside nor outside whatever these parts are.
    Side side_of(Solids::Index index, const Vec3d& point);

    /// The solids that have no bounds.
    std::span<const Solids::Index> unbounded() const { return unbounded_; }

  private:
    const Scene& scene_;
    PartsNear parts_;
    std::vector<Solids::Index> unbounded_;
    std::vector<Solids::Index> solids_; // that may contain a point
};

} // namespace raylane::core
