#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/ray.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::core {

/// The point of a scene's shapes that is closest to another point.
struct Closest {
    /// The double nearest to the true distance, but 0 only if that is 0, and finite. Infinity if
    /// no shape is within the limit.
    double distance = std::numeric_limits<double>::infinity();
    /// Each component is the double nearest to the true one; NaN without a shape.
    Vec3d point{std::numeric_limits<double>::quiet_NaN()};
    ShapeId shape = no_shape; ///< the lowest of those at the same distance
    Face face = body;         ///< the lowest of the faces that the point is on
};

/// Throws InvalidValue, field "scene", if the closest points of a scene's shapes cannot be found:
/// it has constructed solids, or keeps copies of groups.
void require_closest_points(const Scene& scene);

/// Bounds on the distance of a point from a shape.
struct DistanceBounds {
    double lower, upper;
};

struct LaneBounds;

/// Finds closest points, as real arithmetic decides. For use by one thread.
class ClosestSearcher {
  public:
    explicit ClosestSearcher(const Scene& scene) : scene_(scene) {}

    /// Returns the closest point of the shapes whose distance, as it is answered, is at most
    /// `max_distance`. The point must be finite.
    Closest find(const Vec3d& point, double max_distance);

  private:
    /// A shape that may be the closest.
    struct Candidate {
        Kind kind;
        Place place;
        ShapeId shape;
        DistanceBounds bounds;
    };
    struct Pending {
        double squared; ///< distance
        Child child;
    };

    void look_in(Kind kind, std::uint32_t block, const Vec3d& point);
    void look_at(Kind kind, std::uint32_t block, const Vec3d& point, const LaneBounds& bounds);
    void walk(const Vec3d& point);
    void drop_farther();
    const Candidate& decide(const Vec3d& point);
    Closest answer(const Candidate& candidate, const Vec3d& point) const;

    const Scene& scene_;
    double limit_ = 0.0; // the least upper bound
    std::vector<Candidate> candidates_;
    std::vector<Pending> pending_; // nearest last
};

} // namespace raylane::core
