#include "scenes/files/words.hpp"

namespace raylane::scenes {

void refuse(const std::string& option, const std::string& must, const std::string& got) {
    throw BadInput(option, "", "must be " + must + ", got \"" + printable(got) + "\"");
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
