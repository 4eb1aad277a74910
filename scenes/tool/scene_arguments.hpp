#pragma once

#include "scenes/scene_file.hpp"
#include "scenes/tool/drawing_arguments.hpp"
#include "scenes/tool/parameter_arguments.hpp"
#include "scenes/tool/verbosity.hpp"
#include "scenes/tool/view_arguments.hpp"

#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// How a scene is read and seen, and what is said of it, as the command line says it.
struct SceneArguments {
    DrawingArguments drawing;
    ViewArguments view;
    ParameterArguments parameters;
    VerbosityArguments verbosity;

    /// `sweeps`: whether parameters may have several values, for several pictures.
    void add_to(CLI::App& command, bool sweeps = false);
    /// With the first value of each parameter. Throws BadInput.
    LoadOptions load_options(bool sweeps = false) const;
    /// Names of those that are given, and their values; of flags these are empty.
    std::vector<std::pair<std::string, std::string>> given() const;
};

} // namespace raylane::scenes
