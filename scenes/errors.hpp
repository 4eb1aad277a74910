#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The errors that the tool reports. Their text is one line without control characters, and begins
/// with the file.
namespace raylane::scenes {

/// Input that cannot be meant: a malformed scene, wrong usage. Exit code 2.
class BadInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// "file: place: message", or "file: message" if the place is empty.
    BadInput(std::string_view file, std::string_view place, std::string_view message);
};

/// The system would not: reading, writing, memory. Exit code 3.
class SystemRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// "file: cannot `action`: what strerror says of `error_number`".
    SystemRefused(std::string_view file, std::string_view action, int error_number);
};

/// `text` fit for one line of a message: control characters and bytes that are not UTF-8 as \xNN,
/// cut after `most` characters with "..." behind.
std::string printable(std::string_view text, std::size_t most = 40);

/// ", did you mean "near"?" with the candidate nearest to `unknown` by edit distance, behind
/// `prefix`, or "" if none is near.
std::string suggestion(std::string_view unknown, const std::vector<std::string_view>& candidates,
                       std::string_view prefix = "");

/// "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

} // namespace raylane::scenes
