#pragma once

#include "scenes/tool/command.hpp"

#include <map>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Command line values of a scene's parameters.
struct ParameterArguments {
    std::vector<std::string> set; ///< "n=1.5", or "n=1.2:1.8:20"

    /// `sweeps`: whether a parameter may have several values.
    void add_to(CLI::App& command, bool sweeps);
    /// Returns one value of each parameter for each picture. There is one picture if each parameter
    /// has one value. Throws BadInput, also if two parameters have different numbers of values
    /// above one, and if there is more than one picture without `sweeps`.
    std::vector<std::map<std::string, double>> values(bool sweeps) const;
    /// Returns true if any value has the form FIRST:LAST:COUNT, even if COUNT is 1.
    bool has_sweep() const;
};

} // namespace raylane::scenes
