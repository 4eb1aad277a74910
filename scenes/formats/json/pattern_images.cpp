#include "scenes/formats/json/pattern_images.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/images/texture.hpp"

#include <filesystem>

namespace raylane::scenes {

core::Texture PatternImages::named_by(const JsonValue& value) {
    const std::filesystem::path path =
        std::filesystem::path(value.file()).parent_path() / value.string();
    const auto [known, is_new] = images_.try_emplace(path.lexically_normal().string());
    if (!is_new && known->second.any()) return known->second;
    const auto file = checked(value, [&] { return opener_.open_bytes(path, value.string()); });
    try {
        known->second = read_texture(*file, pixels_left_);
    } catch (const BadInput& bad) {
        value.fail("must be the name of a PNG image, got " + value.quoted() + ", but " +
                   bad.errors().front().file + " " + bad.errors().front().message);
    }
    pixels_left_ -= static_cast<std::size_t>(known->second.width()) *
                    static_cast<std::size_t>(known->second.height());
    return known->second;
}

} // namespace raylane::scenes
