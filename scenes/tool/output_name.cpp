#include "scenes/tool/output_name.hpp"

#include "scenes/errors.hpp"
#include "scenes/number.hpp"

#include <algorithm>

namespace raylane::scenes {

std::string default_output(const std::filesystem::path& scene, const std::string& ending) {
    // A name that ends in a slash has no stem. Reading it fails later.
    if (!scene.has_stem() || scene == "-") return "scene" + ending;
    std::filesystem::path name = scene.filename();
    if (name.extension() == ".gz") name = name.stem();
    return name.stem().string() + ending;
}

NumberedName::NumberedName(const std::string& option, const std::string& pattern,
                           bool needs_number) {
    const auto refuse = [&] {
        throw BadInput(
            option, "",
            "must have one placeholder for the image number, such as %05d, and %% for a %, got \"" +
                printable(pattern, 4096) + "\"");
    };
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = has_number_ ? behind_ : before_;
        if (pattern[i] != '%') {
            part += pattern[i];
            continue;
        }
        if (++i < pattern.size() && pattern[i] == '%') {
            part += '%';
            continue;
        }
        const std::size_t end = pattern.find_first_not_of("0123456789", i);
        if (has_number_ || end == std::string::npos || pattern[end] != 'd' || end - i > 2) refuse();
        has_number_ = true;
        if (end > i) {
            fill_ = pattern[i] == '0' ? '0' : ' ';
            width_ = static_cast<std::size_t>(*to_int(pattern.substr(i, end - i)));
        }
        i = end;
    }
    if (needs_number && !has_number_) refuse();
}

std::string NumberedName::operator()(std::size_t number) const {
    if (!has_number_) return before_;
    const std::string digits = std::to_string(number);
    const std::size_t missing = width_ - std::min(width_, digits.size());
    return before_ + std::string(missing, fill_) + digits + behind_;
}

} // namespace raylane::scenes
