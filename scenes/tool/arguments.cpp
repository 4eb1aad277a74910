#include "scenes/tool/arguments.hpp"

#include <cmath>

namespace raylane::scenes {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& must,
                         const std::string& got) {
    throw BadInput(option, "", "must be " + must + ", got \"" + printable(got) + "\"");
}

} // namespace

int whole_argument(const std::string& option, const std::string& text, int least, int most) {
    const std::optional<int> value = to_int(text);
    if (!value || *value < least || *value > most)
        refuse(option,
               "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
               text);
    return *value;
}

float number_argument(const std::string& option, const std::string& text, float least, float most) {
    const std::optional<float> value = to_float(text);
    if (!value || *value < least || *value > most)
        refuse(option, "a number from " + to_text(least) + " to " + to_text(most), text);
    return *value;
}

std::pair<int, int> size_argument(const std::string& option, const std::string& text, int most) {
    const std::size_t x = text.find_first_of("xX");
    std::optional<int> width, height;
    if (x != std::string::npos) {
        width = to_int(std::string_view(text).substr(0, x));
        height = to_int(std::string_view(text).substr(x + 1));
    }
    if (!width || !height || *width < 1 || *height < 1 || *width > most || *height > most)
        refuse(option,
               "WIDTHxHEIGHT in pixels, each from 1 to " + std::to_string(most) +
                   ", such as 640x480",
               text);
    return {*width, *height};
}

int square_argument(const std::string& option, const std::string& text, int most_root) {
    const std::optional<int> value = to_int(text);
    const int root = value && *value > 0
                         ? static_cast<int>(std::lround(std::sqrt(static_cast<double>(*value))))
                         : 0;
    if (root < 1 || root > most_root || root * root != *value)
        refuse(option,
               "a square number from 1 to " + std::to_string(most_root * most_root) +
                   ", such as 1, 4, 9 or 16",
               text);
    return root;
}

} // namespace raylane::scenes
