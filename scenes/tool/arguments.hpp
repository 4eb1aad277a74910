#pragma once

#include "scenes/errors.hpp"
#include "scenes/number.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Parsing of values on the command line. All functions throw BadInput, in the form
/// "--spp: must be ..., got ...".
namespace raylane::scenes {

/// Returns the name of a file, which must not be empty.
const std::string& file_argument(const std::string& option, const std::string& text);

/// Throws BadInput if `file`, which is to be written, is the file of another argument, under any
/// name.
void require_other_file(const std::string& option, const std::string& file,
                        const std::string& other_option, const std::string& other_file);
/// Does the same for the argument SCENE. If that file is not a scene, the error says so instead.
void require_other_than_scene(const std::string& option, const std::string& file,
                              const std::string& scene);
/// Does the same for two output files. Only one of them may be standard output.
void require_other_output(const std::string& option, const std::string& file,
                          const std::string& other_option, const std::string& other_file);

/// Returns the parts of a text such as "1:2:3". There is at least one part; parts may be empty.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

int whole_argument(const std::string& option, const std::string& text, int least, int most);

/// Returns the value of --threads, or default_threads() if it is not given. That default may depend
/// on the environment.
int threads_argument(const std::optional<std::string>& text);

float number_argument(const std::string& option, const std::string& text, float least, float most);

/// Parses the size of a picture, WIDTHxHEIGHT.
std::pair<int, int> size_argument(const std::string& option, const std::string& text);

/// Returns the integer root of a square number.
int square_argument(const std::string& option, const std::string& text, int most_root);

/// Returns the value of the choice named `text`.
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
