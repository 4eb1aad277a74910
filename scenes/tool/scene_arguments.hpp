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

/// Command line options for reading and viewing a scene, and for messages about it.
struct SceneArguments {
    DrawingArguments drawing;
    ViewArguments view;
    ParameterArguments parameters;
    VerbosityArguments verbosity;

    /// `sweeps`: whether parameters may have several values, for several pictures.
    void add_to(CLI::App& command, bool sweeps = false);
    /// Returns options with the first value of each parameter. Throws BadInput.
    LoadOptions load_options(bool sweeps = false) const;
    /// Returns names and values of the options that are given. Flags have empty values.
    std::vector<std::pair<std::string, std::string>> given() const;
};

} // namespace raylane::scenes
