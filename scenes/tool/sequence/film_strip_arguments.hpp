#pragma once

#include "scenes/tool/options/render_options.hpp"
#include "scenes/tool/sequence/film_strip.hpp"

#include <functional>
#include <optional>
#include <string>

namespace raylane::scenes {

/// Returns a function from the number of a picture to the name of its file, according to --output.
/// `is_one`: there is a single picture, whose name needs no number. Both functions throw BadInput
/// for the name of the scene's file.
std::function<std::string(std::size_t)>
picture_names(const std::string& scene, const std::optional<std::string>& output, bool is_one);

/// Returns the pictures that the command line requests, if there may be several. The caller sets
/// how they are drawn. Scenes are made with `threads` threads. Throws BadInput.
std::optional<FilmStrip> film_strip_of(const RenderArguments& arguments, int threads,
                                       Verbosity verbosity);

} // namespace raylane::scenes
