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

} // namespace raylane::scenes
