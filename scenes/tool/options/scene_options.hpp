#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/tool/options/option.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Options for reading and viewing scenes, for sequences of them, and for messages.
namespace raylane::scenes {

/// The messages on standard error in addition to errors.
enum class Verbosity {
    quiet,   ///< nothing
    normal,  ///< remarks on files; progress of long work, and of any work on a terminal
    verbose, ///< also each step, its options and duration, even without a terminal
};

struct VerbosityArguments : OptionTable {
    explicit VerbosityArguments(OptionTable& parent) : OptionTable(parent, parent.group()) {}

    Flag quiet = {*this, "-q,--quiet", flag().without({"--verbose"}),
                  "Print only errors on standard error."};
    Flag verbose = {*this, "-v,--verbose", flag(),
                    "Print steps and their times on standard error."};

    Verbosity verbosity() const {
        return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
    }
};

/// The heading in the help of options for several images.
inline constexpr const char* group_of_several = "Parameters and sequences";

/// The images that an automatic camera and the ranges of colours are fitted to.
enum class FitTo : std::uint8_t { first, all, each };

/// A turn by `degrees`, divided into `count` images.
struct Turn {
    double degrees;
    std::size_t count;
};

/// The values of a scene's parameter: "n=1.5", or "n=1.2:1.8:20".
struct ParameterSweep {
    std::string name;
    std::vector<double> values;
    bool is_sweep = false; ///< has the second form
};

Values<FrameRange> frame_ranges();
Values<Turn> turns();
/// `sweeps`: whether a parameter may have several values.
Values<ParameterSweep> parameter_values(bool sweeps);

/// Options for several images.
struct FrameArguments : OptionTable {
    explicit FrameArguments(OptionTable& parent) : OptionTable(parent, group_of_several) {}

    Option<FrameRange> frames = {
        *this, "--frames", frame_ranges().otherwise("0").recorded(),
        "Frames of a trajectory of atoms: one number, or START:STOP:STEP as in Python, "
        "with a step of at least 1. Images are numbered by frame."};
    Option<Turn> turn = {
        *this, "--turn", turns().recorded(),
        "Turn the camera to its right around the point that it looks at: IMAGES images, "
        "each turned by DEGREES/IMAGES from the one before."};
    Option<FitTo> camera_from = {
        *this, "--camera-from",
        choice<FitTo>({{"first", FitTo::first}, {"all", FitTo::all}, {"each", FitTo::each}})
            .initially(FitTo::first)
            .recorded(),
        "Frames that an automatic camera and the ranges of colours are fitted to: the "
        "first one, all, or each one separately."};
    Flag overwrite = {*this, "--overwrite,--force", flag(),
                      "Render images of a sequence again that exist already."};

    /// Returns true if the options request the image of one frame by its number.
    bool is_one() const { return frames && frames->is_one && !turn; }
};

/// Options for the parameters of a scene.
struct ParameterArguments : OptionTable {
    ParameterArguments(OptionTable& parent, bool sweeps);

    /// Returns one value of each parameter for each image. There is one image if each parameter has
    /// one value. Throws BadInput if two parameters have different numbers of values above one.
    std::vector<std::map<std::string, double>> values() const;
    /// Returns true if any value has the form FIRST:LAST:COUNT, even if COUNT is 1.
    bool has_sweep() const;

    ListOption<ParameterSweep> set;
};

/// Changes to the view that a scene requests.
struct ViewChange {
    std::optional<core::NamedView> way;       ///< for a camera that finds its place
    std::optional<core::Camera> fixed_camera; ///< in place of the scene's
    std::optional<core::Vec3f> up;
    std::optional<float> zoom, depth_cue;
    std::optional<core::Projection> projection;
    bool turning = false; ///< the camera will turn around the scene

