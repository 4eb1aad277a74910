#pragma once

#include <filesystem>
#include <string>

namespace raylane::scenes {

/// Returns the extension of a file name, such as ".json", in lower case.
inline std::string ending_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

} // namespace raylane::scenes
