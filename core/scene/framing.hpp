#pragma once

#include "core/scene/surroundings.hpp"
#include "core/shapes/bounds.hpp"

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

/// Balls by their outlines in a picture: what a camera has to see.
class Frame {
  public:
    /// `aspect`: a picture's width by its height.
    Frame(const Framing& framing, double aspect);

    void include(const Vec3d& center, double radius);
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

    Framing framing_;
    Vec3d right_, up_, back_;
    double sine_[2] = {}, cosine_[2] = {}; // of half the angles of view, across and upward
    double aspect_;
    Reach reach_[2], along_, extent_[2];
    bool empty_ = true;
};

} // namespace raylane::core
