#pragma once

#include "scenes/tool/film_strip.hpp"
#include "scenes/tool/scene_arguments.hpp"

#include <functional>
#include <optional>
#include <string>

namespace raylane::scenes {

/// The names of pictures' files, by the pictures' numbers, as --output says them. `is_one`: a
/// single picture, whose name needs no number. Throws BadInput, and so does what it returns, for
/// the scene's own name.
std::function<std::string(std::size_t)> picture_names(const std::string& scene,
                                                      const Argument& output, bool is_one);

/// The pictures of a scene that a command line asks for, if they may be several; it is for others
/// to say how they are drawn. Scenes are made with `threads` threads. Throws BadInput.
std::optional<FilmStrip> film_strip_of(const FrameArguments& frames,
                                       const SceneArguments& scene_arguments,
                                       const std::string& scene, const Argument& output,
                                       int threads, Verbosity verbosity);

} // namespace raylane::scenes
