#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/readers.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace raylane::scenes;
using namespace raylane::tests;
using raylane::core::Vec3d;
using raylane::core::Vec3f;

/// Tests of crystals of small molecules in CIF.
namespace {

const std::string cube = "data_a\n_cell_length_a 10\n_cell_length_b 10\n_cell_length_c 10\n"
                         "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n";

/// Returns a table of sites. Each line has a label, an element and coordinates.
std::string sites(const std::string& lines) {
    return "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n"
           "_atom_site_fract_y\n_atom_site_fract_z\n" +
           lines;
}

/// Returns the positions in angstrom, rounded to whole numbers.
std::string places_of(const Structure& structure) {
    std::string text;
    for (const Vec3f& at : structure.positions) {
        for (int axis = 0; axis < 3; ++axis)
            text += std::to_string(std::lround(at[axis])) + " ";
        text.back() = '\n';
    }
    return text;
}

} // namespace

TEST_CASE("CIF of a crystal gives all atoms of its cell") {
    if (!has_gemmi()) return;
    const std::string text =
        "data_salt\n_cell_length_a 5.64\n_cell_length_b 5.64\n_cell_length_c 5.64\n"
        "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
        "_symmetry_space_group_name_H-M 'F m -3 m'\n"
        "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
        "Na1 0 0 0\nCl1 0.5 0.5 0.5\n";
    const Structure frame = frames(open_cif, text).at(0);
    CHECK(elements_of(frame) == "Na Na Na Na Cl Cl Cl Cl ");
    CHECK(frame.cell.edges[0].x == Approx(5.64));
    CHECK(complaint(open_cif, "data_a\nloop_\n_x\n_y\n1\n").starts_with("a:"));
    CHECK(complaint(open_cif, "data_a\n_x 1\n") == "a: must have a table _atom_site, got none");
}

TEST_CASE("a crystal's operations follow from Hall's symbol and from many kinds of names") {
    if (!has_gemmi()) return;
    const auto count_of = [](const std::string& symmetry, const std::string& place) {
        return frames(open_cif, cube + symmetry + "\n" + sites("C1 C " + place)).at(0).size();
    };
    const auto named = [&](const std::string& name) {
        return count_of("_symmetry_space_group_name_H-M '" + name + "'", "0.05 0.13 0.22");
    };
    CHECK(count_of("_space_group_name_Hall '-F 4vw 2vw 3'", "0.125 0.125 0.125") == 8);
    CHECK(count_of("_space_group_name_Hall 'no such'\n_symmetry_space_group_name_H-M 'P -1'",
                   "0.05 0.13 0.22") == 2);
    CHECK(named("F m -3 m") == 192);
    CHECK(named("F m 3 m") == 192);
    CHECK(named("F 4/m -3 2/m") == 192);
    CHECK(named("R -3 c H") == 36);
    CHECK(named("P2(1)/c") == 4);
    CHECK(named("P 2_1 2_1 2_1") == 4);
    CHECK(named("P 1 21/c 1 (b)") == 4);
    CHECK(count_of("_symmetry_space_group_name_H-M 'F d -3 m S'", "0.02 0.07 0.15") == 192);
    CHECK(count_of("_symmetry_space_group_name_H-M 'F d -3 m Z'", "0.125 0.125 0.125") == 8);
    CHECK(count_of("loop_\n_symmetry_equiv_pos_as_xyz\nX,Y,Z\n'-X, 0.5-Y, Z+.25'",
                   "0.05 0.13 0.22") == 2);
}

TEST_CASE("groups of disordered atoms exclude each other") {
    if (!has_gemmi()) return;
    const std::string text = cube + "loop_\n_atom_site_label\n_atom_site_type_symbol\n"
                                    "_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
                                    "_atom_site_disorder_assembly\n_atom_site_disorder_group\n"
                                    "C1 C 0.1 0.1 0.1 . .\nC2A C 0.2 0.1 0.1 A 1\n"
                                    "N2B N 0.22 0.1 0.1 A 2\nO3 O 0.5 0.5 0.5 B 2\n";
    CHECK(elements_of(frames(open_cif, text).at(0)) == "C C O ");
}

