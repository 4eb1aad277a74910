#pragma once

#include "core/scene/auto_camera.hpp"
#include "core/scene/scene.hpp"
#include "scenes/formats/structure/structure_file.hpp"

#include <string>

/// The actions of the mouse in the window.
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

/// Returns one line about the shape that a camera sees through the middle of a pixel, in an image
/// of the settings' size: its atom in the legend, the shape, the number and name of its material,
/// the point, and the exact distance, rounded.
std::string what_is_at(const core::Scene& scene, const core::Settings& settings, int x, int y,
                       const Legend& legend = {});

/// Returns a camera in the form of JSON scenes: `"camera": {...}`.
std::string camera_text(const core::Camera& camera);

} // namespace raylane::scenes
