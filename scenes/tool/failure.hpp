#pragma once

#include <string_view>

namespace raylane::scenes {

/// What the program exits with.
enum ExitCode { done = 0, bad_input = 2, refused = 3 };

/// What is to be said of an exception, a line for each error, and what the program is to exit with.
struct Failure {
    int code; ///< an ExitCode, or 128 + the signal that has stopped it
    std::string_view text;
};

/// Of the exception that is being handled, for as long as it is. Takes no memory: that may be what
/// there is none of.
Failure failure_being_handled();

} // namespace raylane::scenes
