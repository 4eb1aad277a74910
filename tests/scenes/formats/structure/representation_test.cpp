#include "scenes/files/errors.hpp"
#include "scenes/formats/structure/bonds.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/representation.hpp"
#include "scenes/formats/structure/structure_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/structure/structures.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

/// Tests of looks of selected atoms: styles, colours, sizes and opacities in words.
using namespace raylane::scenes;
namespace core = raylane::core;
using core::Vec3f;
using raylane::tests::of_atoms;
using raylane::tests::peptide;

namespace {

using Shows = std::vector<ShowWords>;

/// A sphere or cylinder of a scene.
struct Part {
    core::ShapeId id;
    float radius, opacity;
    std::string material;
};

/// Returns the shapes of a kind in the order of their ids.
template <class Shape>
std::vector<Part> parts(const core::Scene& scene) {
    std::vector<Part> found;
    core::for_each_shape(
        std::get<core::Table<Shape>>(scene.shapes()), [&](const auto& shape, core::ShapeId id) {
            const core::MaterialIndex index = scene.material_index_of(id);
            found.push_back({id, static_cast<float>(shape.radius), scene.materials()[index].opacity,
                             std::string(scene.material_name(index))});
        });
    std::sort(found.begin(), found.end(), [](const Part& a, const Part& b) { return a.id < b.id; });
    return found;
}
std::vector<Part> balls(const core::Scene& scene) {
    return parts<core::Sphere>(scene);
}
std::vector<Part> sticks(const core::Scene& scene) {
    return parts<core::CappedCylinder>(scene);
}

core::Scene drawn(const Structure& structure, Drawing drawing, const Shows& show = {},
                  std::vector<std::string>* remarks = nullptr) {
    drawing.show = show;
    return draw_structure(structure, drawing, "a", nullptr, nullptr,
                          [&](const std::string& remark) {
                              if (remarks != nullptr) remarks->push_back(remark);
                          });
}

/// Returns the materials' names and radii, "C 0.16 H 0.16 ".
std::string text_of(const std::vector<Part>& parts) {
    std::string text;
    for (const Part& part : parts) {
        char radius[32];
        std::snprintf(radius, sizeof radius, "%.3g", static_cast<double>(part.radius));
        text += part.material + " " + radius + (part.opacity < 1.0F ? "/" : "") + " ";
    }
    return text;
}

std::string complaint(const Structure& structure, const Shows& show, Drawing drawing = {}) {
    return raylane::tests::message_of<BadInput>([&] { drawn(structure, drawing, show); });
}

std::string refusal(const std::string& text) {
    return raylane::tests::message_of<BadInput>([&] { representation_of("--show", text); });
}

/// Returns a slab of three layers of a face-centred cubic metal, and carbon on it.
Structure slab(const char* metal, double distance, const char* other, double gap) {
    std::vector<std::pair<const char*, Vec3f>> atoms;
    const double edge = distance * std::sqrt(2.0);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            for (int k = 0; k < 3; ++k)
                if ((i + j + k) % 2 == 0)
                    atoms.emplace_back(metal, Vec3f(core::Vec3d(i, j, k) * (0.5 * edge)));
    atoms.emplace_back(other, Vec3f(core::Vec3d(edge, edge, edge + gap)));
    return of_atoms(atoms);
}

} // namespace

TEST_CASE("later representations replace earlier ones of the same atoms") {
    const core::Scene scene =
        drawn(peptide(), {}, {{"all: sticks gray"}, {"chain A: spheres"}, {"index 2: points red"}});
    CHECK(text_of(balls(scene)) == "gray 0.16 N 1.55 H 1.2 C 1.7 red 0.2 ");
    // Only the atoms that are selected appear.
    CHECK(text_of(balls(drawn(peptide(), {}, {{"water: spheres"}}))) == "O 1.52 ");
}

TEST_CASE("a representation that later ones replace is reported and needs no atoms") {
    std::vector<std::string> remarks;
    const core::Scene scene = drawn(
        peptide(), {}, {{"water: cartoon"}, {"name CB: polyhedra"}, {"all: points"}}, &remarks);
    CHECK(balls(scene).size() == 5);
    const std::string replaced =
        " shows no atoms, because later ones replace it; two looks at once are joined by +";
    REQUIRE(remarks.size() == 2);
    CHECK(remarks[0].ends_with("--show \"water\"" + replaced));
    CHECK(remarks[1].ends_with("--show \"name CB\"" + replaced));
    CHECK(complaint(peptide(), {{"all: polyhedra"}}) ==
          "--show: polyhedra are missing: they need an atom that is shown and has 4 to 64 bonds");
}

