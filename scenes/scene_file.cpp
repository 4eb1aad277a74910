#include "scenes/scene_file.hpp"

#include "scenes/errors.hpp"
#include "scenes/input_file.hpp"
#include "scenes/json/reader.hpp"
#include "scenes/nff/reader.hpp"
#include "scenes/number.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace raylane::scenes {

namespace {

/// JSON begins with '{' or a comment, and no line of NFF does with either.
bool looks_like_json(std::string_view head) {
    static constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (head.starts_with(byte_order_mark)) head.remove_prefix(byte_order_mark.size());
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && (head[first] == '{' || head[first] == '/');
}

bool is_binary(std::string_view head) {
    return std::any_of(head.begin(), head.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < ' ' && (byte < '\t' || byte > '\r')) || byte == 0x7F;
    });
}

/// True if the first entity is one of NFF: a view, on lines of its own, or another with a number.
/// Wavefront's OBJ begins with some of the same letters.
bool looks_like_nff(std::string_view head) {
    static constexpr std::string_view blanks = " \t\r\n\v\f";
    const auto next_word = [&] {
        head.remove_prefix(std::min(head.find_first_not_of(blanks), head.size()));
        const std::string_view word = head.substr(0, head.find_first_of(blanks));
        head.remove_prefix(word.size());
        return word;
    };
    std::string_view word = next_word();
    while (word.starts_with('#')) {
        head.remove_prefix(std::min(head.find('\n'), head.size()));
        word = next_word();
    }
    if (word.empty()) return true; // remarks alone, so far
    if (word == "v") return next_word() == "from";
    static constexpr std::array<std::string_view, 7> others = {"b", "c", "f", "l", "p", "pp", "s"};
    return std::find(others.begin(), others.end(), word) != others.end() && is_number(next_word());
}

bool is_json(InputFile& file) {
    std::string ending = std::filesystem::path(file.name()).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (ending == ".json") return true;
    if (ending == ".nff") return false;
    if (is_binary(file.head()))
        throw BadInput(file.name(), "", "must be a scene in JSON or NFF, got a binary file");
    if (looks_like_json(file.head())) return true;
    if (!looks_like_nff(file.head()))
        throw BadInput(
            file.name(), "",
            "must be a scene in JSON (.json) or NFF (.nff), and what it holds is neither");
    return false;
}

core::Scene read_scene(InputFile& file, const LoadOptions& options) {
    file.on_read = options.on_read;
    if (file.head().empty()) throw BadInput(file.name(), "", "must be a scene, got an empty file");
    return is_json(file) ? read_json(file, options.workers) : read_nff(file, options.workers);
}

} // namespace

core::Scene load_scene(const std::filesystem::path& path, const LoadOptions& options) {
    InputFile file(path);
    return read_scene(file, options);
}

core::Scene parse_scene(const std::string& name, std::string_view text,
                        const LoadOptions& options) {
    InputFile file(name, text);
    return read_scene(file, options);
}

} // namespace raylane::scenes
