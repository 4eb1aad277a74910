#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"
#include "scenes/structure/drawing.hpp"
#include "scenes/structure/legend.hpp"
#include "scenes/tachyon/shading.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace raylane::scenes {

struct LoadOptions {
    core::Workers* workers = nullptr; ///< who builds the hierarchy; default: the caller's thread
    OnRead on_read = {};
    OnRemark on_remark = {};     ///< of files of other programs, and of scenes without objects
    std::string atom_style = {}; ///< of LAMMPS' data; empty: the file's
    Drawing drawing = {};        ///< of files of atoms
    Legend* legend = nullptr;    ///< is left with what the shapes are, of a file of atoms
    /// What a scene is refused with: an option that says how atoms are drawn; empty: none is given.
    std::string option_for_atoms = {};
    TachyonShading tachyon = {}; ///< in place of what a scene of Tachyon's says
    /// What "$name" stands for in JSON, in place of what the file says; each has to be used.
    std::map<std::string, double> parameters = {};
};

/// Reads a scene, or atoms, of which it makes one; scenes/format.hpp has the formats. Throws
/// BadInput for what is malformed, with file and place, and SystemRefused.
core::Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// The same for the text of a file; `name` is what messages call it.
core::Scene parse_scene(const std::string& name, std::string_view text,
                        const LoadOptions& options = {});

} // namespace raylane::scenes
