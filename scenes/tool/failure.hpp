#pragma once

#include <string_view>

namespace raylane::scenes {

/// Exit codes of the program.
enum ExitCode { done = 0, bad_input = 2, refused = 3 };

/// The message for an exception, one line per error, and the exit code of the program.
struct Failure {
    int code; ///< an ExitCode, or 128 + the number of the signal that stopped the program
    std::string_view text;
};

/// Describes the exception that is being handled. The text is valid until the handler ends.
/// Allocates no memory, because memory may have run out.
Failure failure_being_handled();

} // namespace raylane::scenes
