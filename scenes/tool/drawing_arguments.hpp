#pragma once

#include "scenes/structure/drawing.hpp"
#include "scenes/tool/command.hpp"

#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// Command line options that say how atoms are drawn.
struct DrawingArguments {
    Argument style, color, select, opacity, repeat, atom_style;
    bool cell = false, ellipsoids = false;

    void add_to(CLI::App& command);
    /// Throws BadInput.
    Drawing drawing() const;
    /// Returns names and values of the options that are given. Flags have empty values.
    std::vector<std::pair<std::string, std::string>> given() const;
    /// Returns the first of these names, or an empty text.
    std::string first_given() const;
};

} // namespace raylane::scenes
