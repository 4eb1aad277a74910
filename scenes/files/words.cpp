#include "scenes/files/words.hpp"

#include "scenes/files/number.hpp"

#include <optional>

namespace raylane::scenes {

void refuse(const std::string& option, const std::string& must, const std::string& got) {
    throw BadInput(option, "", "must be " + must + ", got \"" + printable(got) + "\"");
}

float number_between(const std::string& option, const std::string& text, float least, float most) {
    const std::optional<float> number = to_float(text);
    if (!number || !(*number >= least && *number <= most))
        refuse(option, "a number from " + to_text(least) + " to " + to_text(most), text);
    return *number;
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

} // namespace raylane::scenes
