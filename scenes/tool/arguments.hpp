#pragma once

#include "scenes/errors.hpp"
#include "scenes/number.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Values on the command line. All functions throw BadInput, in the manner of
/// "--spp: must be ..., got ...".
namespace raylane::scenes {

/// The name of a file.
const std::string& file_argument(const std::string& option, const std::string& text);

/// Refuses a file to be written that is another argument's as well, by whatever name.
void require_other_file(const std::string& option, const std::string& file,
                        const std::string& other_option, const std::string& other_file);
/// The same of the argument SCENE. A file that is no scene is refused as such.
void require_other_than_scene(const std::string& option, const std::string& file,
                              const std::string& scene);
/// The same of two files to be written: standard output, too, takes one of them.
void require_other_output(const std::string& option, const std::string& file,
                          const std::string& other_option, const std::string& other_file);

/// What is between the separators of "1:2:3": at least one part, and each may be empty.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

int whole_argument(const std::string& option, const std::string& text, int least, int most);

/// The number of threads that --threads says, if it does; else default_threads(), which the
/// environment may say.
int threads_argument(const std::optional<std::string>& text);

float number_argument(const std::string& option, const std::string& text, float least, float most);

/// WIDTHxHEIGHT of a picture.
std::pair<int, int> size_argument(const std::string& option, const std::string& text);

/// The whole root of a square number.
int square_argument(const std::string& option, const std::string& text, int most_root);

/// The value of the choice that `text` names.
template <class Value>
Value choice_argument(const std::string& option, const std::string& text,
                      const std::vector<std::pair<std::string_view, Value>>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
        if (text == name) return value;
        names.emplace_back(name);
    }
    throw BadInput(option, "",
                   "must be " + alternatives(names) + ", got \"" + printable(text) + "\"" +
                       suggestion(text, {names.begin(), names.end()}));
}

} // namespace raylane::scenes
