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
NamedView best_view(const Scene& scene);

/// Calls its argument for each of some points.
using VisitPoints = std::function<void(const std::function<void(const Vec3d&)>& visit)>;
/// Returns the same view of points. `for_each_point` is called twice.
NamedView best_view(const VisitPoints& for_each_point);

} // namespace raylane::core
