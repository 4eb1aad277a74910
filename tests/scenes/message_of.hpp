#pragma once

#include <exception>
#include <filesystem>
#include <string>

namespace raylane::tests {

/// Message that an act is refused with; "no error" if it is not.
template <class Error = std::exception, class Act>
std::string message_of(const Act& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// The same where that names a file in the directory: from its name on.
template <class Error, class Act>
std::string message_in(const std::filesystem::path& directory, const Act& act) {
    try {
        act();
    } catch (const Error& error) {
        return std::string(error.what()).substr(directory.string().size() + 1);
    }
    return "no error";
}

} // namespace raylane::tests
