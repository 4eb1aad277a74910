#pragma once

#include "scenes/tool/render_arguments.hpp"

#include <string>
#include <utility>
#include <vector>

/// What a picture says of itself.
namespace raylane::scenes {

using PictureTexts = std::vector<std::pair<std::string, std::string>>;

bool has_text(const PictureTexts& texts, const std::string& name);

/// What stands under a name. Throws BadInput, in the picture's name, if there is nothing.
const std::string& text_in(const std::string& picture, const PictureTexts& texts,
                           const std::string& name);

/// The options that it was drawn with, as render understands them. Throws BadInput.
RenderArguments arguments_of(const std::string& picture, const PictureTexts& texts,
                             const std::string& scene);

/// All that the bits of a picture depend on but its scene, in a line: also what a Comment leaves
/// out as it is the scene's own. Parts of one picture have the same.
std::string options_line(core::Settings settings, const simd::RenderOptions& options);

/// Its digits, for the picture to say (Options).
std::string fingerprint_of_options(const core::Settings& settings,
                                   const simd::RenderOptions& options);

} // namespace raylane::scenes