TEST_CASE("a legend has the colour of carbons, by their selection") {
    Drawing drawing{.style = Style::spheres};
    drawing.show = {{"chain A: carbons orange"}, {"water: red"}};
    DrawingScale scale;
    draw_structure(peptide(), drawing, "a", nullptr, &scale);
    REQUIRE(scale.keys.size() == 1);
    std::vector<std::string> names;
    for (const auto& [name, color] : scale.keys[0].entries)
        names.push_back(name);
    CHECK(std::count(names.begin(), names.end(), "C of chain A") == 1);
    CHECK(std::count(names.begin(), names.end(), "red") == 1); // which the sheet leaves out
    drawing.show = {{"chain A and index 1-5 and not element O: carbons orange"}};
    scale = {};
    draw_structure(peptide(), drawing, "a", nullptr, &scale);
    CHECK(scale.keys[0].entries[0].first == "C, orange");
}

TEST_CASE("atoms that are hidden or not selected appear in no representation") {
    Drawing drawing{.style = Style::spheres, .hide = {"hydrogen", "name CB"}};
    CHECK(text_of(balls(drawn(peptide(), drawing))) == "N 1.55 C 1.7 O 1.52 ");
    drawing.select = "chain A";
    CHECK(text_of(balls(drawn(peptide(), drawing, {{"all: points"}}))) == "N 0.2 C 0.2 ");
    CHECK(complaint(peptide(), {{"all"}}, {.hide = {"all"}}) ==
          "--hide: must leave an atom to show, got none of 5");
}

TEST_CASE("transparent atoms of one style have no walls between representations") {
    const core::Scene scene = drawn(peptide(), {},
                                    {{"index 1-2: envelope red opacity 0.5"},
                                     {"index 3-4: envelope blue opacity 0.5"},
                                     {"index 5: spheres opacity 0.5"}});
    // The solid of spheres comes before that of envelopes.
    CHECK(scene.solids().solid_of(1) == scene.solids().solid_of(4));
    CHECK(scene.solids().solid_of(0) != scene.solids().solid_of(1));
}

TEST_CASE("a plus shows atoms in two looks at once") {
    const core::Scene scene =
        drawn(peptide(), {}, {{"water: points + spheres white opacity 0.25"}});
    CHECK(text_of(balls(scene)) == "O 0.2 white 1.52/ ");
}

TEST_CASE("a representation leaves open words to the other options") {
    const Drawing drawing{.style = Style::points, .color = "chain", .opacity = 0.5F};
    CHECK(text_of(balls(drawn(peptide(), drawing, {{"water"}, {"name CB: spheres opacity 1"}}))) ==
          "chain A 1.7 chain b 0.2/ ");
}

TEST_CASE("halves of a bond between representations have the look of their atoms") {
    const core::Scene scene =
        drawn(peptide(), {}, {{"all: sticks"}, {"index 1: licorice"}, {"index 4-5: points"}});
    // N-C and N-H, of two atoms each.
    CHECK(text_of(sticks(scene)) == "C 0.16 H 0.16 N 0.3 N 0.3 ");
    CHECK(sticks(drawn(peptide(), {}, {{"all: sticks"}, {"index 1: spheres"}})).empty());
}

TEST_CASE("carbons have the colour of their chain and other atoms that of their element") {
    const Drawing drawing{.style = Style::spheres, .color = "carbons chain"};
    CHECK(text_of(balls(drawn(peptide(), drawing))) ==
          "N 1.55 chain A 1.7 H 1.2 chain A 1.7 O 1.52 ");
    CHECK(text_of(balls(drawn(peptide(), {}, {{"index 1-2: carbons orange spheres"}}))) ==
          "N 1.55 orange 1.7 ");
}

TEST_CASE("a colour of an element or type replaces that of its atoms") {
    const auto color_of = [](const core::Scene& scene, std::size_t shape) {
        return scene.materials()[scene.material_index_of(static_cast<core::ShapeId>(shape))]
            .pattern.colors[0];
    };
    const Drawing drawing{.style = Style::spheres, .color = "h=#000000 white O=red"};
    const core::Scene scene = drawn(peptide(), drawing);
    CHECK(color_of(scene, 0) == core::Color(1.0F));
    CHECK(color_of(scene, 2) == core::Color(0.0F));
    CHECK(color_of(scene, 4) == core::Color(1.0F, 0.0F, 0.0F));
    Structure types = of_atoms({{"1", {0, 0, 0}}, {"2", {3, 0, 0}}});
    CHECK(color_of(drawn(types, {.style = Style::spheres, .color = "2=#ffffff"}), 1) ==
          core::Color(1.0F));
}