TEST_CASE("of elements that share a site the one of the highest occupancy is shown") {
    if (!has_gemmi()) return;
    std::vector<std::string> remarks;
    const auto elements = [&](const std::string& sites) {
        remarks.clear();
        return elements_of(frames(open_cif,
                                  cube +
                                      "loop_\n_atom_site_label\n_atom_site_occupancy\n"
                                      "_atom_site_fract_x\n_atom_site_fract_y\n"
                                      "_atom_site_fract_z\n" +
                                      sites,
                                  &remarks)
                               .at(0));
    };
    CHECK(elements("Mg1 0.3 0 0 0\nFe1 0.7 0 0 0\nO1 1 .5 0 0\nMg2 .5 .5 .5 0\nFe2 .5 .5 .5 0\n") ==
          "Fe O Mg ");
    CHECK(remarks == std::vector<std::string>{"a: different elements share a site (Mg1 and Fe1): "
                                              "only the one of the highest occupancy is rendered"});
    CHECK(elements("C1A 0.4 0 0 0\nC1B 0.6 0 0 0\n") == "C ");
    CHECK(remarks.empty());
}

TEST_CASE("images of a negative disorder group exclude each other where they meet") {
    if (!has_gemmi()) return;
    const auto elements = [](const std::string& group, const std::string& sites) {
        return elements_of(frames(open_cif, cube + "_symmetry_space_group_name_H-M '" + group +
                                                "'\nloop_\n_atom_site_label\n_atom_site_fract_x\n"
                                                "_atom_site_fract_y\n_atom_site_fract_z\n"
                                                "_atom_site_disorder_group\n" +
                                                sites)
                               .at(0));
    };
    const std::string across_middle = "C1 .53 .5 .5 -1\nC2 .55 .64 .5 -1\nO1 .45 .63 .58 -1\n";
    CHECK(elements("P -1", across_middle) == "C C O ");
    CHECK(elements("I -1", across_middle) == "C C C C O O ");              // one on each centre
    CHECK(elements("P -1", "C1 .03 0 0 -1\nO1 .03 .12 0 -1\n") == "C O "); // at the cell's corner
    CHECK(elements("P -1", "Fe .5 .5 .5 .\nO1 .6 .65 .5 -1\nO2 .6 .6 .6 -1\n") == "Fe O O O O ");
    CHECK(elements("P -1", "C1 .2 .3 .1 -1\n") == "C C ");
}

TEST_CASE("a crystal's displacements have the axes of its positions") {
    if (!has_gemmi()) return;
    // Isotropic, 0.05 angstrom^2, in an oblique cell: U13 is the part of the angle's cosine.
    // In a cell with a fourfold axis, the image has U11 and U22 exchanged.
    const std::string leaning = "data_a\n_cell_length_a 10\n_cell_length_b 8\n_cell_length_c 9\n"
                                "_cell_angle_alpha 90\n_cell_angle_beta 120\n_cell_angle_gamma 90\n"
                                "_symmetry_space_group_name_H-M 'P 1'\n";
    const std::string fourfold = "data_b\n_cell_length_a 10\n_cell_length_b 10\n_cell_length_c 9\n"
                                 "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
                                 "_symmetry_space_group_name_H-M 'P 4'\n";
    const std::string sites =
        "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n"
        "_atom_site_fract_y\n_atom_site_fract_z\n"
        "O1 O 0.1 0.2 0.3\nC2 C 0.4 0.1 0.6\n"
        "loop_\n_atom_site_aniso_label\n_atom_site_aniso_U_11\n"
        "_atom_site_aniso_U_22\n_atom_site_aniso_U_33\n_atom_site_aniso_U_12\n"
        "_atom_site_aniso_U_13\n_atom_site_aniso_U_23\n";
    const auto check = [](const Anisotropy& anisotropy, AtomIndex atom,
                          const std::array<double, 6>& u) {
        CHECK(anisotropy.atom == atom);
        for (std::size_t k = 0; k < u.size(); ++k) {
            CAPTURE(k);
            CHECK(static_cast<double>(anisotropy.u[k]) == Approx(u[k]).margin(1e-8));
        }
    };
    // The angle between the reciprocal edges a* and c* is 60 degrees.
    const Structure one = frames(open_cif, leaning + sites + "C2 0.05 0.05 0.05 0 0.025 0\n").at(0);
    REQUIRE(one.anisotropies.size() == 1);
    check(one.anisotropies[0], 1, {0.05, 0.05, 0.05, 0.0, 0.0, 0.0});
    const Structure turned =
        frames(open_cif, fourfold + sites + "O1 0.01 0.04 0.02 0.003 0.002 0.001\n").at(0);
    REQUIRE(turned.anisotropies.size() == 4);
    int quarter_turns = 0;
    for (const Anisotropy& anisotropy : turned.anisotropies) {
        const Vec3f at = turned.positions[anisotropy.atom];
        if (std::abs(std::abs(at.x - 5.0F) - 3.0F) > 1e-4F) continue; // at 8 or 2
        ++quarter_turns;
        const double way = at.x > 5.0F ? 1.0 : -1.0; // x, y -> -y, x, or y, -x
        check(anisotropy, anisotropy.atom, {0.04, 0.01, 0.02, -0.003, -way * 0.001, way * 0.002});
    }
    CHECK(quarter_turns == 2);
    CHECK(turned.names.at(0) == "O1");
}

