#pragma once

#include <exception>
#include <filesystem>
#include <regex>
#include <string>

namespace raylane::tests {

/// Returns the message of the Error that `act` throws, or "no error" if it throws none.
template <class Error = std::exception, class Act>
std::string message_of(const Act& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// Returns the same for a message that begins with the path of a file in the directory, from the
/// file's name on.
template <class Error, class Act>
std::string message_in(const std::filesystem::path& directory, const Act& act) {
    try {
        act();
    } catch (const Error& error) {
        return std::string(error.what()).substr(directory.string().size() + 1);
    }
    return "no error";
}

/// Returns a message on a file with its line in words, "a.nff: line 9: ..." for "a.nff:9: ...".
/// Omits line and column where the message has both, for tests of the text and not of the place.
inline std::string in_words(const std::string& message) {
    static const std::regex line_and_column("^((raylane: )?[^:]*):[0-9]+:[0-9]+: ");
    static const std::regex line("^((raylane: )?[^:]*):([0-9]+): ");
    return std::regex_replace(std::regex_replace(message, line_and_column, "$1: "), line,
                              "$1: line $3: ");
}

} // namespace raylane::tests
