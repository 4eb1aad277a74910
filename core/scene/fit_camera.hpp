#pragma once

#include "core/scene/surroundings.hpp"
#include "core/shapes/bounds.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace raylane::core {

/// How a camera looks at contents from which it computes its position and scale.
struct FitCamera {
    Projection projection = Projection::perspective;
    /// From the camera to the contents, any length but zero.
    Vec3f direction{0.0F, 0.0F, -1.0F};
    Vec3f up{0.0F, 1.0F, 0.0F};  ///< not along the direction
    float field_of_view = 30.0F; ///< same as in Camera
    float zoom = 1.0F;           ///< > 0; 1 shows all, with a margin of a twentieth of the image
};

/// The viewing and up directions of a camera, by a name such as "front".
struct NamedView {
    std::string_view name;
    Vec3f direction, up;
};
std::span<const NamedView> named_views();

/// Returns the usual up direction for a camera that looks in this direction.
Vec3f upright(const Vec3f& direction);

/// Returns the fit of a camera that has a position.
FitCamera fit_camera_of(const Camera& camera);

/// Collects the extent of the contents that a camera must see, and computes that camera.
class Frame {
  public:
    /// `aspect`: the image's width divided by its height.
    Frame(const FitCamera& fit_camera, double aspect);

    /// Makes the contents that are included from now on visible from all around. They turn about
    /// the line through `center` in the fit_camera's up direction.
    void turn_about(const Vec3d& center) { center_ = center; }

    void include(const Vec3d& center, double radius);
    /// Includes a disc; its axis may have any length.
    void include_disc(const Vec3d& center, const Vec3d& axis, double radius);
    /// Includes the corners of a box; ignores empty and infinite boxes.
    void include(const Bounds& bounds);
    bool empty() const { return empty_; }

    /// Returns the frame without contents.
    Frame cleared() const;
    /// Includes contents of which each of two frames, which are not empty, contains all.
    void include_common(const Frame& a, const Frame& b);

    /// Returns the camera that sees all contents as large as possible. Without contents, it looks
    /// at the origin.
    Camera camera() const;
    /// Returns the distances of the nearest and the farthest contents along the camera's line of
    /// sight.
    std::pair<double, double> depths(const Camera& camera) const;

    /// Returns the larger extent of the contents, across or upward; 0 without contents.
    double width() const;

    Vec3d right() const { return right_; }
    Vec3d up() const { return up_; }
    Vec3d back() const { return back_; } ///< towards the camera

  private:
    struct Reach { ///< the largest of w.right cos + w.back sin + r, and so on
        double positive = -std::numeric_limits<double>::infinity();
        double negative = -std::numeric_limits<double>::infinity();
    };

    /// Includes all balls of radius `radius` whose centres lie on a circle of radius `ring` around
    /// `center`, in the plane perpendicular to the unit vector `axis`.
    void include_ring(const Vec3d& center, const Vec3d& axis, double ring, double radius);

    FitCamera fit_camera_;
    Vec3d right_, up_, back_;
    Vec3d axis_;                           // the fit's up, of length 1
    std::optional<Vec3d> center_;          // the contents turn about it
    double sine_[2] = {}, cosine_[2] = {}; // of half the angles of view, across and upward
    double aspect_;
    Reach reach_[2], along_, extent_[2];
    bool empty_ = true;
};

} // namespace raylane::core
