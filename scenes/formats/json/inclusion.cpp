#include "scenes/formats/json/inclusion.hpp"

#include <algorithm>
#include <system_error>

namespace raylane::scenes {

namespace {

bool contains(const std::vector<std::filesystem::path>& files, const std::filesystem::path& path) {
    return std::any_of(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        std::error_code none;
        return std::filesystem::equivalent(file, path, none);
    });
}

} // namespace

void Inclusion::include(const JsonValue& value, const std::function<void(InputFile&)>& read) {
    const std::filesystem::path path = files_.back().parent_path() / value.string();
    if (contains(files_, path))
        value.fail("must not include a file that includes it, got " + value.quoted());
    if (contains(read_, path)) return;
    const auto file = checked(value, [&] { return opener_.open(path, value.string(), depth()); });
    files_.push_back(path);
    try {
        read(*file);
    } catch (...) {
        files_.pop_back();
        throw;
    }
    files_.pop_back();
    read_.push_back(path);
}

} // namespace raylane::scenes
