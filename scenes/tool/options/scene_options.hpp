#pragma once

#include "core/scene/scene.hpp"
#include "scenes/scene_file.hpp"
#include "scenes/structure/drawing.hpp"
#include "scenes/tool/options/sequence_options.hpp"

#include <array>
#include <optional>
#include <string>

/// Options for reading and viewing a scene, and for messages about it.
namespace raylane::scenes {

/// The messages on standard error in addition to errors.
enum class Verbosity {
    quiet,   ///< nothing
    normal,  ///< remarks on files; progress of long work, and of any work on a terminal
    verbose, ///< also each step, its options and duration, even without a terminal
};

struct VerbosityArguments : OptionTable {
    explicit VerbosityArguments(OptionTable& whole) : OptionTable(whole, whole.group()) {}

    Flag quiet = {*this, "-q,--quiet", flag().without({"--verbose"}),
                  "Print only errors on standard error."};
    Flag verbose = {*this, "-v,--verbose", flag(),
                    "Print steps and their times on standard error."};

    Verbosity verbosity() const {
        return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
    }
};

/// Changes to the view that a scene requests.
struct ViewChange {
    std::optional<core::NamedView> way; ///< for a camera that finds its place
    std::optional<core::Vec3f> up;
    std::optional<float> zoom, depth_cue;
    bool orthographic = false;
    bool turning = false; ///< the camera will turn around the scene

    /// Returns the scene's staging with these changes. If the scene keeps its own camera, changes
    /// are made to `camera` instead. Throws BadInput.
    core::Staging staging(const core::Scene& scene, core::Camera& camera) const;
};

/// Returns a scene's camera and fog, and the lights that came with the camera.
core::View view_of(const core::Scene& scene);

/// Returns the scene with its view in an image of the settings' size. A camera that finds its place
/// by itself sees everything in `frame`, or the whole scene if `frame` is not set. Throws BadInput
/// if that is empty.
core::Scene seen(core::Scene scene, const ViewChange& change, const core::Settings& settings,
                 const std::optional<core::Frame>& frame = std::nullopt);

/// The name of a view, or a direction that the camera looks in, such as "1,-1,-0.5".
Values<core::NamedView> views();
Values<core::Vec3f> upward_directions();

struct ViewArguments : OptionTable {
    explicit ViewArguments(OptionTable& whole) : OptionTable(whole, "Camera") {}

    Option<core::NamedView> view = {
        *this, "--view", views().otherwise(as_in_file, "front").recorded(),
        "Frame all bounded shapes from front, back, left, right, top, bottom, x, y, z or "
        "corner, or looking in a direction such as 1,-1,-0.5."};
    Option<core::Vec3f> up = {
        *this, "--up", upward_directions().otherwise("as in the view or the scene").recorded(),
        "Upward direction of the image: x, y, z, -x, -y or -z, or a direction such as "
        "0,1,1."};
    Option<float> zoom = {*this, "--zoom",
                          number(0.01F, 1000.0F, "TIMES").otherwise("1").recorded(),
                          "Magnification."};
    Flag orthographic = {*this, "--orthographic", flag().recorded(),
                         "Use an orthographic projection."};
    Option<float> depth_cue = {*this, "--depth-cue",
                               number(0.0F, 0.99F, "SHARE").otherwise(as_in_file, "0.3").recorded(),
                               "Share of the background in the colour of the farthest shapes."};

    ViewChange change() const {
        return {view.value(), up.value(), zoom.value(), depth_cue.value(), orthographic.is_given()};
    }
};

Values<float> opacities();
/// Numbers of cells along the edges of the unit cell.
Values<std::array<int, 3>> repetitions();

/// Options for the look of atoms.
struct DrawingArguments : OptionTable {
    explicit DrawingArguments(OptionTable& whole)
        : OptionTable(whole, "Atoms (PDB, mmCIF, CIF, XYZ, GRO, LAMMPS)") {}

    Option<Style> style = {
        *this, "--style",
        choice<Style>({{"balls", Style::balls},
                       {"sticks", Style::sticks},
                       {"licorice", Style::licorice},
                       {"spheres", Style::spheres},
                       {"points", Style::points}})
            .otherwise("balls for up to 500 atoms, otherwise spheres")
            .recorded(),
        "Style of atoms and bonds. balls have sticks; spheres have van der Waals radii."};
    Option<std::string> color = {
        *this, "--color", word("BY").otherwise("element").recorded(),
        "Property that colours the atoms: element, chain, residue, or a number per atom "
        "in the file, such as b_factor."};
    Option<std::string> select = {
        *this, "--select", word("WHICH").otherwise("all").recorded(),
        "Atoms to show: all, none, protein, nucleic, water, hetero, hydrogen, backbone, "
        "chain A B, residue ALA 17 20-30, element C Fe, name CA, type 1, index 1-100, a "
        "number per atom in the file, such as b_factor < 30, or within 5 of ... Combine "
        "these by not, and, or and parentheses."};
    Option<float> opacity = {
        *this, "--opacity", opacities().otherwise("1").recorded(),
        "Opacity of atoms and bonds. Inner surfaces of overlapping shapes are hidden."};
    Option<std::array<int, 3>> repeat = {*this, "--repeat",
                                         repetitions().otherwise("1x1x1").recorded(),
                                         "Repeat the unit cell along its edges, such as 2x2x1."};
    Option<std::string> atom_style = {
        *this, "--atom-style",
        word("STYLE")
            .otherwise("the comment after Atoms, otherwise the style that fits the columns")
            .recorded(),
        "Atom style of a LAMMPS data file, such as full or \"hybrid sphere dipole\"."};
    Flag cell = {*this, "--cell", flag().recorded(), "Show the edges of the unit cell."};
    Flag ellipsoids = {*this, "--ellipsoids", flag().recorded(),
                       "Show displacements (ANISOU, U and B) as ellipsoids or spheres of "
                       "50 % probability."};

    Drawing drawing() const;
};

struct SceneArguments {
    /// `sweeps`: whether parameters may have several values, for several images.
    explicit SceneArguments(OptionTable& whole, bool sweeps = false)
        : verbosity(whole), view(whole), parameters(whole, sweeps), drawing(whole) {}

    /// Returns options with the first value of each parameter. Throws BadInput.
    LoadOptions load_options() const;

    VerbosityArguments verbosity;
    ViewArguments view;
    ParameterArguments parameters;
    DrawingArguments drawing;
};

} // namespace raylane::scenes
