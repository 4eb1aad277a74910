#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/lammps_atom_styles.hpp"
#include "scenes/formats/structure/readers.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace raylane::scenes;
using namespace raylane::tests;
using raylane::core::Vec3d;
using raylane::core::Vec3f;

namespace {

struct Reading {
    Structure frame;
    std::vector<std::string> remarks;
};

Reading read(const std::string& text, const std::string& atom_style = "") {
    Reading reading;
    InputFile file("a", text);
    ReaderOptions options{atom_style,
                          [&](const std::string& remark) { reading.remarks.push_back(remark); }};
    const bool has_frame = open_lammps_data(file, options)->next(reading.frame);
    REQUIRE(has_frame);
    return reading;
}

std::string refusal(const std::string& text, const std::string& atom_style = "") {
    return message_of<BadInput>([&] { read(text, atom_style); });
}

/// Returns a file with a box of edge 10. Its section Atoms begins in line 9 if `counts` is one
/// line.
std::string data(const std::string& counts, const std::string& section, const std::string& atoms,
                 const std::string& rest = "") {
    const auto count = std::count(atoms.begin(), atoms.end(), '\n');
    return "a remark\n\n" + std::to_string(count) + " atoms\n" + counts +
           "\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\n" + section + "\n\n" + atoms + "\n" +
           rest;
}

std::string types_of(const Structure& frame) {
    std::string text;
    for (const std::uint16_t kind : frame.kinds)
        text.append(frame.of_kind[kind].label).append(" ");
    return text;
}

std::vector<float> values_of(const Structure& frame, const std::string& name) {
    for (const AtomProperty& property : frame.properties)
        if (property.name == name) return property.values;
    return {};
}

const std::vector<Vec3f> places = {{2.5F, 3.5F, 4.5F}, {6.5F, 3.25F, 4.75F}, {2.25F, 9.5F, 8.5F}};

/// Returns three atoms of types 1, 2, 2 at `places`, in the columns of a layout.
std::string atoms_of(const AtomLayout& layout, bool with_images) {
    std::string text;
    for (int atom = 0; atom < 3; ++atom) {
        text += std::to_string(atom + 1);
        for (const std::string_view column : layout.columns) {
            text += ' ';
            const auto at = places[static_cast<std::size_t>(atom)];
            if (column == "type")
                text += atom == 0 ? "1" : "2";
            else if (column == "x" || column == "y" || column == "z")
                text += std::to_string(at[column[0] - 'x']);
            else if (column == "molecule" || column.starts_with("template") || column == "etag" ||
                     column == "bond_nt" || column == "status")
                text += std::to_string(7 * atom);
            else if (column.ends_with("flag"))
                text += "1";
            else if (column == "espin")
                text += std::to_string(atom - 1);
            else if (column == "spx")
                text += "1.0";
            else if (column == "spy" || column == "spz")
                text += "0.0";
            else if (column == "charge")
                text += atom == 0 ? "-0.5" : "0.25";
            else
                text += std::to_string(0.5 + 0.25 * atom);
        }
        text += with_images ? " 0 -1 2\n" : "\n";
    }
    return text;
}

} // namespace