TEST_CASE("a crystal has the operations of symmetry of its file or of its space group") {
    if (!has_gemmi()) return;
    const auto atoms = [](const std::string& symmetry) {
        return places_of(frames(open_cif, cube + symmetry + sites("O1 O 0.1 0.2 0.3\n")).at(0));
    };
    const std::string inverted = "1 2 3\n9 8 7\n";
    CHECK(atoms("loop_\n_space_group_symop_operation_xyz\nx,y,z\n-x,-y,-z\n") == inverted);
    CHECK(atoms("loop_\n_symmetry_equiv_pos_as_xyz\n'x, y, z'\n'-x, -y, -z'\n"
                "_symmetry_space_group_name_H-M 'P 1'\n") == inverted);
    CHECK(atoms("_symmetry_space_group_name_H-M 'P -1'\n") == inverted);
    CHECK(atoms("_symmetry_space_group_name_H-M ?\n_space_group_IT_number 2\n") == inverted);
    CHECK(atoms("") == "1 2 3\n");
    CHECK(atoms("_space_group_name_Hall '-P 1'\nloop_\n_space_group_symop_operation_xyz\n?\n") ==
          inverted);
    const auto error = [](const std::string& symmetry) {
        return complaint(open_cif, cube + symmetry + sites("O1 O 0.1 0.2 0.3\n"));
    };
    CHECK(error("_symmetry_space_group_name_H-M 'P foo'\n") ==
          "a: space group \"P foo\" is unknown, and the file has no operations of symmetry");
    CHECK(error("loop_\n_space_group_symop_operation_xyz\nx,y,z\n-x,-y,-q\n").starts_with("a: "));
    std::string many = "loop_\n_symmetry_equiv_pos_as_xyz\n";
    for (int i = 0; i < 193; ++i)
        many += "'x+" + std::to_string(i % 24) + "/24,y+" + std::to_string(i / 24) + "/24,z'\n";
    CHECK(complaint(open_cif, cube + many + sites("C1 C 0.1 0.2 0.3\n")) ==
          "a: must have at most 192 operations of symmetry, got 193");
}

TEST_CASE("a remark names a space group that is taken by its number alone") {
    if (!has_gemmi()) return;
    const auto remarks = [](const std::string& name) {
        std::vector<std::string> lines;
        frames(open_cif,
               cube + "_symmetry_space_group_name_H-M " + name +
                   "\n_symmetry_Int_Tables_number 15\n" + sites("O1 O 0.1 0.2 0.3\n"),
               &lines);
        return lines;
    };
    CHECK(remarks("'P foo'") ==
          std::vector<std::string>{"a: the space group \"P foo\" is unknown: number 15 is used in "
                                   "its standard setting, C 1 2/c 1"});
    CHECK(remarks("'I 1 2/a 1'").empty());
    CHECK(remarks("?").empty());
}

TEST_CASE("molecules of a crystal stay together with their middles in the cell") {
    if (!has_gemmi()) return;
    const Structure frame =
        frames(open_cif, cube + "loop_\n_space_group_symop_operation_xyz\nx,y,z\n-x,-y,-z\n" +
                             sites("C1 C 0.4 0.1 0.1\nO1 O 0.4 0.1 0.0\nNa Na -0.2 0.5 1.5\n"))
            .at(0);
    // Carbon monoxide. Its image's middle is at z = -0.5 before it is moved by a cell's length.
    CHECK(places_of(frame) == "4 1 1\n6 9 9\n4 1 0\n6 9 10\n8 5 5\n2 5 5\n");
}

