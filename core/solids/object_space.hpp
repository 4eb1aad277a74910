#pragma once

#include "core/solids/placement.hpp"
#include "core/solids/solid.hpp"

#include <array>
#include <memory>

namespace raylane::core {

/// The coordinates in which an object was described, before transforms moved it. Each number has
/// an error of some ulps of the largest one beside it; patterns need no more.
struct ObjectSpace {
    Vec3d origin{0.0};                     ///< in the scene
    std::array<Vec3d, 3> axes = unit_axes; ///< in the scene, x, y and z
    std::array<Vec3d, 3> rows = unit_axes; ///< of the inverse of the matrix with these columns

    static constexpr std::array<Vec3d, 3> unit_axes = {
        {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

    /// Return a point, a vector and the direction of a normal of the scene in object space.
    Vec3d point(const Vec3d& p) const { return vector(p - origin); }
    Vec3d vector(const Vec3d& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
    Vec3d normal(const Vec3d& n) const {
        return {dot(axes[0], n), dot(axes[1], n), dot(axes[2], n)};
    }
    bool is_mirrored() const { return dot(axes[0], cross(axes[1], axes[2])) < 0.0; }
};

/// Returns the space of an object that a map with these columns and this translation moves.
ObjectSpace space_moved_by(const std::array<Vec3d, 3>& axes, const Vec3d& origin);
ObjectSpace space_moved_by(const Placement& placement);

/// Returns the space of an object in `space` that `outer` then moves.
ObjectSpace moved(const ObjectSpace& space, const ObjectSpace& outer);

/// Moves the spaces of solids that a transform has moved. Solids with one space keep one.
class SpaceMover {
  public:
    explicit SpaceMover(const Transform& by);
    explicit SpaceMover(const Placement& by) : by_(space_moved_by(by)) {}

    void operator()(Solid& solid);
    std::shared_ptr<const ObjectSpace> operator()(const std::shared_ptr<const ObjectSpace>& space);

  private:
    ObjectSpace by_;
    std::shared_ptr<const ObjectSpace> before_, after_; // those of the last shape
};

} // namespace raylane::core