TEST_CASE("LAMMPS' data has sections and bonds by numbers of atoms") {
    const std::string text = "a remark\n\n3 atoms\n2 bonds\n2 atom types\n\n"
                             "0 10 xlo xhi\n0 11 ylo yhi\n0 12 zlo zhi\n1 0 0 xy xz yz\n\n"
                             "Masses\n\n1 15.9994 # O\n2 1.008\n\n"
                             "Atoms # full\n\n10 1 1 -0.8 1 2 3 0 0 0\n30 1 2 0.4 4 5 6\n"
                             "20 1 2 0.4 7 8 9\n\nVelocities\n\n10 0 0 0\n\n"
                             "Bonds\n\n1 1 10 20\n2 1 30 10\n";
    const Structure frame = read(text).frame;
    CHECK(elements_of(frame) == "O H H ");
    CHECK(frame.positions[1] == Vec3f(4, 5, 6));
    CHECK(frame.cell.edges[1] == Vec3d(1, 11, 0));
    REQUIRE(frame.bonds.size() == 2);
    CHECK(frame.bonds[0].b == 2);
    CHECK(frame.bonds[1].b == 1);
    CHECK(values_of(frame, "charge") == std::vector{-0.8F, 0.4F, 0.4F});
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string changed = text;
        changed.replace(changed.find(what), what.size(), instead);
        return changed;
    };
    CHECK(read(with("Atoms # full", "Atoms")).frame.positions[1] == Vec3f(4, 5, 6));
    CHECK(elements_of(read(with("15.9994", "0.3")).frame) == "X X X ");
    CHECK(refusal(with("3 atoms", "4 atoms")) == "a:32: must have 4 atoms, got 3");
    CHECK(refusal(with("1 1 10 20", "1 1 10 21")) ==
          "a:29:8: must be the number of an atom, got unknown 21");
    CHECK(refusal(with("30 1 2", "10 1 2")) ==
          "a:20: must be an atom with a new number, got 10 again");
    CHECK(refusal(with("Velocities\n\n10 0", "Atoms # charge\n\n40 0")) ==
          "a:23: must not be a second section Atoms");
    CHECK(refusal(with("Velocities", "velocities")).find("must be a section's name") !=
          std::string::npos);
}

TEST_CASE("LAMMPS' data of each atom style is read with and without image flags") {
    const auto styles = atom_style_names();
    for (const char* owed :
         {"angle",  "atomic",       "body", "bond", "bpm/sphere", "charge",     "dielectric",
          "dipole", "dpd",          "edpd", "full", "electron",   "ellipsoid",  "hybrid",
          "line",   "mdpd",         "peri", "rheo", "molecular",  "smd",        "sph",
          "sphere", "rheo/thermal", "spin", "tdpd", "template",   "wavepacket", "tri"}) {
        CAPTURE(owed);
        CHECK(std::find(styles.begin(), styles.end(), owed) != styles.end());
    }
    for (const std::string_view style : styles)
        for (const AtomLayout& layout : layouts_of(style))
            for (const bool with_images : {false, true}) {
                if (with_images && layout.is_open) continue;
                CAPTURE(style, layout.columns.size(), with_images);
                const std::string atoms = atoms_of(layout, with_images);
                const std::string named = "Atoms # " + std::string(style);
                const Structure frame = read(data("2 atom types", named, atoms)).frame;
                CHECK(frame.positions == places);
                CHECK(types_of(frame) == "1 2 2 ");
                CHECK(read(data("2 atom types", "Atoms", atoms), std::string(style))
                          .frame.positions == places);
            }
}

TEST_CASE("the sub-styles of hybrid add their columns once") {
    const std::string atoms = "1 1 2.5 3.5 4.5 0.5 7 8 9 3 1.5 2\n";
    for (const std::string style :
         {"hybrid dipole full sphere", "hybrid dipole/kk full sphere 1"}) {
        const Structure frame = read(data("1 atom types", "Atoms # " + style, atoms)).frame;
        CHECK(frame.positions == std::vector{Vec3f(2.5F, 3.5F, 4.5F)});
        CHECK(values_of(frame, "charge") == std::vector{0.5F});
        CHECK(values_of(frame, "muz") == std::vector{9.0F});
        CHECK(values_of(frame, "molecule") == std::vector{3.0F});
        CHECK(frame.radii == std::vector{0.75F});
    }
    const Reading unnamed = read(data("1 atom types", "Atoms # hybrid", atoms));
    CHECK(unnamed.frame.positions == std::vector{Vec3f(2.5F, 3.5F, 4.5F)});
    CHECK(unnamed.remarks.size() == 1);
    CHECK(read(data("1 atom types", "Atoms", "1 1 1 2 3 7 8 1.5 1\n"), "hybrid tdpd 2 sphere")
              .frame.radii == std::vector{0.75F});
    CHECK(
        read(data("1 atom types", "Atoms", "1 1 1 2 3 1 9 1\n"), "hybrid body nparticle 2 5 charge")
            .frame.positions[0] == Vec3f(1, 2, 3));
    CHECK(refusal(data("1 atom types", "Atoms", atoms), "hybrid dipole ful") ==
          "--atom-style: must be an atom style of LAMMPS, such as atomic, charge, molecular, full, "
          "sphere, or hybrid with its sub-styles, got \"hybrid dipole ful\"");
    CHECK(refusal(data("1 atom types", "Atoms", atoms), "fulll")
              .ends_with("got \"fulll\", did you mean \"full\"?"));
}

