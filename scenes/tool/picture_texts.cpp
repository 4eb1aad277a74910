#include "scenes/tool/picture_texts.hpp"

#include "scenes/errors.hpp"

#include <algorithm>

namespace raylane::scenes {

bool has_text(const PictureTexts& texts, const std::string& name) {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.first == name; });
}

const std::string& text_in(const std::string& picture, const PictureTexts& texts,
                           const std::string& name) {
    for (const auto& [key, text] : texts)
        if (key == name) return text;
    throw BadInput(picture, "",
                   "must be a PNG or EXR that raylane has drawn, which says by which scene and "
                   "options: it has no " +
                       name);
}

RenderArguments arguments_of(const std::string& picture, const PictureTexts& texts,
                             const std::string& scene) {
    RenderArguments arguments;
    if (!take_options(text_in(picture, texts, "Comment"),
                      [&](CLI::App& command) { arguments.add_to(command); }))
        throw BadInput(picture, "", "has a Comment that is no list of render's options");
    arguments.scene = scene;
    return arguments;
}

} // namespace raylane::scenes
