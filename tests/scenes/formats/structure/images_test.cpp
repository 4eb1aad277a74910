#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/images.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

#include <string>

/// Tests of bonds across the faces of a cell.
using namespace raylane::scenes;
using raylane::core::Vec3d;

namespace {

/// Returns a chain of carbon along x through cells of 3 angstrom, of two atoms each.
Structure chain() {
    Structure structure;
    structure.of_kind = {{"C", element_of("C")}};
    structure.positions = {{0, 0, 0}, {1.5F, 0, 0}};
    structure.kinds = {0, 0};
    structure.cell.edges = {Vec3d(3, 0, 0), Vec3d(0, 9, 0), Vec3d(0, 0, 9)};
    return structure;
}

std::string text_of(const std::vector<Bond>& bonds) {
    std::string text;
    for (const Bond& bond : bonds)
        text += std::to_string(bond.a) + "-" + std::to_string(bond.b) + " ";
    return text;
}

} // namespace

TEST_CASE("images of a cell are bonded to each other") {
    CHECK(text_of(find_bonds(with_images(chain(), {1, 1, 1}))) == "0-1 ");
    CHECK(text_of(find_bonds(with_images(chain(), {3, 1, 1}))) == "0-1 1-2 2-3 3-4 4-5 ");
    CHECK(text_of(find_bonds(with_images(chain(), {1, 2, 1}))) == "0-1 2-3 ");
}

TEST_CASE("a file's bonds join the nearest images of their atoms") {
    Structure structure = chain();
    structure.has_all_bonds = true;
    structure.positions[1].x = 2.5F; // half an angstrom to the left of the next cell's first atom
    structure.bonds = {{0, 1, 2}};
    CHECK(text_of(find_bonds(with_images(structure, {1, 1, 1}))).empty());
    CHECK(text_of(find_bonds(with_images(structure, {3, 1, 1}))) == "1-2 3-4 ");
    CHECK(find_bonds(with_images(structure, {2, 1, 1})).at(0).order == 2);
    structure.cell.periodic[0] = false;
    CHECK(text_of(find_bonds(with_images(structure, {1, 1, 1}))) == "0-1 ");
    structure.cell = {};
    CHECK(text_of(find_bonds(with_images(structure, {1, 1, 1}))) == "0-1 ");
    // An oblique cell: its second edge leans by nearly the width.
    structure = chain();
    structure.has_all_bonds = true;
    structure.cell.edges = {Vec3d(3, 0, 0), Vec3d(2.9, 3, 0), Vec3d(0, 0, 9)};
    structure.positions = {{0.1F, 0.1F, 0}, {2.9F + 0.1F, 2.9F, 0}};
    structure.bonds = {{0, 1, 1}};
    CHECK(text_of(find_bonds(with_images(structure, {1, 2, 1}))) == "1-2 ");
}

TEST_CASE("a cell with invalid numbers is refused if it is repeated and otherwise ignored") {
    Structure structure = chain();
    structure.cell.edges[0].x = std::nan("");
    CHECK(offsets_of_images(structure.cell, {1, 2, 1}).at(1) == Vec3d(0, 9, 0));
    LoadOptions options;
    options.drawing.opacity = 0.5F;
    options.drawing.repeat = {2, 1, 1};
    const std::string text = "1\nLattice=\"1e31 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3\n"
                             "C 0 0 0\n";
    CHECK(raylane::tests::message_of<BadInput>([&] { parse_scene("a.xyz", text, options); }) ==
          "a.xyz: its cell must have edges from -1e30 to 1e30");
    options.drawing.repeat = {1, 1, 1};
    CHECK(parse_scene("a.xyz", text, options).shape_count() == 1);
}

TEST_CASE("sticks continue into the next image of a cell") {
    LoadOptions options;
    options.drawing.style = Style::sticks;
    options.drawing.repeat = {2, 1, 1};
    options.drawing.boundary = options.drawing.whole = false;
    const std::string text = "2\nLattice=\"3 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3\n"
                             "C 0 0 0\nC 1.5 0 0\n";
    Legend legend;
    options.legend = &legend;
    const raylane::core::Scene scene = parse_scene("a.xyz", text, options);
    CHECK(scene.shape_count() == 4 + 3);
    CHECK(legend.of(4) == "bond of atom 1, C (C), and atom 2, C (C)");
    CHECK(legend.of(5) == "bond of atom 2, C (C), and atom 1, C (C)"); // atom 1 of the next cell
}