TEST_CASE("an atom style without a name follows from the columns") {
    // Every style whose columns differ from those of a more usual one.
    for (const auto& [style, counts] : std::vector<std::pair<std::string, std::string>>{
             {"atomic", "2 atom types"},
             {"charge", "2 atom types"},
             {"full", "2 atom types"},
             {"molecular", "2 atom types\n2 bonds"},
             {"sphere", "2 atom types"},
             {"dipole", "2 atom types"},
             {"electron", "2 atom types"},
             {"spin", "2 atom types"},
             {"ellipsoid", "2 atom types\n3 ellipsoids"},
             {"body", "2 atom types\n3 bodies"},
             {"line", "2 atom types\n3 lines"},
             {"tri", "2 atom types\n3 triangles"},
             {"bpm/sphere", "2 atom types\n2 bonds"},
             {"sph", "2 atom types"},
             {"smd", "2 atom types"},
             {"dielectric", "2 atom types"},
             {"template", "2 atom types"},
             {"wavepacket", "2 atom types"}})
        for (const bool with_images : {false, true}) {
            CAPTURE(style, with_images);
            const Structure frame =
                read(data(counts, "Atoms", atoms_of(layouts_of(style)[0], with_images))).frame;
            CHECK(frame.positions == places);
            CHECK(types_of(frame) == "1 2 2 ");
        }
    const Structure grains =
        read(data("1 atom types", "Atoms",
                  "1 1 2.0 2500 2 2 2\n2 1 1.0 2500 5 2 2\n3 1 3.0 2500 2 7 2\n"))
            .frame;
    CHECK(grains.radii == std::vector{1.0F, 0.5F, 1.5F});
    // Disks of diameter 1 and density 1, and the same lines with masses of types.
    const std::string disks = "1 1 1 1 14.5 1.5 0\n2 1 1 1 15.5 2.5 0\n";
    CHECK(read(data("1 atom types", "Atoms", disks)).frame.radii == std::vector{0.5F, 0.5F});
    CHECK(values_of(read(data("1 atom types", "Masses\n\n1 12.011\n\nAtoms", disks)).frame,
                    "molecule") == std::vector{1.0F, 1.0F});
    // Molecules 1 to 4, of two types.
    CHECK(types_of(read(data("2 atom types", "Atoms",
                             "1 1 1 1 1 1\n2 2 2 5 1 1\n3 3 1 1 5 1\n4 4 2 5 5 1\n"))
                       .frame) == "1 2 1 2 ");
    // Charges that look like types, and molecules that do not.
    CHECK(types_of(read(data("2 atom types", "Atoms", "1 1 -1 1 1 1\n2 2 1 5 1 1\n")).frame) ==
          "1 2 ");
    // One atom in a cell, with flags that may be a position.
    CHECK(read(data("1 atom types", "Atoms", "1 1 2.5 3.5 4.5 0 0 0\n")).frame.positions[0] ==
          Vec3f(2.5F, 3.5F, 4.5F));
    // Atoms of whole molecules that leave the box.
    CHECK(read(data("1 atom types", "Atoms", "1 1 0.5 -3.5 4.5 12.5\n2 1 -0.5 5.5 4.5 0.5\n"))
              .frame.positions[0] == Vec3f(-3.5F, 4.5F, 12.5F));
    CHECK(read(data("1 atom types", "Atoms", "1 1 1 2 300\n")).frame.positions[0].z == 300.0F);
}

