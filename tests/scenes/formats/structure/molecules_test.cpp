#include "scenes/files/errors.hpp"
#include "scenes/formats/format.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/hydrogen_bond_layer.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/structure/frames.hpp"
#include "tests/scenes/formats/structure/structures.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

/// Tests of MOL, SDF, MOL2 and PQR, and of the bonds that they have.
using namespace raylane::scenes;
using namespace raylane::tests;
using raylane::core::Vec3d;
using raylane::core::Vec3f;

namespace {

const std::string formyl = "formyl\n  own\n\n"
                           "  3  2  0  0  0  0  0  0  0  0999 V2000\n"
                           "    0.0000    0.0000    0.0000 C   0  0\n"
                           "    1.2000    0.0000    0.0000 O   0  0\n"
                           "   -0.5000    0.9000   -1.0000 Na  0  0\n"
                           "  1  2  2  0\n  3  1  1  0\n"
                           "M  CHG  1   3   1\nM  END\n";
const std::string formyl_3000 = "formyl\n\n\n"
                                "  0  0  0     0  0            999 V3000\n"
                                "M  V30 BEGIN CTAB\nM  V30 COUNTS 3 2 0 0 0\n"
                                "M  V30 BEGIN ATOM\n"
                                "M  V30 7 C 0 0 0 0\nM  V30 8 O 1.2 -\nM  V30 0 0 0\n"
                                "M  V30 9 Na -0.5 0.9 -1 0 CHG=1\n"
                                "M  V30 END ATOM\nM  V30 BEGIN BOND\n"
                                "M  V30 1 2 7 8\nM  V30 2 1 9 7\nM  V30 END BOND\n"
                                "M  V30 END CTAB\nM  END\n";

std::string bonds_of(const Structure& structure) {
    std::string text;
    for (const Bond& bond : structure.bonds)
        text += std::to_string(bond.a) + "-" + std::to_string(bond.b) + ":" +
                std::to_string(bond.order) + " ";
    return text;
}

/// Returns a hexagon of carbon, at 1.4 angstrom, with aromatic bonds, as MOL.
std::string benzene() {
    std::string text = "ring\n\n\n  6  6  0  0  0  0  0  0  0  0999 V2000\n";
    for (int i = 0; i < 6; ++i) {
        char line[80];
        std::snprintf(line, sizeof line, "%10.4f%10.4f%10.4f C   0  0\n",
                      1.4 * std::cos(i * std::numbers::pi / 3),
                      1.4 * std::sin(i * std::numbers::pi / 3), 0.0);
        text += line;
    }
    for (int i = 1; i <= 6; ++i)
        text += "  " + std::to_string(i) + "  " + std::to_string(i % 6 + 1) + "  4  0\n";
    return text + "M  END\n";
}

using Stick = raylane::core::InDouble<raylane::core::CappedCylinder>;

/// Returns the sticks of a molecule in a style.
std::vector<Stick> sticks_of(const std::string& name, const std::string& text,
                             const Drawing& drawing) {
    LoadOptions options;
    options.drawing = drawing;
    std::vector<Stick> sticks;
    const raylane::core::Scene scene = parse_scene(name, text, options);
    raylane::core::for_each_shape(
        std::get<raylane::core::Table<raylane::core::CappedCylinder>>(scene.shapes()),
        [&](const auto& stick, raylane::core::ShapeId) { sticks.push_back(stick); });
    return sticks;
}

} // namespace

TEST_CASE("MOL of both versions has atoms, charges, and bonds with orders") {
    for (const std::string& text : {formyl, formyl_3000}) {
        const Structure frame = frames(open_mol, text).at(0);
        CHECK(frame.title == "formyl");
        CHECK(elements_of(frame) == "C O Na ");
        CHECK(frame.positions[2] == Vec3f(-0.5F, 0.9F, -1.0F));
        CHECK(bonds_of(frame) == "0-1:2 0-2:1 ");
        CHECK(frame.has_all_bonds);
        CHECK(frame.properties.at(0).name == "charge");
        CHECK(frame.properties.at(0).values == std::vector<float>{0, 0, 1});
    }
    const Structure ring = frames(open_mol, benzene()).at(0);
    CHECK(ring.bonds.size() == 6);
    CHECK(ring.bonds[0].order == Bond::aromatic);
    CHECK(find_bonds(ring).size() == 6);
}

