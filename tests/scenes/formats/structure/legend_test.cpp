#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"

#include <string>

/// Tests of the legend, which names the shapes of a file of atoms, and of transparent atoms.
using namespace raylane::scenes;

namespace {

const std::string peptide = "two residues\n 3\n"
                            "    1ALA      N    1   0.000   0.000   0.000\n"
                            "    1ALA     CA    2   0.146   0.000   0.000\n"
                            "    2HOH     OW    3   0.600   0.000   0.000\n"
                            "   1.0 1.0 1.0\n";

} // namespace

TEST_CASE("each shape of a drawing belongs to an atom or a bond or the cell") {
    const float opacity = GENERATE(1.0F, 0.5F);
    LoadOptions options;
    Legend legend;
    options.legend = &legend;
    options.drawing.style = Style::balls;
    options.drawing.repeat = {2, 1, 1};
    options.drawing.select = "not hydrogen";
    options.drawing.show_cell = true;
    options.drawing.opacity = opacity;
    const raylane::core::Scene scene = parse_scene("a.gro", peptide, options);
    REQUIRE(legend.atoms_of_shape.size() == scene.shape_count());
    int atoms = 0, halves = 0, edges = 0;
    raylane::core::for_each_table(
        scene.shapes(), [&]<class Shape>(const raylane::core::Table<Shape>& table) {
            raylane::core::for_each_shape(table, [&](const auto& shape, raylane::core::ShapeId id) {
                const std::string text = legend.of(id);
                if (text.empty()) {
                    ++edges;
                    CHECK(scene.material_of(id).opacity == 1.0F);
                    return;
                }
                CHECK(scene.material_of(id).opacity == opacity);
                if constexpr (std::is_same_v<Shape, raylane::core::Sphere>) {
                    ++atoms;
                    const double x = std::fmod(static_cast<double>(shape.center.x), 10.0);
                    CHECK(text == (x < 1.0   ? "atom 1, N of ALA 1 (N)"
                                   : x < 2.0 ? "atom 2, CA of ALA 1 (C)"
                                             : "atom 3, OW of HOH 2 (O)"));
                } else {
                    ++halves;
                    CHECK(text == "bond of atom 1, N of ALA 1 (N), and atom 2, CA of ALA 1 (C)");
                }
            });
        });
    CHECK(atoms == 6);
    CHECK(halves == 4);
    CHECK(edges == 2 * 20 - 8); // two cells share 8 shapes
}

TEST_CASE("a cell of a slab or a chain has no edges in directions without a length") {
    const auto shapes = [](const std::string& lattice) {
        LoadOptions options;
        options.drawing.show_cell = true;
        const std::string text = "1\nLattice=\"" + lattice + "\"\nC 1 1 1\n";
        return parse_scene("a.xyz", text, options).shape_count() - 1; // without the atom
    };
    CHECK(shapes("3 0 0 0 4 0 0 0 5") == 8 + 12);
    CHECK(shapes("3 0 0 0 4 0 0 0 0") == 4 + 4);
    CHECK(shapes("3 0 0 0 0 0 0 0 5") == 4 + 4);
    CHECK(shapes("3 0 0 0 0 0 0 0 0") == 2 + 1);
    CHECK(shapes("3 0 0 0 4 0 0 0 1e-60") == 4 + 4); // 0 as a float
    CHECK(shapes("0 0 0 0 4 0 0 0 5") == 4 + 4);
    CHECK_THROWS_AS(shapes("0 0 0 0 0 0 0 0 0"), BadInput);
}

TEST_CASE("transparent atoms have no walls inside") {
    // Two balls overlap along the line of sight. They are as transparent as one.
    const auto middle = [](const std::string& text) {
        LoadOptions options;
        options.drawing.style = Style::spheres;
        options.drawing.opacity = 0.25F;
        options.drawing.width = options.drawing.height = 31;
        options.drawing.depth_cue = 0.0F;
        options.drawing.fit_camera.direction = {0, 0, -1};
        const raylane::core::Scene scene = parse_scene("a.xyz", text, options);
        raylane::core::Settings settings = scene.settings();
        settings.alpha = true;
        settings.quality = 0.0F;
        settings.grid = 1;
        const raylane::simd::Rendering drawn = raylane::simd::render(scene, settings, {});
        REQUIRE(drawn.film.has_alpha());
        return drawn.film.alpha_at(15, 15);
    };
    const float covered = 1.0F - 0.75F * 0.75F; // by the front and the back surface
    CHECK(middle("1\n\nC 0 0 0\n") == Approx(covered));
    CHECK(middle("2\n\nC 0 0 0\nN 0 0 1\n") == Approx(covered));
    CHECK(middle("2\n\nC 0 0 0\nN 0 0 9\n") == Approx(1.0F - 0.75F * 0.75F * 0.75F * 0.75F));
}
