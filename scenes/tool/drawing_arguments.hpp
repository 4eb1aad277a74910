#pragma once

#include "scenes/structure/drawing.hpp"
#include "scenes/tool/command.hpp"

#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// How atoms are drawn, as the command line says it.
struct DrawingArguments {
    Argument style, color, select, opacity, repeat, atom_style;
    bool cell = false, ellipsoids = false;

    void add_to(CLI::App& command);
    /// Throws BadInput.
    Drawing drawing() const;
    /// Names of those that are given, and their values; of flags these are empty.
    std::vector<std::pair<std::string, std::string>> given() const;
    /// The first of these names; empty if none is given.
    std::string first_given() const;
};

} // namespace raylane::scenes
