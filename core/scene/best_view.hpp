#pragma once

#include "core/scene/fit_camera.hpp"

#include <functional>
#include <string_view>

namespace raylane::core {

class Scene;

inline constexpr std::string_view best_view_name = "best";

/// Returns the view in which the centres of the bounded shapes extend farthest across the image,
/// then upward, and least in depth: along their principal axes. The largest component of the
/// directions to the right and upward is positive. Without such shapes, it is the view from the
/// front.
///
/// A floor is a plane or disc that has all of these centres on one side. The view looks down by 20
/// degrees on the floor that is most horizontal for the scene's camera. Its upward direction is
/// that of the floor, and the centres extend farthest across the image. Two views meet this; the
/// camera of the better one is farther from other floors, such as walls.
NamedView best_view(const Scene& scene);

/// Calls its argument for each of some points.
using VisitPoints = std::function<void(const std::function<void(const Vec3d&)>& visit)>;
/// Returns the same view of points. `for_each_point` is called twice.
NamedView best_view(const VisitPoints& for_each_point);

} // namespace raylane::core