    /// Returns the scene's automatic camera with these changes. If the scene keeps its own camera,
    /// changes are made to `camera` instead. Throws BadInput.
    core::AutoCamera auto_camera(const core::Scene& scene, core::Camera& camera) const;
};

/// Returns a scene's camera and fog, and the lights that came with the camera.
core::View view_of(const core::Scene& scene);

/// Returns the scene with its view in an image of the settings' size. A camera that finds its place
/// by itself sees everything in `frame`, or the whole scene if `frame` is not set. Throws BadInput
/// if that is empty.
core::Scene seen(core::Scene scene, const ViewChange& change, const core::Settings& settings,
                 const std::optional<core::Frame>& frame = std::nullopt);

/// The name of a view, or a direction that the camera looks in, such as "1,-1,-0.5". The view
/// "best" has no direction yet.
Values<core::NamedView> views();
/// A camera in JSON, as `view` prints it.
Values<core::Camera> cameras();
/// A colour, or nothing for "none".
struct Background {
    std::optional<core::Color> color;
};
Values<Background> backgrounds();
Values<core::Vec3f> upward_directions();

struct ViewArguments : OptionTable {
    explicit ViewArguments(OptionTable& parent) : OptionTable(parent, "Camera") {}

    Option<core::NamedView> view = {
        *this, "--view", views().otherwise(as_in_file, "front; crystals obliquely").recorded(),
        "Frame all bounded shapes from front, back, left, right, top, bottom, x, y, z, -x, -y, "
        "-z or corner, or looking in a direction such as 1,-1,-0.5. With a cell: a, b or c has "
        "this edge "
        "towards the viewer, and c upward, or b for c. best shows the largest extent across the "
        "image, and the smallest in depth; of a crystal, it is that of a, b and c with the "
        "shortest edge in depth, c if all are equal."};
    Option<core::Camera> camera = {
        *this, "--camera", cameras().recorded().without({"--view", "--up"}),
        "Camera as JSON, in the form that the key c of raylane view prints."};
    Option<Background> background = {*this, "--background",
                                     backgrounds().recorded().otherwise("white for atoms"),
                                     "Background of atoms: a colour, such as black, #204060 or "
                                     "linear 0.1,0.2,0.3, or none. none "
                                     "works for any scene, and is the same as --alpha."};
    Option<core::Vec3f> up = {
        *this, "--up", upward_directions().otherwise("as in the view or the scene").recorded(),
        "Upward direction of the image: x, y, z, -x, -y or -z, or a direction such as "
        "0,1,1."};
    Option<float> zoom = {*this, "--zoom",
                          number(0.01F, 1000.0F, "TIMES").otherwise("1").recorded(),
                          "Magnification."};
    Flag orthographic = {*this, "--orthographic", flag().recorded(),
                         "Use an orthographic projection, as crystals do by default."};
    Flag perspective = {*this, "--perspective", flag().recorded().without({"--orthographic"}),
                        "Use a perspective projection."};
    Option<float> depth_cue = {*this, "--depth-cue",
                               number(0.0F, 0.99F, "SHARE").otherwise(as_in_file, "0.3").recorded(),
                               "Share of the background in the colour of the farthest shapes."};

    ViewChange change() const {
        std::optional<core::Projection> projection;
        if (orthographic) projection = core::Projection::orthographic;
        if (perspective) projection = core::Projection::perspective;
        return {view.value(), camera.value(),    up.value(),
                zoom.value(), depth_cue.value(), projection};
    }
};

/// Words that the option of the same name in drawing_options.hpp takes.
Values<std::string> drawing_words(std::string type, std::string range = "");
inline constexpr const char* for_crystals = "on for crystals";

/// Options for the look of atoms: types, help and defaults. Their meaning is in
/// drawing_options.hpp.
struct DrawingArguments : OptionTable {
    explicit DrawingArguments(OptionTable& parent)
        : OptionTable(parent, "Atoms (PDB, PQR, mmCIF, CIF, XYZ, GRO, MOL, SDF, MOL2, LAMMPS)") {}

