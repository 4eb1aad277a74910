#pragma once

#include <string>

namespace raylane::scenes {

/// A part of the program that is loaded when it is asked for, as others have no use of the
/// libraries that it wants: beside the program as it is built, or where it is installed.
struct Module {
    const char* file;        ///< raylane-window.so
    const char* function;    ///< what it has
    const char* built_where; ///< "SDL2 is (Debian: libsdl2-dev)"
};

/// Its function; it stays loaded for as long as the program runs. Throws SystemRefused, with
/// `what_fails` and why.
void* function_of(const Module& module, const std::string& what_fails);

} // namespace raylane::scenes
