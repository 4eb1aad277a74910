#include "scenes/scene_file.hpp"

#include "scenes/errors.hpp"
#include "scenes/input_file.hpp"
#include "scenes/json/reader.hpp"
#include "scenes/nff/reader.hpp"

#include <algorithm>
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

bool is_json(InputFile& file) {
    std::string ending = std::filesystem::path(file.name()).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (ending == ".json") return true;
    if (ending == ".nff") return false;
    if (is_binary(file.head()))
        throw BadInput(file.name(), "", "must be a scene in JSON or NFF, got a binary file");
    return looks_like_json(file.head());
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
