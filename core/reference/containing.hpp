#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/side.hpp"

#include <cstdint>
#include <vector>

namespace raylane::core {

/// A solid that a point is in, or on the surface of.
struct Containing {
    ShapeId shape;
    bool on_surface;
};

/// Finds the solids that points are in; to be used by one thread. Of solids that are the same, of
/// one material, the first alone is found.
class PointSearcher {
  public:
    explicit PointSearcher(const Scene& scene) : scene_(scene) {}

    /// Appends those that contain a point, by their ids: as real arithmetic says. A point that is
    /// not finite is in none.
    void add_containing(const Vec3d& point, std::vector<Containing>& found);

  private:
    void add_of_block(const Child& block, const Vec3d& point, std::vector<Containing>& found);

    const Scene& scene_;
    std::vector<std::uint32_t> pending_; // nodes
};

} // namespace raylane::core
