#pragma once

#include "core/scene/auto_camera.hpp"

namespace raylane::scenes {

/// A view that the user moves by hand: around the point that the camera looks at, parallel to the
/// image, nearer. Lights and fog that came with the camera move along.
class Orbit {
  public:
    explicit Orbit(core::View start);

    core::View view() const;
    /// Turns the camera around that point, in degrees. It never passes over the poles.
    void turn(double to_the_right, double upwards);
    /// Moves the camera and its target, in heights of the image. The image moves the opposite
    /// way, so to the left and down for positive values.
    void pan(double to_the_right, double upwards);
    /// Makes the point that the camera looks at appear `times` as large.
    void zoom(double times);

  private:
    core::View start_;                  ///< before turning
    core::Vec3f axis_;                  ///< the world's upward direction
    double elevation_ = 0.0;            ///< of the camera at the start, in degrees
    double turn_ = 0.0, upwards_ = 0.0; ///< since the start, in degrees
};

} // namespace raylane::scenes
