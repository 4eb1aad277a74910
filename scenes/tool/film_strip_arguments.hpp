#pragma once

#include "scenes/tool/film_strip.hpp"
#include "scenes/tool/scene_arguments.hpp"

#include <optional>
#include <string>

namespace raylane::scenes {

/// The pictures of a scene that a command line asks for, if they may be several; it is for others
/// to say how they are drawn. Scenes are made with `threads` threads. Throws BadInput.
std::optional<FilmStrip> film_strip_of(const FrameArguments& frames,
                                       const SceneArguments& scene_arguments,
                                       const std::string& scene, const Argument& output,
                                       int threads, Verbosity verbosity);

} // namespace raylane::scenes