TEST_CASE("each record of an SDF file is a frame") {
    const std::string data = "> <name>\nvalue\n\n$$$$\n";
    CHECK(frames(open_mol, formyl + data + formyl_3000 + data).size() == 2);
    CHECK(frames(open_mol, formyl + "$$$$\n" + benzene() + "$$$$\n\n\n\n\n\n").size() == 2);
    CHECK(frames(open_mol, formyl + "$$$$\n" + formyl.substr(6)).size() == 2); // no title
    CHECK(frames(open_mol, formyl + "$$$$\n" + formyl).at(1).bonds.size() == 2);
}

TEST_CASE("malformed MOL files are refused with the line") {
    CHECK(complaint(open_mol, "a\n\n") ==
          "a:3: must be the counts of atoms and bonds, got the end of the file");
    CHECK(complaint(open_mol, "a\n\n\n  x  0  V2000\n") ==
          "a:4:1: the number of atoms must be a number from 0 to 999, got \"x\"");
    CHECK(complaint(open_mol, formyl.substr(0, 80)).starts_with("a:6: "));
    std::string wrong = formyl;
    wrong.replace(wrong.find("  1  2  2"), 9, "  1  4  2");
    CHECK(complaint(open_mol, wrong) == "a:8: a bond must be between two of 3 atoms");
    wrong = formyl;
    wrong.replace(wrong.find("    1.2000"), 10, "    1.2x00");
    CHECK(complaint(open_mol, wrong) == "a:6:1: a coordinate must be a number, got \"1.2x00\"");
    CHECK(complaint(open_mol, formyl_3000.substr(0, 200)).find("END") != std::string::npos);
}

TEST_CASE("MOL2 has atoms, residues, charges, bonds with orders, and a cell") {
    const std::string text =
        "# a comment\n@<TRIPOS>MOLECULE\nligand\n 4 3 1 0 0\nSMALL\nGASTEIGER\n\n"
        "@<TRIPOS>ATOM\n"
        "  1 C1   0.0 0.0 0.0 C.ar 1 LIG12 0.25\n  2 N1  1.4 0.0 0.0 N.am 1 LIG12 -0.5\n"
        " 10 CL1  3.0 0.0 0.0 Cl   2 LIG13 0\n 11 X 9 9 9 Du\n"
        "@<TRIPOS>BOND\n 1 1 2 ar\n 2 10 2 am\n 3 1 10 2\n"
        "@<TRIPOS>CRYSIN\n 10 11 12 90 90 120 1 1\n"
        "@<TRIPOS>MOLECULE\nsecond\n1 0\n@<TRIPOS>ATOM\n1 O 1 2 3 O.3\n";
    const std::vector<Structure> read = frames(open_mol2, text);
    REQUIRE(read.size() == 2);
    const Structure& frame = read[0];
    CHECK(frame.title == "ligand");
    CHECK(elements_of(frame) == "C N Cl X ");
    CHECK(bonds_of(frame) == "0-1:4 1-2:1 0-2:2 ");
    CHECK(frame.properties.at(0).values == std::vector<float>{0.25F, -0.5F, 0, 0});
    CHECK(frame.of_residue.at(0).name == "LIG");
    CHECK(frame.of_residue.at(1).number == 13);
    CHECK(frame.cell.edges[1].x == Approx(-5.5));
    CHECK(frame.cell.edges[1].y == Approx(9.52628));
    CHECK(frame.cell.edges[2].z == Approx(12.0));
    CHECK(read[1].title == "second");
    CHECK_FALSE(read[1].has_all_bonds);
    CHECK(complaint(open_mol2, "x\n") ==
          "a:2: must be \"@<TRIPOS>MOLECULE\", got the end of the file");
    CHECK(complaint(open_mol2, "@<TRIPOS>MOLECULE\na\n@<TRIPOS>ATOM\n1 C 0 0 x C\n") ==
          "a:4:9: a coordinate must be a number, got \"x\"");
    CHECK(complaint(open_mol2, "@<TRIPOS>MOLECULE\na\n@<TRIPOS>BOND\n1 1 2 ar\n") ==
          "a:4:3: must be the number of an atom, got \"1\"");
}

