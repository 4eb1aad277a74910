#pragma once

#include <exception>
#include <filesystem>
#include <regex>
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

/// A message on a file with its line in words, "a.nff: line 9: ..." for "a.nff:9: ...", and without
/// line and column where both are there, for tests of what is said rather than where.
inline std::string in_words(const std::string& message) {
    static const std::regex line_and_column("^((raylane: )?[^:]*):[0-9]+:[0-9]+: ");
    static const std::regex line("^((raylane: )?[^:]*):([0-9]+): ");
    return std::regex_replace(std::regex_replace(message, line_and_column, "$1: "), line,
                              "$1: line $3: ");
}

} // namespace raylane::tests