TEST_CASE("an atom style that may be one of two must be named") {
    const std::string text =
        data("2 atom types", "Atoms", "1 1 2 1.5 1.5 1.5\n2 2 1 5.5 1.5 1.5\n");
    CHECK(refusal(text) == "a:9: must name its atom style, as in \"Atoms # full\" or by "
                           "--atom-style: it can be charge or molecular");
    CHECK(types_of(read(text, "charge").frame) == "1 2 ");
    CHECK(types_of(read(text, "bond").frame) == "2 1 ");
    // Both styles give the same drawing here.
    CHECK_NOTHROW(read(data("2 atom types", "Atoms", "1 1 1 1.5 1.5 1.5\n2 2 2 5.5 1.5 1.5\n")));
    CHECK(refusal(data("1 atom types", "Atoms",
                       "1 1 2.5 3.5 4.5 1.5 0.5\n2 1 6.5 3.25 5.5 1.5 0.5\n")) ==
          "a:9: must name its atom style, as in \"Atoms # full\" or by --atom-style: no style "
          "without sub-styles fits its 7 columns");
}

TEST_CASE("the columns of a named atom style are checked") {
    const std::string atoms = "1 1 0.5 1 2 3\n";
    CHECK(refusal(data("1 atom types", "Atoms # full", atoms)) ==
          "a:9: must name its atom style, as in \"Atoms # full\" or by --atom-style: atom style "
          "full has 7 columns, or 10 with image flags, got 6");
    CHECK(refusal(data("1 atom types", "Atoms", atoms), "molecular") ==
          "a:11:5: an atom type must be a label or a whole number from 1 to 1, got \"0.5\"");
    CHECK(refusal(data("1 atom types", "Atoms # charge", "1 2 0.5 1 2 3\n")) ==
          "a:11:3: an atom type must be a label or a whole number from 1 to 1, got 2");
    CHECK(refusal(data("1 atom types", "Atoms # charge", "1 1 0.5 1 x 3\n")) ==
          "a:11:11: a coordinate must be a number, got \"x\"");
    CHECK(refusal(data("1 atom types", "Atoms # charge", "1 1 0.5 1 nan 3\n")) ==
          "a:11:11: a coordinate must be a number, got \"nan\"");
    CHECK(refusal(data("1 atom types", "Atoms # charge", "1 1 0.5 1 2 -2e30\n")) ==
          "a:11:13: a coordinate must be from -1e30 to 1e30");
    CHECK(refusal(data("1 atom types", "Atoms # charge", "1 1 0.5 1 2 3 0 0 0.5\n")) ==
          "a:11:19: an image flag must be a whole number, got \"0.5\"");
    CHECK(refusal(data("1 atom types", "Atoms # full", "1 0.5 1 1 2 3 4\n")) ==
          "a:11:3: molecule must be a whole number, got \"0.5\"");
    // The option takes precedence over the remark.
    CHECK(read(data("1 atom types", "Atoms # full", atoms), "charge").frame.positions[0] ==
          Vec3f(1, 2, 3));
}

TEST_CASE("a section's remark that is not an atom style is reported and ignored") {
    const Reading reading = read(data("1 atom types", "Atoms # id type x y z", "1 1 1 2 3\n"));
    CHECK(reading.frame.positions[0] == Vec3f(1, 2, 3));
    CHECK(reading.remarks ==
          std::vector<std::string>{
              "a:9: \"id type x y z\" is not an atom style: the atoms are read as atomic"});
    CHECK(read(data("1 atom types", "Atoms", "1 1 1 2 3\n")).remarks.empty());
    // LAMMPS skips the line behind a section's name.
    std::string text = data("1 atom types", "Atoms", "1 1 1 2 3 # salt\n");
    text.replace(text.find("Atoms\n"), 6, "Atoms\natom-ID atom-type x y z\n");
    CHECK(read(text).frame.positions[0] == Vec3f(1, 2, 3));
}

