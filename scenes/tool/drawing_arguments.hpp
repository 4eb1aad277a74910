#pragma once

#include "scenes/structure/drawing.hpp"
#include "scenes/tool/command.hpp"

#include <string>

namespace raylane::scenes {

/// How atoms are drawn, as the command line says it.
struct DrawingArguments {
    Argument style, color, select, repeat, view, zoom, depth_cue;
    bool cell = false, ellipsoids = false, orthographic = false;

    void add_to(CLI::App& command);
    /// Throws BadInput.
    Drawing drawing() const;
    /// The first of those that are given; empty if none is.
    std::string first_given() const;
};

} // namespace raylane::scenes
