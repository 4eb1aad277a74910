#pragma once

#include "scenes/errors.hpp"
#include "scenes/number.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Values on the command line. All functions throw BadInput, in the manner of
/// "--spp: must be ..., got ...".
namespace raylane::scenes {

int whole_argument(const std::string& option, const std::string& text, int least, int most);

float number_argument(const std::string& option, const std::string& text, float least, float most);

/// WIDTHxHEIGHT.
std::pair<int, int> size_argument(const std::string& option, const std::string& text, int most);

/// The whole root of a square number.
int square_argument(const std::string& option, const std::string& text, int most_root);

/// The value of the choice that `text` names.
template <class Value>
Value choice_argument(const std::string& option, const std::string& text,
                      const std::vector<std::pair<std::string_view, Value>>& choices) {
    std::vector<std::string_view> names;
    std::string list;
    for (const auto& [name, value] : choices) {
        if (text == name) return value;
        names.push_back(name);
        list.append(list.empty() ? "" : " or ").append(name);
    }
    throw BadInput(option, "",
                   "must be " + list + ", got \"" + printable(text) + "\"" +
                       suggestion(text, names));
}

} // namespace raylane::scenes
