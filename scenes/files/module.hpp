#pragma once

#include <string>

namespace raylane::scenes {

/// A part of the program that is loaded on demand, because most uses do not need its libraries. It
/// lies beside the program or the shared library that loads it, or in the module folder after
/// installation.
struct Module {
    const char* file;        ///< such as raylane-window.so
    const char* function;    ///< the function that it exports
    const char* built_where; ///< "SDL2 at build time (Debian: libsdl2-dev)"
};

/// Loads the module and returns its function. The module stays loaded as long as the program runs.
/// Throws SystemRefused with `what_fails` and the reason.
void* function_of(const Module& module, const std::string& what_fails);

} // namespace raylane::scenes