    Option<Style> style = {
        *this, "--style",
        choice<Style>(named_styles())
            .otherwise("balls for up to 500 atoms, otherwise spheres")
            .recorded(),
        "Style of atoms and bonds. balls have sticks; spheres have van der Waals radii; "
        "touching has covalent radii, and metallic ones in metals; envelope is the "
        "solvent-accessible surface. cartoon, tube and trace show the chains of proteins and "
        "nucleic acids; cylinders is a cartoon with cylinders for helices."};
    Option<std::string> color = {
        *this, "--color",
        drawing_words("BY")
            .otherwise("element; for chains, chain, or secondary if "
                       "there is one chain")
            .recorded(),
        "Colours of atoms: element, chain, residue, secondary (helices and strands), rainbow "
        "(along each chain), a number per atom in the file, such as "
        "b_factor, or a colour, such as orange or #ff8000. \"carbons chain\" colours carbon, and "
        "other atoms by element. Fe=gold or 1=red is for an element or type."};
    Option<std::string> palette = {*this, "--palette",
                                   choice(named_palettes()).otherwise("viridis").recorded(),
                                   "Colours for a number per atom."};
    Option<std::string> range = {
        *this, "--range",
        drawing_words("A B").in_pairs().otherwise("the range in the image").recorded(),
        "Numbers at the ends of the palette, such as 0 50 or 0:50."};
    Option<std::string> radius = {
        *this, "--radius", drawing_words("X").otherwise("that of the style").recorded(),
        "Radius of atoms in angstrom, and of sticks in styles without balls. \"0.4 H=0.2\" sets "
        "another one for an element or type."};
    Option<std::string> scale = {*this, "--scale", drawing_words("X").otherwise("1").recorded(),
                                 "Factor for the radii, in the same form."};
    Option<std::string> select = {
        *this, "--select", word("WHICH").otherwise("all").recorded(),
        "Atoms to show: all, none, protein, nucleic, ligand, water, ion, metal, hetero, hydrogen, "
        "backbone, sidechain, helix, strand, chain A B, residue ALA 17 20-30, element C Fe, name "
        "CA, type 1, index 1-100, x < 50, a number per atom in the file, such as b_factor < 30, "
        "within 5 of ..., or byres ... Combine these by not, and, or and parentheses. PyMOL's and "
        "VMD's words "
        "for these are known, too."};
    ListOption<std::string> show = {
        *this, "--show", drawing_words("WHICH:LOOK").recorded(),
        "Show only the atoms of a selection, in a look: \"ligand: sticks orange\" or "
        "\"protein: spheres white opacity 0.3 + sticks\". A look has a style, a colour as in "
        "--color, opacity A, radius R, scale X, palette NAME and range A:B. Omitted words have the "
        "values of the other options. + shows two looks at once. Several --show add up; the last "
        "one that selects an atom decides its look."};
    ListOption<std::string> hide = {*this, "--hide", word("WHICH").recorded(),
                                    "Atoms to leave out, in the words of --select."};
    Option<std::string> opacity = {
        *this, "--opacity", drawing_words("A", "above 0 and up to 1").otherwise("1").recorded(),
        "Opacity of atoms and bonds. Inner surfaces of overlapping shapes are hidden."};
    Option<std::string> repeat = {*this, "--repeat",
                                  drawing_words("AxBxC").otherwise("1x1x1").recorded(),
                                  "Repeat the unit cell along its edges, such as 2x2x1."};
    Option<std::string> atom_style = {
        *this, "--atom-style",
        word("STYLE")
            .otherwise("the comment after Atoms, otherwise the style that fits the columns")
            .recorded(),
        "Atom style of a LAMMPS data file, such as full or \"hybrid sphere dipole\"."};
    Option<Finish> look = {
        *this, "--look", choice(named_finishes()).otherwise("a soft highlight").recorded(),
        "Look of surfaces: matte has no highlight, glossy a sharp one, flat has plain colours and "
        "outlines, without depth cue; print is matte with thin outlines, without depth cue, at 50 "
        "dB."};
    ListOption<std::string> cut = {
        *this, "--cut", drawing_words("PLANE").recorded(),
        "Show only the part on one side of a plane, with closed faces: z<1.5, x>0, or A,B,C,D for "
        "A x + B y + C z <= D, in angstrom. The number may be middle, that of the atoms, or "
        "middle+1.5: z<middle. With several planes, the part that meets all conditions."};
    Option<std::string> slab = {
        *this, "--slab", drawing_words("A B").in_pairs().recorded(),
        "Show only the part between two depths in angstrom: -2 2, -2:2 or -2,2. The middle of the "
        "atoms has depth 0; depth grows towards the viewer. Works without --camera."};
    Flag cell = {*this, "--cell", flag().recorded(), "Show the edges of the unit cell."};
    Flag axes = {*this, "--axes", flag().recorded(),
                 "Show the directions of the cell's edges as arrows: a red, b green, c blue."};
    Option<std::string> boundary = {
        *this, "--boundary", drawing_words("on|off").otherwise(for_crystals).recorded(),
        "Repeat an atom or molecule on a face, edge or corner of the cell on all equivalent ones. "
        "Crystals are CIF files, and XYZ of up to 500 atoms in a periodic cell."};
    Option<std::string> whole_molecules = {
        *this, "--whole", drawing_words("on|off").otherwise(for_crystals).recorded(),
        "Move atoms into the cell, but do not cut molecules: each one moves as a whole. A molecule "
        "is a finite set of bonded atoms."};
    ListOption<std::string> polyhedra = {
        *this, "--polyhedra", drawing_words("WHICH").recorded(),
        "Show coordination polyhedra, the hulls of the atoms bonded to each atom of an element or "
        "type: Ti or \"Ti Zr opacity 0.6\", with the words of --show. Atoms are balls without "
        "sticks, unless --style is given."};
    Flag hydrogen_bonds = {
        *this, "--hydrogen-bonds", flag().recorded(),
        "Show hydrogen bonds as dashed lines: N, O or F with a hydrogen atom that is less than 2.5 "
        "angstrom from another of these, at an angle above 120 degrees. Without hydrogen atoms in "
        "the file: a donor and an acceptor within 3.5 angstrom, both at angles above 90 degrees to "
        "the atoms bonded to them."};
    Flag ellipsoids = {*this, "--ellipsoids", flag().recorded(),
                       "Show displacements (ANISOU, U and B) as ellipsoids or spheres."};
    Option<float> probability = {*this, "--probability",
                                 number(1.0F, 99.0F, "PERCENT").otherwise("50").recorded(),
                                 "Probability that an atom is in its ellipsoid."};
    Flag ellipses = {*this, "--ellipses", flag().recorded(),
                     "Show ellipsoids with their principal ellipses."};
    Flag octants = {*this, "--octants", flag().recorded(),
                    "Show ellipsoids with principal ellipses, and without the octant that faces "
                    "the camera."};

    DrawingOptions given() const;
};

struct OneFrameArgument : OptionTable {
    explicit OneFrameArgument(OptionTable& parent) : OptionTable(parent, group_of_several) {}

    Option<FrameRange> frames = {
        *this, "--frames", frame_ranges().otherwise("0"),
        "Frame of a trajectory of atoms, numbered from 0; -1 is the last one. START:STOP:STEP "
        "selects its first frame."};
};

struct SceneArguments {
    /// `sweeps`: whether parameters may have several values, for several images. Without sweeps
    /// there is one frame.
    explicit SceneArguments(OptionTable& parent, bool sweeps = false)
        : verbosity(parent), view(parent), parameters(parent, sweeps), drawing(parent) {
        if (!sweeps) frame.emplace(parent);
    }

    /// Returns options with the first value of each parameter. Throws BadInput.
    LoadOptions load_options() const;

    VerbosityArguments verbosity;
    ViewArguments view;
    ParameterArguments parameters;
    DrawingArguments drawing;
    std::optional<OneFrameArgument> frame;
};

} // namespace raylane::scenes