TEST_CASE("LAMMPS' data may have a general triclinic box") {
    const Structure frame =
        read("a remark\n\n1 atoms\n1 atom types\n0.0 3.0 0.0 avec\n3.0 0.0 0.0 bvec\n"
             "0.0 0.0 -3.0 cvec\n1.0 2.0 3.0 abc origin\n\nAtoms\n\n1 1 2.5 3.5 1.5\n")
            .frame;
    CHECK(frame.cell.edges == std::array{Vec3d(0, 3, 0), Vec3d(3, 0, 0), Vec3d(0, 0, -3)});
    CHECK(frame.cell.origin == Vec3d(1, 2, 3));
    CHECK(frame.positions[0] == Vec3f(2.5F, 3.5F, 1.5F));
    const Structure flat =
        read("a remark\n\n1 atoms\n3 1 0 avec\n\nAtoms\n\n1 1 2.5 3.5 0\n").frame;
    CHECK(flat.cell.edges == std::array{Vec3d(3, 1, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)});
}

TEST_CASE("words of a header and of sections may have any blanks between them") {
    const std::string text =
        "a remark\n\n1\t atoms\n2 atom \t types # two\n0  5 xlo  xhi\n0 6 ylo\tyhi\n"
        "0 7 zlo zhi\n1 2 3\txy  xz\tyz\n\nPair  Coeffs\n\n1 1.0\n\n"
        "Atoms\n\n1 1 3 1.5 2.5 3.5\n";
    const Structure frame = read(text).frame;
    CHECK(frame.cell.edges == std::array{Vec3d(5, 0, 0), Vec3d(1, 6, 0), Vec3d(2, 3, 7)});
    CHECK(types_of(frame) == "1 ");
    CHECK(values_of(frame, "charge") == std::vector{3.0F}); // 3 is not a type
    const Cell general = read("a\n\n1 atoms\n1 0 0  avec\n0 2 0\tbvec\n0 0 3 cvec\n"
                              "4 5 6 abc  origin\n\nAtoms # atomic\n\n1 1 0 0 0\n")
                             .frame.cell;
    CHECK(general.edges[1] == Vec3d(0, 2, 0));
    CHECK(general.origin == Vec3d(4, 5, 6));
}

TEST_CASE("labels of types may begin with any letter and do not end a section") {
    const std::string rest = "\nBonds\n\n1 OW-HW 1 2\n2 OW-HW 1 3\n";
    const std::string labels = "Atom Type Labels\n\n1 OW\n2 HW\n3 C_3\n\nBond Type Labels\n\n"
                               "1 OW-HW\n\nMasses\n\nOW 15.999\nHW 1.008\n3 12.011\n\n"
                               "Pair Coeffs # lj/cut\n\nOW 0.15 3.15\nHW 0 0\n\n"
                               "Bond Coeffs # harmonic\n\nOW-HW 450 1.0\n\n";
    for (const std::string section : {"Atoms", "Atoms # full"}) {
        const Structure frame =
            read(data("3 atom types\n2 bonds", labels + section,
                      "1 1 OW -0.8 5 5 5\n2 1 HW 0.4 5.96 5 5\n3 1 2 0.4 4.76 5.93 5\n"
                      "4 1 C_3 0 1 1 1\n",
                      rest))
                .frame;
        CHECK(types_of(frame) == "OW HW HW C_3 ");
        CHECK(elements_of(frame) == "O H H C ");
        CHECK(frame.bonds.size() == 2);
    }
}

TEST_CASE("atoms in reduced units and united atoms have no element") {
    const auto elements = [](const std::string& title, const std::string& masses) {
        std::string text = data("2 atom types", "Masses\n\n" + masses + "\nAtoms # atomic",
                                "1 1 0 0 0\n2 2 1.1 0 0\n");
        text.replace(0, text.find('\n'), title);
        return elements_of(read(text).frame);
    };
    CHECK(elements("a remark", "1 1.0\n2 1.0\n") == "X X ");
    CHECK(elements("a remark", "1 14.027\n2 15.035\n") == "X X ");
    CHECK(elements("a remark", "1 12.011\n2 1.0\n") == "C H ");
    const std::string by_lammps = "LAMMPS data file via write_data, timestep = 0, units = ";
    CHECK(elements(by_lammps + "metal", "1 28\n2 28\n") == "Si Si ");
    CHECK(elements(by_lammps + "lj", "1 15.9994\n2 1.008\n") == "X X ");
}

