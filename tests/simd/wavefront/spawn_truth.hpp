#pragma once

#include "tests/shapes/close_shells_place.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace raylane::tests {

/// The ids of a nest's shapes. Shapes with higher ids are far away.
enum : ShapeId { shape_id, outer_id, inner_id };

/// Next crossing of a ray.
struct Next {
    ShapeId shape = no_shape;
    double t = std::numeric_limits<double>::infinity();
    bool entering = false;
};

/// The true next crossings of rays that leave a nest's shape.
class SpawnTruth {
  public:
    /// `shapes` are the scene's, by id.
    SpawnTruth(const CloseShells& nest, const Place& place, const std::vector<AnyShape>& shapes)
        : nest_(nest), place_(place), shapes_(shapes) {}

    /// Returns the largest distance of the start from the surface.
    double slack(const Ray<double>& ray) const {
        const Vec3d o = ray.origin;
        return 0x1p-48 * (std::abs(o.x) + std::abs(o.y) + std::abs(o.z) +
                          place_.size * static_cast<double>(place_.factor));
    }

    /// Returns the next crossing of a ray from the exact surface, without its t.
    std::optional<Next> by_construction(const Ray<double>& ray, bool inward) const {
        constexpr double t = std::numeric_limits<double>::quiet_NaN();
        if (shapes_.size() > 3) return std::nullopt; // a sphere may be in between, if far away
        if (nest_.parted) {
            const auto normal = convert<double>(std::get<Plane>(shapes_[outer_id]).normal);
            if (std::abs(dot(normalized(normal), ray.direction)) < 1e-9) return std::nullopt;
            return inward ? Next{inner_id, t, true} : Next{outer_id, t, false};
        }
        if (!inward) return nest_.closed ? std::optional(Next{outer_id, t, false}) : std::nullopt;
        const auto* const inner = std::get_if<Sphere>(&shapes_[inner_id]);
        if (inner == nullptr || !is_a<Solid>(nest_.shape)) return std::nullopt;
        const Vec3d from_center = ray.origin - convert<double>(inner->center);
        const double past = length(cross(from_center, ray.direction)),
                     radius = static_cast<double>(inner->radius);
        if (past < radius - slack(ray)) return Next{inner_id, t, true};
        if (past > radius + slack(ray)) return Next{shape_id, t, false};
        return std::nullopt;
    }

    /// Returns nothing if the start and the next crossing with the shape left are too close to tell
    /// apart.
    std::optional<Next> by_oracle(const Ray<double>& ray, bool inward) const {
        Next next;
        for (const ShapeId id : {outer_id, inner_id})
            for (const oracle::Hit& hit : oracle::crossings(shapes_[id], ray))
                if (hit.t > 0 && to_double(hit.t) < next.t)
                    next = {id, to_double(hit.t), hit.entering};
        if (is_a<Flat>(nest_.shape) || (!inward && !may_come_back(nest_.shape))) return next;

        double start = std::numeric_limits<double>::infinity(), onward = start;
        for (const oracle::Hit& hit : oracle::crossings(shapes_[shape_id], ray)) {
            const double t = to_double(hit.t);
            if (hit.entering != inward)
                onward = t;
            else if (std::abs(t) < std::abs(start))
                start = t;
        }
        if (std::isinf(onward)) {
            // The start is off the surface so that the ray misses all of it, or it is out of
            // bounds.
            if (is_a<Solid>(nest_.shape) || std::isinf(start)) return std::nullopt;
            return next;
        }
        if (!(std::abs(start) <= 0x1p10 * slack(ray)) || onward <= start) return std::nullopt;
        const double error = 2.0 * std::abs(start) + 0x1p-24 * std::abs(onward);
        if (std::abs(onward - next.t) <= error || std::abs(onward) <= 2 * error)
            return std::nullopt;
        if (onward > 0.0 && onward < next.t)
            return Next{shape_id, std::numeric_limits<double>::quiet_NaN(), !inward};
        return next;
    }

  private:
    static double to_double(const oracle::Number& number) { return static_cast<double>(number); }

    const CloseShells& nest_;
    const Place& place_;
    const std::vector<AnyShape>& shapes_;
};

} // namespace raylane::tests