TEST_CASE("PQR has a charge and a radius for each atom, with and without chains") {
    const std::string text =
        "REMARK   1 PQR\n"
        "ATOM      1  N   ALA     1      10.104  -5.5    3.125 -0.3000 1.8240\n"
        "ATOM      2  CA  ALA A   1      11.0    -5.5    3.0    0.0213 1.9080\n"
        "HETATM 3 ZN ZN A2001 1 2 3 2.0 1.1\n"
        "ATOM      4  O   HOH B   3A   -100.123-200.5001000.250 -0.8340 1.6612\n"
        "TER\nEND\n";
    const std::vector<Structure> read = frames(open_pqr, text);
    REQUIRE(read.size() == 1);
    const Structure& frame = read[0];
    CHECK(elements_of(frame) == "N C Zn O ");
    CHECK(frame.radii == std::vector<float>{1.824F, 1.908F, 1.1F, 1.6612F});
    CHECK(frame.properties.at(0).values == std::vector<float>{-0.3F, 0.0213F, 2.0F, -0.834F});
    CHECK(frame.positions[0] == Vec3f(10.104F, -5.5F, 3.125F));
    CHECK(frame.positions[3] == Vec3f(-100.123F, -200.5F, 1000.25F));
    CHECK(frame.chains == std::vector<std::string>{"", "A", "B"});
    CHECK(frame.of_residue.at(2).number == 2001);
    CHECK(frame.of_residue.at(2).is_hetero);
    CHECK(frame.of_residue.at(3).insertion == 'A');
    CHECK(frames(open_pqr, "MODEL 1\nATOM 1 N ALA 1 1 2 3 0.5 1\nENDMDL\n" + text).size() == 2);
    CHECK(complaint(open_pqr, "REMARK\n") == "a:2: must have ATOM or HETATM records, got none");
    CHECK(complaint(open_pqr, "ATOM 1 N ALA 1 1 2 3 0.5 -1\n") ==
          "a:1: a radius must be from 0 to 1e6, got \"-1\"");
    CHECK(complaint(open_pqr, "ATOM 1 N ALA 1 1 2 x 0.5 1\n") ==
          "a:1: a coordinate must be a number, got \"x\"");
    CHECK(complaint(open_pqr, "ATOM 1 N\n").starts_with("a:1: must have a charge"));
}

TEST_CASE("endings and contents decide for MOL, SDF, MOL2 and PQR") {
    const auto format = [](const std::string& name, const std::string& text) {
        InputFile file(name, text);
        return format_of(file);
    };
    CHECK(format("a.mol", "x") == Format::mol);
    CHECK(format("a.sdf", "x") == Format::mol);
    CHECK(format("a.mol2", "x") == Format::mol2);
    CHECK(format("a.pqr", "x") == Format::pqr);
    CHECK(format("-", formyl) == Format::mol);
    CHECK(format("-", formyl_3000) == Format::mol);
    CHECK(format("-", "# a\n@<TRIPOS>MOLECULE\n") == Format::mol2);
}

TEST_CASE("trajectories without elements say how to read them") {
    for (const char* const name : {"run.xtc", "run.trr", "run.dcd", "run.XTC"}) {
        InputFile file(std::string("folder/") + name, std::string("\x00\x00\x07\xcb\x00", 5));
        CHECK(message_of<BadInput>([&] { format_of(file); }) ==
              std::string("folder/") + name +
                  ": has positions without elements: in Python, "
                  "raylane.from_mdanalysis(MDAnalysis.Universe(\"topology.pdb\", \"" +
                  name + "\")) reads it with its topology");
    }
}

