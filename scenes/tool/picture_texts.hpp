#pragma once

#include "scenes/tool/render_arguments.hpp"

#include <string>
#include <utility>
#include <vector>

/// The texts in a picture's file about its scene and options.
namespace raylane::scenes {

using PictureTexts = std::vector<std::pair<std::string, std::string>>;

bool has_text(const PictureTexts& texts, const std::string& name);

/// Returns the text under a name. Throws BadInput with the picture's name if it is missing.
const std::string& text_in(const std::string& picture, const PictureTexts& texts,
                           const std::string& name);

/// Returns the options that the picture was drawn with, as arguments of render. Throws BadInput.
RenderArguments arguments_of(const std::string& picture, const PictureTexts& texts,
                             const std::string& scene);

/// Returns in one line everything except the scene that the bits of a picture depend on. It
/// includes the settings that a Comment omits because the scene has them. All parts of a picture
/// have the same line.
std::string options_line(core::Settings settings, const simd::RenderOptions& options);

/// Returns the checksum of that line as hexadecimal digits, which a picture stores as Options.
std::string fingerprint_of_options(const core::Settings& settings,
                                   const simd::RenderOptions& options);

} // namespace raylane::scenes