TEST_CASE("a crystal without a cell or with invalid coordinates is refused") {
    if (!has_gemmi()) return;
    CHECK(complaint(open_cif, "data_a\n" + sites("O1 O 0.1 0.2 0.3\n")) ==
          "a: must have a cell (_cell_length_a, ...), because its coordinates are fractions of it");
    std::string damaged = cube + sites("O1 O 0.1 0.2 0.3\n");
    damaged.replace(damaged.find("_b 10"), 5, "_b 1z");
    CHECK(complaint(open_cif, damaged).starts_with("a: must have a cell"));
    CHECK(complaint(open_cif, cube + sites("O1 O 0.1 q 0.3\n")) ==
          "a: the coordinates of O1 must be numbers, got \"q\"");
    CHECK(frames(open_cif, cube + sites("O1 O ? ? ?\nC1 C 0.1 0.2 0.3(1)\n")).at(0).size() == 1);
}

TEST_CASE("mmCIF without an author's residue numbers has those of its labels") {
    if (!has_gemmi()) return;
    const auto text = [](const std::string& columns, const std::string& values) {
        return "data_a\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
               "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n"
               "_atom_site.occupancy\n_atom_site.B_iso_or_equiv\n" +
               columns + "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n" + values;
    };
    const Structure frame =
        frames(open_cif, text("_atom_site.label_seq_id\n", "1 C CA . ALA A 1 20 7 1 2 3\n")).at(0);
    CHECK(frame.of_residue.at(0).number == 7);
    CHECK(frame.chains.at(0) == "A");
    CHECK(frames(open_cif, text("", "1 C CA . ALA A 1 20 1 2 3\n")).at(0).size() == 1);
    CHECK(
        complaint(open_cif, text("_atom_site.auth_seq_id\n", "1 C CA . ALA A 1 20 7 1 4e30 3\n")) ==
        "a: the coordinates of CA must be from -1e30 to 1e30");
    CHECK(complaint(open_cif, text("_atom_site.auth_seq_id\n", "1 C CA . ALA A 1 20 7 1 x 3\n")) ==
          "a: the coordinates of atom 1 must be numbers, got \"x\"");
}

TEST_CASE("an atom with an isotropic displacement alone is a sphere beside ellipsoids") {
    if (!has_gemmi()) return;
    const Structure frame =
        frames(open_cif, cube + "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n"
                                "_atom_site_fract_z\n_atom_site_U_iso_or_equiv\nCl1 .1 .1 .1 .05\n"
                                "Sn1 .5 .5 .5 0.0345(5)\nH1 .8 .8 .8 .\n"
                                "loop_\n_atom_site_aniso_label\n_atom_site_aniso_U_11\n"
                                "_atom_site_aniso_U_22\n_atom_site_aniso_U_33\n"
                                "_atom_site_aniso_U_12\n_atom_site_aniso_U_13\n"
                                "_atom_site_aniso_U_23\nCl1 .1 .1 .2 0 0 0\n")
            .at(0);
    CHECK(frame.isotropies.size() == 3);
    const Drawing drawing{.style = Style::balls, .ellipsoids = Ellipsoids::plain};
    const raylane::core::Scene scene = draw_structure(frame, drawing, "a");
    std::vector<double> radii;
    raylane::core::for_each_shape(
        std::get<raylane::core::Table<raylane::core::Sphere>>(scene.shapes()),
        [&](const auto& sphere, raylane::core::ShapeId) { radii.push_back(sphere.radius); });
    std::sort(radii.begin(), radii.end());
    REQUIRE(radii.size() == 2);
    CHECK(radii[0] == Approx(0.285703)); // of tin
    CHECK(radii[1] == Approx(0.3));      // of hydrogen: a ball
}

TEST_CASE("B of a crystal's displacements is divided by 8 pi squared") {
    if (!has_gemmi()) return;
    const Structure frame =
        frames(open_cif, cube + sites("O1 O 0.1 0.2 0.3\n") +
                             "loop_\n_atom_site_aniso_label\n_atom_site_aniso_B_11\n"
                             "_atom_site_aniso_B_22\n_atom_site_aniso_B_33\n"
                             "_atom_site_aniso_B_12\n_atom_site_aniso_B_13\n"
                             "_atom_site_aniso_B_23\nO1 1 2 3 0 0 0\n")
            .at(0);
    REQUIRE(frame.anisotropies.size() == 1);
    CHECK(frame.anisotropies[0].u[2] == Approx(3 / (8 * 9.8696044)));
}