TEST_CASE("radii and factors hold for all atoms or those of a kind") {
    const auto sizes = [](const std::string& radius, const std::string& scale) {
        return text_of(balls(
            drawn(peptide(), {.style = Style::spheres, .radius = radius, .scale_radii = scale})));
    };
    CHECK(sizes("", "0.5") == "N 0.775 C 0.85 H 0.6 C 0.85 O 0.76 ");
    CHECK(sizes("1,H=0.25", "O=2") == "N 1 C 1 H 0.25 C 1 O 2 ");
    const core::Scene scene = drawn(peptide(), {}, {{"index 1-2: sticks radius 0.1 N=0.2"}});
    CHECK(text_of(sticks(scene)) == "N 0.2 C 0.1 ");
    std::vector<std::string> remarks;
    drawn(peptide(), {.radius = "Fe=2"}, {}, &remarks);
    CHECK(remarks == std::vector<std::string>{"--radius: \"Fe\" matches no element or type"});
}

TEST_CASE("colours of a property have the range that is given") {
    const auto color_of = [](const Drawing& drawing, const Shows& show, core::ShapeId shape) {
        const core::Scene scene = drawn(peptide(), drawing, show);
        return scene.materials()[scene.material_index_of(shape)].pattern.colors[0];
    };
    const Drawing usual{.style = Style::spheres, .color = "b_factor"};
    Drawing wide = usual;
    wide.range = ColorRange(-10.0, 30.0);
    CHECK(color_of(usual, {}, 2) == color_of(wide, {}, 0));
    CHECK(color_of(usual, {}, 4) == color_of(wide, {}, 4)); // beyond the end
    CHECK(color_of(usual, {{"all: spheres range -10:30"}}, 0) == color_of(wide, {}, 0));
    Drawing magma = usual;
    magma.palette = "magma";
    CHECK(color_of(usual, {{"all: spheres palette magma"}}, 4) == color_of(magma, {}, 4));
    CHECK_FALSE(color_of(usual, {}, 4) == color_of(magma, {}, 4));
    // Representations share one range, so that a colour has one meaning.
    CHECK(color_of({}, {{"index 1-3: spheres b_factor"}, {"index 4-5: points b_factor"}}, 2) ==
          color_of(usual, {}, 2));
}

TEST_CASE("colours of a property are not paler in the distance") {
    const auto has_fog = [](const Drawing& drawing) {
        return drawn(peptide(), drawing).fog().kind != core::FogKind::none;
    };
    CHECK(has_fog({}));
    CHECK_FALSE(has_fog({.color = "b_factor"}));
}

TEST_CASE("touching atoms of a metal meet and those of an oxide do not overlap") {
    const Structure platinum = slab("Pt", 2.77, "C", 1.9);
    const core::Scene scene = drawn(platinum, {.style = Style::touching});
    CHECK(balls(scene).front().radius == 1.385F);
    CHECK(balls(scene).back().radius == 0.76F);
    std::vector<char> is_metallic;
    const std::size_t bonds = find_bonds(platinum, nullptr, &is_metallic).size();
    CHECK(bonds > 100);
    CHECK(is_metallic[78] == 1);
    CHECK(is_metallic[6] == 0);
    // Rock salt: each ion has as many others as it has room for.
    std::vector<std::pair<const char*, Vec3f>> ions;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k)
                ions.emplace_back((i + j + k) % 2 == 0 ? "Mg" : "O",
                                  2.106F * Vec3f(static_cast<float>(i), static_cast<float>(j),
                                                 static_cast<float>(k)));
    const Structure oxide = of_atoms(ions);
    CHECK(find_bonds(oxide, nullptr, &is_metallic).size() == 3 * 48);
    CHECK(is_metallic[12] == 0);
    CHECK(balls(drawn(oxide, {.style = Style::touching})).front().radius == 1.41F);
}

