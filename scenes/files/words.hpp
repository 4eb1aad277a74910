#pragma once

#include "scenes/files/errors.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Parts of the values of options.
namespace raylane::scenes {

/// Throws BadInput: `--spp: must be 1, got "x"`.
[[noreturn]] void refuse(const std::string& option, const std::string& must,
                         const std::string& got);

/// Returns a number from `least` to `most`. Throws BadInput.
float number_between(const std::string& option, const std::string& text, float least, float most);

/// Returns the parts of a text such as "1:2:3". There is at least one part; parts may be empty.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

/// Returns "on" or "off" for other words of the same meaning, and other texts unchanged.
inline std::string_view same_answer(std::string_view text) {
    for (const std::string_view word : {"yes", "true", "1"})
        if (text == word) return "on";
    for (const std::string_view word : {"no", "false", "0", "none", "never"})
        if (text == word) return "off";
    return text;
}

/// Returns the value of the choice named `text`. Throws BadInput.
template <class T>
T choice_named(const std::string& option, const std::string& text,
               const std::vector<std::pair<std::string_view, T>>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
        if (text == name) return value;
        names.emplace_back(name);
    }
    throw BadInput(option, "",
                   "must be " + alternatives(names) + ", got \"" + printable(text) + "\"" +
                       suggestion(same_answer(text), {names.begin(), names.end()}));
}

} // namespace raylane::scenes
