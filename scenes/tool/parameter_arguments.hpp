#pragma once

#include "scenes/tool/command.hpp"

#include <map>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Values of a scene's parameters.
struct ParameterArguments {
    std::vector<std::string> set; ///< "n=1.5", or "n=1.2:1.8:20"

    /// `sweeps`: whether several values have a meaning.
    void add_to(CLI::App& command, bool sweeps);
    /// For each picture one value of each parameter; one picture if all have one value. Throws
    /// BadInput, also where they are not equally many, and for more than one picture without
    /// `sweeps`.
    std::vector<std::map<std::string, double>> values(bool sweeps) const;
    /// True if any is FIRST:LAST:COUNT, even of one picture.
    bool has_sweep() const;
};

} // namespace raylane::scenes