TEST_CASE("an invalid representation gives an error with its column") {
    CHECK(refusal("protein: stiks") == "no error"); // perhaps a property
    CHECK(refusal("protein: sticks balls") ==
          "--show: column 17: must have one style, got \"balls\" as well; \"+\" separates styles "
          "that are shown at once");
    CHECK(refusal("protein: red blue") ==
          "--show: column 14: must be one colour, got \"red\" and \"blue\"");
    CHECK(refusal("protein: stiks orange") ==
          "--show: column 16: must be one colour, got \"stiks\" and \"orange\", did you mean "
          "\"sticks\"?");
    CHECK(refusal("protein: orange opacty 1") ==
          "--show: column 17: must be one colour, got \"orange\" and \"opacty\", did you mean "
          "\"opacity\"?");
    CHECK(refusal("protein: opacity 2") ==
          "--show: column 18: opacity must be above 0 and at most 1, got \"2\"");
    CHECK(refusal("protein: radius") ==
          "--show: column 16: radius must be above 0 and at most 1e+06, got nothing");
    CHECK(refusal("a: Fe=rad") == "--show: column 7: must be a colour such as red or #ff8000, got "
                                  "\"rad\", did you mean \"red\"?");
    CHECK(refusal("a: palette viridi") ==
          "--show: column 12: must be viridis, cividis, magma, plasma or coolwarm, got "
          "\"viridi\", did you mean \"viridis\"?");
    CHECK(refusal("a: range 5 1") == "--show: column 10: a range must have its lower end first");
    CHECK(refusal("protein sticks orange") ==
          "--show: must be one SELECTION: STYLE with a colon, got \"protein sticks orange\"");
    CHECK(refusal("protein: cartoon, ligand: Sticks") ==
          "--show: must be one SELECTION: STYLE; give each by itself, got \"protein: cartoon, "
          "ligand: Sticks\"");
    CHECK(refusal("protein: sticks carbon orange").ends_with("did you mean \"carbons\"?"));
    CHECK(refusal(": sticks") == "--show: must be SELECTION: STYLE, got \": sticks\"");
    CHECK(complaint(peptide(), {{"chain A: stiks"}}) ==
          "--show: must be a style, element, chain, residue, secondary, rainbow, b_factor or a "
          "colour such as red or "
          "#ff8000, got \"stiks\", did you mean \"sticks\"?");
    CHECK(complaint(peptide(), {{"chain B: sticks"}}) ==
          "--show: \"chain B\" selects none of 5 atoms");
    CHECK(complaint(peptide(), {{"chain A: sticks"}, {"watr < 3", "representations/1"}})
              .starts_with("representations/1: column 1: must be one of all, none, "));
}

TEST_CASE("a colon within a range of residues separates nothing") {
    CHECK(representation_of("--show", "resi 1:20").select == "resi 1:20");
    CHECK(representation_of("--show", "resi 1:20: sticks").select == "resi 1:20");
    CHECK(representation_of("--show", "index 1:sticks").looks.front().style == Style::sticks);
}

TEST_CASE("a palette or a range is reported if no colour stands for a number") {
    const auto remarks_of = [](Drawing drawing, const Shows& show) {
        std::vector<std::string> remarks;
        drawn(peptide(), drawing, show, &remarks);
        return remarks;
    };
    const std::string because = " is ignored, because no colour stands for a number";
    using Remarks = std::vector<std::string>;
    const Drawing magma{.palette = "magma"}, range{.range = ColorRange(0.0, 1.0)};
    CHECK(remarks_of(magma, {}) == Remarks{"--palette" + because});
    CHECK(remarks_of(range, {}) == Remarks{"--range" + because});
    CHECK(remarks_of({.color = "b_factor", .palette = "magma"}, {}).empty());
    CHECK(remarks_of(magma, {{"all: spheres red"}, {"index 1: spheres b_factor"}}).empty());
    CHECK(remarks_of({}, {{"all: spheres red palette magma"}, {"index 1: b_factor range 0:1"}}) ==
          Remarks{"the palette or range of --show" + because});
}

TEST_CASE("names of colours and palettes have their colours") {
    CHECK(color_named("Orange") == 0xffa500U);
    CHECK(color_named("lightyellow") == 0xffffe0U);
    CHECK(color_named("rebeccapurple") == 0x663399U);
    CHECK(color_named("#0A0b0c") == 0x0a0b0cU);
    for (const char* const wrong : {"", "#", "#12345", "#1234567", "#12345g", "#+12345", "orang"})
        CHECK_FALSE(color_named(wrong));
    CHECK(palette_names().front() == "viridis");
    CHECK(ramp_at(0.0) == 0x440154U);
    for (const std::string_view palette : palette_names())
        CHECK(ramp_at(0.0, palette) != ramp_at(1.0, palette));
}
