#pragma once

#include "core/scene/staging.hpp"

namespace raylane::scenes {

/// A view that hands move: around what the camera looks at, along the picture, nearer. Lights and
/// fog that came with the camera go along.
class Orbit {
  public:
    explicit Orbit(core::View start);

    core::View view() const;
    /// The camera goes around, in degrees; never over the poles.
    void turn(double to_the_right, double upwards);
    /// In heights of the picture, where it looks to: what is seen there goes to the left and down.
    void pan(double to_the_right, double upwards);
    /// What it looks at is seen `times` as large.
    void zoom(double times);

  private:
    core::View start_;                  ///< before it is turned
    core::Vec3f axis_;                  ///< what is up for the world
    double elevation_ = 0.0;            ///< of the camera at the start, in degrees
    double turn_ = 0.0, upwards_ = 0.0; ///< since then, in degrees
};

} // namespace raylane::scenes
