#include "scenes/tool/verbosity.hpp"

#include "scenes/errors.hpp"

namespace raylane::scenes {

void VerbosityArguments::add_to(CLI::App& command) {
    add_flag(command, "-q,--quiet", quiet, "Say nothing on standard error but complaints");
    add_flag(command, "-v,--verbose", verbose,
             "Say on standard error what is done, and how long it takes");
}

Verbosity VerbosityArguments::verbosity() const {
    if (quiet && verbose) throw BadInput("--quiet", "", "goes without --verbose");
    return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
}

} // namespace raylane::scenes
