#pragma once

#include "scenes/tool/command.hpp"

namespace raylane::scenes {

/// The messages on standard error in addition to errors.
enum class Verbosity {
    quiet,   ///< nothing
    normal,  ///< remarks on files; progress of long work, and of any work on a terminal
    verbose, ///< also each step, its options and duration, even without a terminal
};

struct VerbosityArguments {
    bool quiet = false, verbose = false;

    void add_to(CLI::App& command);
    /// Throws BadInput.
    Verbosity verbosity() const;
};

} // namespace raylane::scenes
