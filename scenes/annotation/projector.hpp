#pragma once

#include "core/scene/field_of_view.hpp"
#include "core/scene/surroundings.hpp"
#include "scenes/annotation/sheet.hpp"

#include <optional>

namespace raylane::scenes {

/// Projects points to an image, by the same camera model as core::CameraRays.
class Projector {
  public:
    Projector(const core::Camera& camera, int width, int height)
        : width_(width), height_(height), from_(core::convert<double>(camera.from)),
          is_orthographic_(camera.projection == core::Projection::orthographic) {
        const core::Vec3d sight = core::convert<double>(camera.at) - from_;
        distance_ = core::length(sight);
        forward_ = 1.0 / distance_ * sight;
        const core::Vec3d across = core::cross(forward_, core::convert<double>(camera.up));
        right_ = 1.0 / core::length(across) * across;
        up_ = core::cross(right_, forward_);
        const double half = is_orthographic_ ? 0.5 * static_cast<double>(camera.height)
                                             : core::slope_of_view(camera.field_of_view);
        scale_ = 0.5 * height / half;
    }

    /// Returns the position in pixels from the upper left corner; nothing if behind the camera.
    std::optional<Point> point_of(const core::Vec3d& point) const {
        const core::Vec3d to = point - from_;
        const double depth = core::dot(to, forward_);
        if (!(depth > 0.0)) return std::nullopt;
        const double scale = is_orthographic_ ? scale_ : scale_ / depth;
        return Point{0.5 * width_ + scale * core::dot(to, right_),
                     0.5 * height_ - scale * core::dot(to, up_)};
    }
    /// Returns the number of pixels in a unit of length across the view, at the point that the
    /// camera looks at.
    double pixels_per_length() const { return is_orthographic_ ? scale_ : scale_ / distance_; }

    const core::Vec3d& right() const { return right_; }     ///< unit
    const core::Vec3d& up() const { return up_; }           ///< unit
    const core::Vec3d& forward() const { return forward_; } ///< unit

  private:
    int width_, height_;
    core::Vec3d from_, forward_, right_, up_;
    bool is_orthographic_;
    double distance_, scale_;
};

} // namespace raylane::scenes
