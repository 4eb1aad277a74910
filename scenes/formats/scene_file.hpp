#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"
#include "scenes/formats/structure/drawing_options.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "scenes/formats/tachyon/shading.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace raylane::scenes {

struct LoadOptions {
    core::Workers* workers = nullptr; ///< build the hierarchy; default: the caller's thread
    OnRead on_read = {};
    OnRemark on_remark = {};     ///< for files of other programs, and for scenes without objects
    std::string atom_style = {}; ///< of LAMMPS data files; empty: the one that the file names
    FrameRange frames = {};      ///< of a file of atoms, of which the first one is shown
    std::function<void(const Structure&)> on_structure = {}; ///< receives that frame
    Drawing drawing = {};                                    ///< how atoms are drawn
    Legend* legend = nullptr; ///< receives the meaning of the shapes of a file of atoms
    /// The name of an option that says how atoms are drawn, or empty. Scenes are refused with it.
    std::string option_for_atoms = {};
    TachyonShading tachyon = {}; ///< overrides the shading that a Tachyon scene requests
    /// Values for "$name" in JSON, which override those of the file. A name that the file does not
    /// use is an error.
    std::map<std::string, double> parameters = {};

    ReaderOptions reader() const { return {atom_style, on_remark, frames, on_structure}; }
    /// Sets the options of a drawing, the atom style, and the frame. Throws BadInput.
    void set_drawing(DrawingOptions given);
};

/// Reads a scene, or atoms, from which it makes a scene. scenes/formats/format.hpp lists the
/// formats. Throws BadInput with file and place for malformed input, and SystemRefused.
core::Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// Does the same for the text of a file. `name` is the file's name in messages.
core::Scene parse_scene(const std::string& name, std::string_view text,
                        const LoadOptions& options = {});

} // namespace raylane::scenes