TEST_CASE("an aromatic bond is a stick and dashes on the inside of the ring") {
    const auto sticks = sticks_of("a.mol", benzene(), {.style = Style::sticks});
    std::size_t bonds = 0, dashes = 0;
    for (const auto& stick : sticks) {
        const Vec3d middle = stick.base + 0.5 * stick.axis;
        double outward = 0.0; // the distance from the centre, towards the middle of a bond
        for (int k = 0; k < 6; ++k) {
            const double angle = (k + 0.5) * std::numbers::pi / 3;
            outward = std::max(outward, middle.x * std::cos(angle) + middle.y * std::sin(angle));
        }
        const bool is_whole = raylane::core::length(stick.axis) > 1.0;
        ++(is_whole ? bonds : dashes);
        CHECK(outward == Approx(1.4 * std::sqrt(0.75) + (is_whole ? 0.13 : -0.13)).epsilon(1e-3));
    }
    CHECK(bonds == 6);
    CHECK(dashes == 6 * 5);
}

TEST_CASE("dashes and gaps are equal, and symmetric about the middle") {
    const auto dashes = dashes_of({1, 0, 0}, {4, 0, 0});
    CHECK(dashes.size() == 10);
    for (std::size_t k = 0; k < dashes.size(); ++k) {
        CHECK(dashes[k].second.x - dashes[k].first.x == Approx(0.15));
        CHECK(dashes[k].first.x - 1.0 == Approx(4.0 - dashes[dashes.size() - 1 - k].second.x));
    }
    CHECK(dashes_of({1, 0, 0}, {1, 0, 0}).empty());
}

TEST_CASE("hydrogen bonds need a distance and an angle") {
    const auto found = [](const std::vector<std::pair<const char*, Vec3f>>& atoms) {
        const Structure structure = of_atoms(atoms);
        return find_hydrogen_bonds(structure, find_bonds(structure));
    };
    using Pairs = std::vector<std::pair<AtomIndex, AtomIndex>>;
    const std::pair<const char*, Vec3f> oxygen = {"O", {0, 0, 0}}, hydrogen = {"H", {0.96F, 0, 0}};
    CHECK(found({oxygen, hydrogen, {"O", {3.4F, 0, 0}}}) == Pairs{{1, 2}});    // 2.44
    CHECK(found({oxygen, hydrogen, {"O", {3.5F, 0, 0}}}).empty());             // 2.54
    CHECK(found({oxygen, hydrogen, {"N", {1.9F, 1.5F, 0}}}) == Pairs{{1, 2}}); // 122 degrees
    CHECK(found({oxygen, hydrogen, {"N", {1.7F, 1.7F, 0}}}).empty());          // 114 degrees
    CHECK(found({oxygen, hydrogen, {"C", {3.0F, 0, 0}}}).empty());
    CHECK(found({{"C", {0, 0, 0}}, {"H", {1.09F, 0, 0}}, {"O", {3.2F, 0, 0}}}).empty());
    // Without hydrogen atoms: an amide and a carbonyl.
    CHECK(
        found({{"C", {-1.4F, 0, 0}}, {"N", {0, 0, 0}}, {"O", {2.9F, 0, 0}}, {"C", {4.1F, 0, 0}}}) ==
        Pairs{{1, 2}});
    CHECK(found({{"C", {-1.4F, 0, 0}}, {"N", {0, 0, 0}}, {"O", {3.6F, 0, 0}}, {"C", {4.8F, 0, 0}}})
              .empty());
    CHECK(found({{"C", {0.3F, 1.4F, 0}}, {"N", {0, 0, 0}}, {"O", {2.9F, 0, 0}}}).empty());
    // Two carbonyls are both acceptors.
    CHECK(found({{"C", {-1.2F, 0, 0}}, {"O", {0, 0, 0}}, {"O", {2.9F, 0, 0}}, {"C", {4.1F, 0, 0}}})
              .empty());
    CHECK(found({{"O", {0, 0, 0}}, {"O", {2.8F, 0, 0}}}) == Pairs{{0, 1}}); // water, once
}