TEST_CASE("electrons beside nuclei are not hydrogen") {
    const std::string masses = "Masses\n\n1 6.941\n2 1.0\n\nAtoms",
                      nuclei = "1 1 3.0 0 0.0 1.5 2 3\n";
    CHECK(
        elements_of(read(data("2 atom types", masses, nuclei + "2 2 0.0 1 1.5 4.5 5 6\n")).frame) ==
        "Li X ");
    const std::string real = "Masses\n\n1 6.941\n2 0.00054466\n\nAtoms # electron";
    CHECK(elements_of(read(data("2 atom types", real, nuclei + "2 2 0.0 1 1.5 4.5 5 6\n")).frame) ==
          "Li X ");
    CHECK(elements_of(
              read(data("2 atom types", masses + " # charge", "1 1 3.0 1.5 2 3\n2 2 0.0 4.5 5 6\n"))
                  .frame) == "Li H ");
}

TEST_CASE("the older columns of spin are read where they fit better") {
    CHECK(read(data("1 atom types", "Atoms # spin",
                    "1 1 1.72 0.5 1.5 2.5 0.6 0.8 0.0\n2 1 1.72 3.5 4.5 5.5 -0.8 0.6 0.0\n"))
              .frame.positions == std::vector{Vec3f(0.5F, 1.5F, 2.5F), Vec3f(3.5F, 4.5F, 5.5F)});
}

TEST_CASE("ellipsoids have their diameters along axes that a quaternion turns") {
    const std::string rest = "\nEllipsoids\n\n1 2 4 6 2 0 0 2\n3 0 0 0 1 0 0 0\n";
    const std::string text = data("1 atom types\n2 ellipsoids", "Atoms",
                                  "1 1 1 1.5 2.5 3.5 4.5\n2 1 0 1.5 6.5 3.5 4.5\n"
                                  "3 1 1 1.5 8.5 3.5 4.5\n",
                                  rest);
    const Structure frame = read(text).frame;
    REQUIRE(frame.shapes.size() == 1);
    CHECK(frame.shapes[0].atom == 0);
    CHECK(frame.radii == std::vector{3.0F, 0.0F, 0.0F});
    const auto near = [](const Vec3f& a, const Vec3f& b) {
        return raylane::core::length(a - b) < 1e-6F;
    };
    // Turned by a right angle about z.
    CHECK(near(frame.shapes[0].axes[0], {0, 1, 0}));
    CHECK(near(frame.shapes[0].axes[1], {-2, 0, 0}));
    CHECK(near(frame.shapes[0].axes[2], {0, 0, 3}));
    const raylane::core::Scene scene = parse_scene("a.data", text);
    CHECK(scene.shape_count() == 3);
    CHECK(std::get<raylane::core::Table<raylane::core::Ellipsoid>>(scene.shapes()).size() == 1);
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string changed = text;
        changed.replace(changed.find(what), what.size(), instead);
        return changed;
    };
    CHECK(refusal(with("2 0 0 2", "0 0 0 0"))
              .ends_with("must be a quaternion of a length above zero"));
    CHECK(refusal(with("2 4 6", "-2 4 6")).ends_with("a diameter must not be negative"));
    CHECK(refusal(with("\n1 2 4 6", "\n7 2 4 6"))
              .ends_with("must be the number of an atom, got unknown 7"));
}

TEST_CASE("an atom style is refused for other files than LAMMPS' data") {
    const LoadOptions options{.atom_style = "full"};
    CHECK(message_of<BadInput>([&] { parse_scene("a.xyz", "1\n\nC 0 0 0\n", options); }) ==
          "--atom-style: goes with a LAMMPS data file, but a.xyz is not one");
    CHECK(parse_scene("a.data", data("1 atom types", "Atoms", "1 1 1 0.5 1 2 3\n"), options)
              .shape_count() == 1);
}
