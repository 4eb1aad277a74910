#pragma once

#include "core/scene/surroundings.hpp"
#include "core/shapes/bounds.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace raylane::core {

/// How a camera is to look at something whose place and size it finds by itself.
struct Framing {
    Projection projection = Projection::perspective;
    /// From the camera to what it sees, any length but zero.
    Vec3f direction{0.0F, 0.0F, -1.0F};
    Vec3f up{0.0F, 1.0F, 0.0F};  ///< not along the direction
    float field_of_view = 30.0F; ///< as Camera has it
    float zoom = 1.0F;           ///< > 0: 1 shows all, with a margin of a twentieth of the picture
};

/// Where a camera looks to, and what is up for it, by a name such as "front".
struct NamedView {
    std::string_view name;
    Vec3f direction, up;
};
std::span<const NamedView> named_views();

/// What is up in most pictures, for a camera that looks in this direction.
Vec3f upright(const Vec3f& direction);

/// How a camera looks that has its place.
Framing framing_of(const Camera& camera);

/// Balls by their outlines in a picture: what a camera has to see.
class Frame {
  public:
    /// `aspect`: a picture's width by its height.
    Frame(const Framing& framing, double aspect);

    /// From now on all of it is seen from all around: it turns about the line through `center` that
    /// goes as the framing's up.
    void turn_about(const Vec3d& center) { center_ = center; }

    void include(const Vec3d& center, double radius);
    /// A disc; its axis has any length.
    void include_disc(const Vec3d& center, const Vec3d& axis, double radius);
    /// The corners of a box; what is empty or infinite is left out.
    void include(const Bounds& bounds);
    bool empty() const { return empty_; }

    /// The camera that sees all of it, as large as that may be; of nothing, one that looks at the
    /// origin.
    Camera camera() const;
    /// Distances, along the camera's line of sight, of the first that it sees and of the last.
    std::pair<double, double> depths(const Camera& camera) const;

    /// Of all of it, across or upward: the larger of both; 0 of nothing.
    double width() const;

    Vec3d right() const { return right_; }
    Vec3d up() const { return up_; }
    Vec3d back() const { return back_; } ///< towards the camera

  private:
    struct Reach { ///< the largest of w.right cos + w.back sin + r, and so on
        double positive = -std::numeric_limits<double>::infinity();
        double negative = -std::numeric_limits<double>::infinity();
    };

    /// Balls in a circle about an axis of length 1.
    void include_ring(const Vec3d& center, const Vec3d& axis, double ring, double radius);

    Framing framing_;
    Vec3d right_, up_, back_;
    Vec3d axis_;                           // the framing's up, of length 1
    std::optional<Vec3d> center_;          // that all of it turns about
    double sine_[2] = {}, cosine_[2] = {}; // of half the angles of view, across and upward
    double aspect_;
    Reach reach_[2], along_, extent_[2];
    bool empty_ = true;
};

} // namespace raylane::core