TEST_CASE("atoms with more bonds than any sample has form no hydrogen bonds") {
    // The search takes steps by the bonds of both atoms.
    std::vector<std::pair<const char*, Vec3f>> atoms = {
        {"O", {0, 0, 0}}, {"H", {0.96F, 0, 0}}, {"O", {2.9F, 0, 0}}};
    for (int i = 0; i < 25; ++i)
        atoms.push_back({"C", {50.0F + 5.0F * static_cast<float>(i), 0, 0}});
    Structure structure = of_atoms(atoms);
    CHECK(find_hydrogen_bonds(structure, {{0, 1, 1}}).size() == 1);
    std::vector<Bond> bonds = {{0, 1, 1}};
    for (AtomIndex i = 0; i < 25; ++i)
        bonds.push_back({2, 3 + i, 1});
    CHECK(find_hydrogen_bonds(structure, bonds).empty());
}

TEST_CASE("hydrogen bonds are dashed lines of visible atoms") {
    const std::string text = "4\n\nO 0 0 0\nH 0.96 0 0\nH -0.3 0.9 0\nO 2.9 0 0\n";
    const auto count = [&](const Drawing& drawing) {
        return sticks_of("a.xyz", text, drawing).size();
    };
    Drawing drawing{.style = Style::spheres};
    CHECK(count(drawing) == 0);
    drawing.hydrogen_bonds = true;
    CHECK(count(drawing) == 6);                      // of 1.94 angstrom
    drawing.cuts = {cut_plane_of("--cut", "x<2.8")}; // through a ball whose middle it removes
    CHECK(count(drawing) == 0);
    drawing.cuts.clear();
    drawing.hide = {"index 4"};
    CHECK(count(drawing) == 0);
}

TEST_CASE("metal clusters in a solvent keep their bonds and salts have none between ions") {
    // A tetrahedron of platinum with three waters on each atom.
    std::string text = "Pt 0.98 0.98 0.98\nPt 0.98 -0.98 -0.98\nPt -0.98 0.98 -0.98\n"
                       "Pt -0.98 -0.98 0.98\n";
    int count = 4;
    for (const Vec3d& corner :
         {Vec3d(1, 1, 1), Vec3d(1, -1, -1), Vec3d(-1, 1, -1), Vec3d(-1, -1, 1)})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3d way = 0.4 * corner;
            way[axis] += corner[axis];
            const Vec3d at = 0.98 * corner + 2.2 / raylane::core::length(way) * way;
            for (const auto& [name, away] :
                 {std::pair{"O", 0.0}, std::pair{"H", 0.7}, std::pair{"H", 0.9}}) {
                Vec3d place = at + away / raylane::core::length(way) * way;
                place[(axis + 1) % 3] += away * (away < 0.8 ? 0.7 : -0.5);
                text += std::string(name) + " " + std::to_string(place.x) + " " +
                        std::to_string(place.y) + " " + std::to_string(place.z) + "\n";
                ++count;
            }
        }
    const auto xyz = [](const std::string& atoms, int atom_count) {
        return frames(open_xyz, std::to_string(atom_count) + "\n\n" + atoms).at(0);
    };
    const auto bonds_between_metals = [](const Structure& structure) {
        const std::vector<Bond> bonds = find_bonds(structure);
        return std::count_if(bonds.begin(), bonds.end(), [&](const Bond& bond) {
            return is_metal(structure.element(bond.a)) && is_metal(structure.element(bond.b));
        });
    };
    CHECK(bonds_between_metals(xyz(text, count)) == 6);
    std::string salt;
    count = 0;
    const auto add = [&](const char* name, double x, double y, double z) {
        salt += std::string(name) + " " + std::to_string(x) + " " + std::to_string(y) + " " +
                std::to_string(z) + "\n";
        ++count;
    };
    constexpr double edge = 5.56;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                const double x = edge * i, y = edge * j, z = edge * k;
                add("Cs", x + edge / 2, y + edge / 2, z + edge / 2);
                add("Sn", x, y, z);
                add("Cl", x + edge / 2, y, z);
                add("Cl", x, y + edge / 2, z);
                add("Cl", x, y, z + edge / 2);
            }
    CHECK(bonds_between_metals(xyz(salt, count)) == 0);
}
