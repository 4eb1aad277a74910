#pragma once

#include "scenes/tool/command.hpp"

namespace raylane::scenes {

/// What is said on standard error besides complaints.
enum class Verbosity {
    quiet,   ///< nothing
    normal,  ///< remarks on files and, where it takes long or there is a terminal, progress
    verbose, ///< what is done, with what, and how long it took, wherever that goes
};

struct VerbosityArguments {
    bool quiet = false, verbose = false;

    void add_to(CLI::App& command);
    /// Throws BadInput.
    Verbosity verbosity() const;
};

} // namespace raylane::scenes
