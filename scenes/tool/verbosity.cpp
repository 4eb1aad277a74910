#include "scenes/tool/verbosity.hpp"

#include "scenes/errors.hpp"

namespace raylane::scenes {

void VerbosityArguments::add_to(CLI::App& command) {
    add_flag(command, "-q,--quiet", quiet, "Print only errors on standard error.");
    add_flag(command, "-v,--verbose", verbose, "Print steps and their times on standard error.");
}

Verbosity VerbosityArguments::verbosity() const {
    if (quiet && verbose) throw BadInput("--quiet", "", "goes without --verbose");
    return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
}

} // namespace raylane::scenes
