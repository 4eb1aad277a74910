#pragma once

#include "core/shapes/ray.hpp"
#include "tests/support/any_shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace raylane::oracle {

using core::Vec3d;

/// Finds the shapes that a line may cross, so that exact numbers need not test all of them. It
/// leaves out only shapes that the line is certain to miss.
class Neighbours {
  public:
    template <Variant Any>
    explicit Neighbours(const std::vector<Any>& shapes) {
        for (const Any& shape : shapes)
            balls_.push_back(ball_around(shape));
    }

    bool may_cross(std::size_t shape, const core::Ray<double>& ray) const {
        const Ball& ball = balls_[shape];
        const Vec3d from = ray.origin - ball.center;
        const double reach = ball.radius + 0x1p-40 * core::length(from);
        // Scaled, so that no product underflows. Those that overflow are certain of nothing.
        const Vec3d d =
            ray.direction / std::max({std::abs(ray.direction.x), std::abs(ray.direction.y),
                                      std::abs(ray.direction.z)});
        return !(core::length(core::cross(from, d)) > reach * core::length(d) * (1.0 + 0x1p-20));
    }

  private:
    std::vector<Ball> balls_;
};

/// A crossing with one of several shapes.
struct Found {
    Hit hit;
    core::ShapeId shape;
    float t; ///< t as the library returns it
    double t_double;

    Found(const Hit& crossing, core::ShapeId with)
        : hit(crossing), shape(with), t(rounded(hit.root, hit.t)),
          t_double(rounded_to_double(hit.root, hit.t)) {}

    /// Orders by t. At the same t, entering comes before leaving, then the lower shape id.
    bool is_before(const Found& other) const {
        const int order = compare(hit, other.hit);
        if (order != 0) return order < 0;
        if (hit.entering != other.hit.entering) return hit.entering;
        return shape < other.shape;
    }
};

/// All crossings ahead of a ray, in order.
class Sight {
  public:
    /// is_seen(shape, entering) returns whether a crossing counts.
    template <Variant Any, class IsSeen>
    Sight(const std::vector<Any>& shapes, const Neighbours& neighbours,
          const core::Ray<double>& ray, const IsSeen& is_seen)
        : ray_(ray) {
        for (core::ShapeId id = 0; id < shapes.size(); ++id) {
            if (!neighbours.may_cross(id, ray)) continue;
            for (const Hit& hit : crossings(shapes[id], ray))
                if (hit.t > 0 && is_seen(id, hit.entering)) all_.emplace_back(hit, id);
        }
        std::sort(all_.begin(), all_.end(),
                  [](const Found& a, const Found& b) { return a.is_before(b); });
    }

    const std::vector<Found>& all() const { return all_; }
    /// Returns the first crossing whose rounded t is in (t_min, t_max], or null.
    const Found* first(float t_min, float t_max) const {
        for (const Found& found : all_)
            if (t_min < found.t && found.t <= t_max) return &found;
        return nullptr;
    }
    /// Returns the normal of the crossing's shape there, rounded to the nearest floats.
    const core::Vec3f& normal_of(const Found& found, const Variant auto& shape) {
        return known(normals_, found, [&] { return rounded(normal(shape, ray_, found.hit)); });
    }
    /// The same for the nearest doubles.
    const core::Vec3d& double_normal_of(const Found& found, const Variant auto& shape) {
        return known(double_normals_, found,
                     [&] { return rounded_to_double(normal(shape, ray_, found.hit)); });
    }

  private:
    template <class Vector, class Compute>
    const Vector& known(std::vector<std::optional<Vector>>& points, const Found& found,
                        const Compute& compute) const {
        points.resize(all_.size());
        std::optional<Vector>& one = points[static_cast<std::size_t>(&found - all_.data())];
        if (!one) one = compute();
        return *one;
    }

    core::Ray<double> ray_;
    std::vector<Found> all_;
    std::vector<std::optional<core::Vec3f>> normals_;        // filled on demand
    std::vector<std::optional<core::Vec3d>> double_normals_; // likewise
};

} // namespace raylane::oracle
