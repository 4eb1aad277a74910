#include "scenes/tool/picture_part.hpp"

#include "scenes/number.hpp"

#include <string_view>

namespace raylane::scenes {

std::string PicturePart::text() const {
    return std::to_string(number) + "/" + std::to_string(count);
}

std::optional<PicturePart> picture_part_of(const std::string& text) {
    constexpr int most = 1'000'000;
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) return std::nullopt;
    const std::string_view whole = text;
    const std::optional<int> number = to_int(whole.substr(0, slash));
    const std::optional<int> count = to_int(whole.substr(slash + 1));
    if (!number || !count || *number < 1 || *number > *count || *count > most) return std::nullopt;
    return PicturePart{static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
}

} // namespace raylane::scenes
