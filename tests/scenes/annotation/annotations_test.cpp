#include "core/scene/camera_rays.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/annotation/composer.hpp"
#include "scenes/annotation/furniture.hpp"
#include "scenes/annotation/overlay.hpp"
#include "scenes/annotation/projector.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <functional>
#include <random>

using namespace raylane;
using namespace raylane::scenes;

namespace {

const std::string atoms = "4\nProperties=species:S:1:pos:R:3:charge:R:1\n"
                          "C 0 0 0 -1\nO 3 0 0 0.5\nH 0 2 0 1\nH 0 -2 0 3\n";

struct Drawn {
    core::Scene scene;
    Legend legend;
};

Drawn drawn_of(const std::string& name, const std::string& text,
               const std::function<void(Drawing&)>& change = {}) {
    Legend legend;
    LoadOptions options;
    options.legend = &legend;
    if (change) change(options.drawing);
    core::Scene scene = parse_scene(name, text, options);
    const core::AutoCamera camera = scene.auto_camera();
    const core::View view = core::staged(scene, camera, scene.settings());
    return {std::move(scene).seen(camera, view), std::move(legend)};
}

Drawn drawn(const std::string& color) {
    return drawn_of("a.xyz", atoms, [&](Drawing& d) { d.color = color; });
}

Sheet sheet_of(const Annotations& annotations, const Legend& legend, const AnnotatedView& view,
               const OnRemark& on_remark) {
    return SheetComposer(annotations, legend, on_remark).compose(view, on_remark);
}

AnnotatedView view_of(const Drawn& figure) {
    return {figure.scene.camera(), 800, 600, figure.scene.background()};
}

/// Returns the texts of the labels, one behind the other, and sets the remarks.
std::string labels_of(const Drawn& figure, const std::string& label,
                      std::vector<std::string>& remarks) {
    AnnotatedView view = view_of(figure);
    view.scene = &figure.scene;
    Annotations annotations;
    annotations.labels = {label_words_of("--label", label)};
    remarks.clear();
    const Sheet sheet = sheet_of(annotations, figure.legend, view,
                                 [&](const std::string& remark) { remarks.push_back(remark); });
    std::string texts;
    for (const Mark& mark : sheet.groups.at(0).marks)
        texts += std::get<SheetText>(mark).text + " ";
    return texts;
}

std::vector<std::string> remarks_of(const Annotations& annotations, const Drawn& figure) {
    std::vector<std::string> remarks;
    sheet_of(annotations, figure.legend, view_of(figure),
             [&](const std::string& remark) { remarks.push_back(remark); });
    return remarks;
}

std::string svg(const Annotations& annotations, const Drawn& figure) {
    return svg_of(sheet_of(annotations, figure.legend, view_of(figure), {}));
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("annotations are where the camera's rays go") {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-5.0F, 5.0F);
    for (int round = 0; round < 200; ++round) {
        core::Camera camera;
        camera.projection =
            round % 2 == 0 ? core::Projection::perspective : core::Projection::orthographic;
        camera.from = {number(random), number(random), number(random)};
        camera.at = {number(random), number(random), number(random)};
        camera.height = 3.0F;
        core::Settings settings;
        settings.width = 640;
        settings.height = 480;
        const Projector projector(camera, 640, 480);
        const int x = 13 * round % 640, y = 29 * round % 480;
        const core::Ray<double> ray = core::CameraRays<double>(camera, settings).ray(x, y, 0);
        const auto point = projector.point_of(ray.origin + 2.5 * ray.direction);
        REQUIRE(point);
        CHECK(std::abs(point->x - (x + 0.5)) < 1e-6);
        CHECK(std::abs(point->y - (y + 0.5)) < 1e-6);
    }
}

TEST_CASE("a legend of numbers has their range and colours") {
    const Drawn figure = drawn("charge");
    REQUIRE(figure.legend.colors.size() == 1);
    CHECK(figure.legend.colors[0].property == "charge");
    CHECK(figure.legend.colors[0].range == ColorRange(-1.0, 3.0));
    const std::string text = svg({.legend = true}, figure);
    CHECK(has(text, "<g id=\"legend-charge\">"));
    CHECK(has(text, ">Charge (e)</text>"));
    CHECK(has(text, ">\u22121</text>"));
    CHECK(has(text, ">3</text>"));
    CHECK(has(svg({.legend = true, .legend_title = "a < b & c"}, figure),
              ">a &lt; b &amp; c</text>"));
}

TEST_CASE("a legend of elements has those that are shown") {
    const Drawn figure = drawn("element");
    REQUIRE(figure.legend.colors.size() == 1);
    CHECK(figure.legend.colors[0].entries.size() == 3);
    const std::string text = svg({.legend = true}, figure);
    CHECK(text.find(">C</text>") < text.find(">H</text>"));
    CHECK(text.find(">H</text>") < text.find(">O</text>"));
    CHECK_THROWS_AS(svg({.legend = true}, drawn("orange")), BadInput);
}

TEST_CASE("a legend has no element of which planes left nothing") {
    const Drawn figure = drawn_of("a.xyz", atoms, [](Drawing& d) {
        d.style = Style::spheres;
        d.cuts = {cut_plane_of("--cut", "x<1.4")}; // O is at 3, with a radius of 1.52
    });
    const std::string text = svg({.legend = true}, figure);
    CHECK(has(text, ">C</text>"));
    CHECK(!has(text, ">O</text>"));
}

TEST_CASE("no two groups of an SVG have the same id") {
    std::string renamed = atoms;
    renamed.replace(renamed.find("charge"), 6, "colors");
    const Drawn figure = drawn_of("a.xyz", renamed, [](Drawing& d) {
        d.show = {{"element C: balls element"}, {"not element C: balls colors"}};
    });
    const std::string text = svg({.legend = true}, figure);
    CHECK(has(text, "id=\"legend-colors\""));
    CHECK(has(text, "id=\"legend-colors-2\""));
    CHECK(text.find("id=\"legend-colors\"") == text.rfind("id=\"legend-colors\""));
}

TEST_CASE("each copy of an atom has a label, unless other atoms hide it") {
    const std::string salt = "2\nLattice=\"4 0 0 0 4 0 0 0 4\"\nCs 0 0 0\nCl 2 2 2\n";
    const Drawn figure = drawn_of("a.xyz", salt, [](Drawing& d) {
        d.style = Style::spheres;
        d.radius = "0.5";
        d.view = core::NamedView{"", {-1.0F, -0.3F, -0.2F}, {0.0F, 0.0F, 1.0F}};
    });
    std::vector<std::string> remarks;
    CHECK(labels_of(figure, "element Cs: {element}", remarks) == "Cs Cs Cs Cs Cs Cs Cs Cs ");
    CHECK(remarks.empty());
    // From the front, four are behind the others.
    const Drawn front = drawn_of("a.xyz", salt, [](Drawing& d) {
        d.style = Style::spheres;
        d.radius = "0.5";
        d.view = core::NamedView{"", {0.0F, 0.0F, -1.0F}, {0.0F, 1.0F, 0.0F}};
    });
    CHECK(labels_of(front, "element Cs: {element}{index}", remarks) == "Cs1 Cs1 Cs1 Cs1 ");
    REQUIRE(remarks.size() == 1);
    CHECK(remarks[0] == "--label \"element Cs\": 4 of 8 labels are left out, as other atoms hide "
                        "their places, or as these are outside of the image");
    CHECK(labels_of(front, "element Cs: salt", remarks) == "salt "); // no field: one label
    CHECK(remarks.empty());
    // Behind the polyhedron of another atom, and in its own.
    const Drawn inside = drawn_of(
        "a.xyz", "7\n\nTi 0 0 0\nO 2 0 0\nO -2 0 0\nO 0 2 0\nO 0 -2 0\nO 0 0 2\nO 0.1 0.1 -2\n",
        [](Drawing& d) {
            d.style = Style::spheres;
            d.radius = "0.1";
            d.polyhedra = {"Ti"};
            d.view = core::NamedView{"", {0.3F, 0.2F, -1.0F}, {0.0F, 1.0F, 0.0F}};
        });
    CHECK(labels_of(inside, "all: {element}{index}", remarks) == "Ti1 O2 O3 O4 O5 O6 ");
}

TEST_CASE("each residue and each chain has one label") {
    const std::string peptide = "two residues\n 4\n"
                                "    1ALA      N    1   0.000   0.000   0.000\n"
                                "    1ALA     CA    2   0.146   0.000   0.000\n"
                                "    2HOH     OW    3   0.600   0.000   0.000\n"
                                "    2HOH    HW1    4   0.600   0.200   0.000\n"
                                "   1.0 1.0 1.0\n";
    const Drawn figure = drawn_of("a.gro", peptide);
    std::vector<std::string> remarks;
    CHECK(labels_of(figure, "all: {resn} {resi}", remarks) == "ALA 1 HOH 2 ");
    Annotations annotations;
    annotations.labels = {label_words_of("--label", "all: {resn}")};
    const Sheet sheet = sheet_of(annotations, figure.legend, view_of(figure), {});
    const Projector projector(figure.scene.camera(), 800, 600);
    const auto alpha = projector.point_of(core::Vec3d(1.46, 0.0, 0.0));
    const auto middle = projector.point_of(core::Vec3d(6.0, 1.0, 0.0));
    CHECK(std::abs(std::get<SheetText>(sheet.groups[0].marks.at(0)).at.x - alpha->x) < 1e-3);
    CHECK(std::abs(std::get<SheetText>(sheet.groups[0].marks.at(1)).at.x - middle->x) < 1e-3);
    CHECK(labels_of(figure, "all: chain{chain}", remarks) == "chain ");
    CHECK(tests::message_of<BadInput>([&] {
              labels_of(drawn("element"), "all: {resn}", remarks);
          }) == "--label: must have {element}, {name} or {index} here, got \"{resn}\": the atoms "
                "have no residues");
    CHECK(labels_of(figure, "all: {name} {resn}", remarks) == "N ALA CA ALA OW HOH HW1 HOH ");
}

TEST_CASE("a distance in a crystal goes to the nearest copy") {
    const Drawn figure =
        drawn_of("a.xyz", "2\nLattice=\"6 0 0 0 6 0 0 0 6\" pbc=\"T T T\"\nCs 0 0 0\nCl 5 0 0\n");
    Annotations annotations;
    annotations.distances = {distance_words_of("--distance", "index 2: index 1")};
    CHECK(has(svg(annotations, figure), ">1.00 \u00c5</text>"));
}

TEST_CASE("annotations that have no effect or no room are reported or refused") {
    const Drawn figure = drawn("element");
    const auto remark = [&](const Annotations& annotations) {
        const std::vector<std::string> remarks = remarks_of(annotations, figure);
        return remarks.empty() ? "" : remarks[0];
    };
    CHECK(remark({.legend = true}).empty());
    CHECK(remark({.legend = true, .legend_title = "Atoms"}).empty());
    CHECK(has(svg({.legend = true, .legend_title = "Atoms"}, figure), ">Atoms</text>"));
    CHECK(remark({.legend = true, .font_size = 400.0}) ==
          "--font-size: texts are 400 pixels high in an image of 800 x 600: too large for it");
    CHECK(remark({.legend = true, .font_size = 2.5}) ==
          "--font-size: texts are 2.5 pixels high in an image of 800 x 600: too small to read");
    CHECK(remark({.legend = true, .font_size = 7.0}) ==
          "--font-size: texts are 7 pixels high in an image of 800 x 600: too small to read");
    CHECK(remark({.legend = true, .font_size = 8.0}).empty());
    for (const double length : {1e-3, 1e3})
        CHECK(has(tests::message_of<BadInput>([&] { svg({.scale_bar = length}, figure); }),
                  "--scale-bar: must be auto or in the image, which is"));
    Annotations of_frames{.scale_bar = 1e3};
    of_frames.is_steady = true;
    CHECK_FALSE(has(svg(of_frames, figure), "scale-bar"));
    of_frames.scale_bar = 2.0;
    CHECK(has(svg(of_frames, figure), "scale-bar"));
    CHECK(remark({.labels = {{"index 1", "a"}}}).empty());
    Annotations aside;
    aside.labels = {{"index 1", "a"}};
    core::Camera camera = figure.scene.camera();
    camera.at = camera.from + core::Vec3f(1.0F, 0.0F, 0.0F);
    std::vector<std::string> remarks;
    sheet_of(aside, figure.legend, {camera, 800, 600, core::Color(1.0F)},
             [&](const std::string& text) { remarks.push_back(text); });
    REQUIRE(remarks.size() == 1);
    CHECK(has(remarks[0], "1 of 1 labels are left out"));
}

TEST_CASE("a scene that is not of atoms has lengths without a unit, and no labels") {
    const Drawn figure =
        drawn_of("a.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "lights": [],)"
                           R"("materials": {"a": {}}, "objects": [{"type": "sphere",)"
                           R"("center": [0, 0, 0], "radius": 1, "material": "a"}]})");
    Annotations bar{.scale_bar = 0.5};
    CHECK(has(svg(bar, figure), ">0.5</text>"));
    CHECK(!has(svg(bar, figure), "\u00c5"));
    CHECK(tests::message_of<BadInput>([&] {
              svg({.labels = {{"all", "a"}}}, figure);
          }) == "--label: goes with a file of atoms, not with a scene");
}

TEST_CASE("axes are on the right if arrows of the cell are on the left") {
    const Drawn figure = drawn("element");
    for (const bool on_right : {false, true}) {
        const Sheet sheet = sheet_of({.axes = Axes::of_space, .axes_on_right = on_right},
                                     figure.legend, view_of(figure), {});
        for (const Mark& mark : sheet.groups.at(0).marks)
            if (const auto* const text = std::get_if<SheetText>(&mark)) {
                CHECK((text->at.x > 400.0) == on_right);
                CHECK(text->at.x < 800.0);
            }
    }
}

TEST_CASE("labels and distances are at the middles of their atoms") {
    const Drawn figure = drawn("element");
    Annotations annotations;
    annotations.labels = {label_words_of("--label", "element H: {element}{index}"),
                          label_words_of("--label", "element H: both")};
    annotations.distances = {distance_words_of("--distance", "index 1: element O")};
    annotations.font_size = 20.0;
    const std::string text = svg(annotations, figure);
    CHECK(has(text, ">H3</text>"));
    CHECK(has(text, ">H4</text>"));
    CHECK(has(text, ">3.00 \u00c5</text>"));
    const auto middle = Projector(figure.scene.camera(), 800, 600).point_of(core::Vec3d(0.0));
    const Sheet sheet = sheet_of(annotations, figure.legend, view_of(figure), {});
    REQUIRE(sheet.groups.back().name == "label-2");
    const auto& label = std::get<SheetText>(sheet.groups.back().marks.at(0));
    CHECK(std::abs(label.at.x - middle->x) < 1e-9);
    CHECK_THROWS_AS(label_words_of("--label", "element H"), BadInput);
    annotations.labels = {{"element Fe", "iron"}};
    CHECK_THROWS_AS(svg(annotations, figure), BadInput);
}

TEST_CASE("a scale bar is as long as it says") {
    Drawn figure = drawn("element");
    core::Camera camera = figure.scene.camera();
    camera.projection = core::Projection::orthographic;
    camera.height = 12.0F;
    const Sheet sheet =
        sheet_of({.scale_bar = 2.0}, figure.legend, {camera, 800, 600, core::Color(1.0F)}, {});
    const auto& bar = std::get<SheetLine>(sheet.groups.at(0).marks.at(0));
    CHECK(std::abs(bar.to.x - bar.from.x - 100.0) < 1e-9);
    CHECK(std::get<SheetText>(sheet.groups[0].marks.at(1)).text == "2 \u00c5");
    CHECK_THROWS_AS(svg({.axes = Axes::of_cell}, figure), BadInput);
    CHECK(has(svg({.axes = Axes::of_space}, figure), ">x</text>"));
}

TEST_CASE("texts of any bytes are texts of XML") {
    const Drawn figure = drawn("element");
    const std::string text = svg({.labels = {{"index 1", "a<b]]>\xe9"}}}, figure);
    CHECK(has(text, "a&lt;b]]&gt;\\xE9</text>"));
}

TEST_CASE("round numbers cover a range") {
    CHECK(round_numbers_in(0.0, 100.0) == std::vector<double>{0, 20, 40, 60, 80, 100});
    CHECK(round_numbers_in(2.0, 2.0) == std::vector<double>{2.0});
    // Without a round number between, and without an end of doubles' range.
    CHECK(round_numbers_in(1e20, 1.0000000000000002e20).size() == 2);
    CHECK(round_numbers_in(-1e308, 1e308).size() == 2);
    for (const double size : {1e-3, 0.7, 3.0, 17.0, 999.0}) {
        const std::vector<double> numbers = round_numbers_in(-0.3 * size, 0.7 * size);
        CHECK(numbers.size() >= 3);
        CHECK(numbers.size() <= 8);
        CHECK(numbers.front() >= -0.3 * size - 1e-9);
        CHECK(numbers.back() <= 0.7 * size + 1e-9);
    }
}

TEST_CASE("an overlay is blended in the codes of the image") {
    core::Film film(2, 1);
    film.at(0, 0) = film.at(1, 0) = core::Color(1.0F);
    blend({0, 0x80000000U}, 2, {0, 0, 2, 1}, core::Transfer::srgb, film);
    CHECK(film.at(0, 0) == core::Color(1.0F));
    CHECK(core::encode(film.at(1, 0).x, core::Transfer::srgb) == 127);
    core::Film clear(1, 1, true);
    blend({0x80800000U}, 1, {0, 0, 1, 1}, core::Transfer::srgb, clear);
    CHECK(std::abs(clear.alpha_at(0, 0) - 128.0F / 255.0F) < 1e-6F);
    CHECK(core::encode(clear.at(0, 0).x / clear.alpha_at(0, 0), core::Transfer::srgb) == 255);
    CHECK(clear.at(0, 0).y == 0.0F);
}

TEST_CASE("legend, axes, scale bar, labels and distances do not meet") {
    const Drawn figure = GENERATE(drawn("element"), drawn("charge"));
    Annotations annotations{.legend = true,
                            .scale_bar = 0.0,
                            .axes = Axes::of_space,
                            .labels = {label_words_of("--label", "element O: {element}"),
                                       label_words_of("--label", "element H: {element}{index}")},
                            .distances = {distance_words_of("--distance", "index 3: index 4")}};
    annotations.is_steady = GENERATE(false, true);
    annotations.axes_on_right = GENERATE(false, true);
    const auto [width, height] = GENERATE(std::pair(800, 600), std::pair(300, 225),
                                          std::pair(160, 120), std::pair(120, 160));
    AnnotatedView view = view_of(figure);
    view.width = width;
    view.height = height;
    std::vector<std::string> remarks;
    const Sheet sheet = sheet_of(annotations, figure.legend, view,
                                 [&](const std::string& remark) { remarks.push_back(remark); });
    CAPTURE(width, height, annotations.is_steady);
    struct Part {
        std::string name;
        Box box;
    };
    std::vector<Part> parts;
    for (const MarkGroup& group : sheet.groups)
        for (const Mark& mark : group.marks)
            // The line of a distance may cross others.
            if (!group.name.starts_with("distance") || std::holds_alternative<SheetText>(mark))
                parts.push_back({group.name, box_of(mark)});
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto& [name, box] = parts[i];
        const bool is_at_atoms = name.starts_with("label") || name.starts_with("distance");
        const bool is_in =
            box.left >= 0.0 && box.top >= 0.0 && box.right <= width && box.bottom <= height;
        CHECK((is_at_atoms || is_in));
        for (std::size_t j = 0; j < i; ++j) {
            CAPTURE(name, parts[j].name);
            const bool are_labels = name.starts_with("label") && parts[j].name.starts_with("label");
            CHECK((are_labels || name == parts[j].name || !box.meets(parts[j].box)));
        }
    }
    const bool has_all = has(svg_of(sheet), "id=\"axes\"") &&
                         has(svg_of(sheet), "id=\"scale-bar\"") &&
                         has(svg_of(sheet), "id=\"legend");
    const bool is_reported = std::any_of(remarks.begin(), remarks.end(), [](const auto& remark) {
        return has(remark, "for lack of space in an image of");
    });
    CHECK(has_all != is_reported);
    CHECK((has_all || width < 300));
}

TEST_CASE("annotations without room are reported") {
    const Drawn figure = drawn("element");
    AnnotatedView view = view_of(figure);
    view.width = 40;
    view.height = 30;
    std::vector<std::string> remarks;
    const Sheet sheet =
        sheet_of({.legend = true, .scale_bar = 0.0, .axes = Axes::of_space}, figure.legend, view,
                 [&](const std::string& remark) { remarks.push_back(remark); });
    CHECK(sheet.groups.size() < 3);
    CHECK(std::any_of(remarks.begin(), remarks.end(), [](const auto& remark) {
        return has(remark, "for lack of space in an image of 40 x 30");
    }));
}

TEST_CASE("the texts of a distance and of a label are not on one place") {
    const Drawn figure = drawn("element");
    Annotations annotations;
    annotations.labels = {label_words_of("--label", "element H: a long label at the middle")};
    annotations.distances = {distance_words_of("--distance", "index 3: index 4"),
                             distance_words_of("--distance", "index 4: index 3")};
    const Sheet sheet = sheet_of(annotations, figure.legend, view_of(figure), {});
    REQUIRE(sheet.groups.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < i; ++j)
            CHECK(
                !box_of(sheet.groups[i].marks.back()).meets(box_of(sheet.groups[j].marks.back())));
}

TEST_CASE("atoms that the image does not show have no labels and distances") {
    const auto cut = [](Drawing& d) {
        d.style = Style::spheres;
        d.cuts = {cut_plane_of("--cut", "x<1.4")}; // O is at 3, with a radius of 1.52
    };
    const auto hide = [](Drawing& d) { d.hide = {"element O"}; };
    const auto slab = [](Drawing& d) {
        d.style = Style::spheres;
        d.view = core::NamedView{"", {-1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
        d.slab = std::pair(-3.0, -0.3); // depths grow with x; the middle is 1.5
    };
    const Drawn of = drawn_of(
        "a.xyz", atoms, GENERATE_COPY(values<std::function<void(Drawing&)>>({cut, hide, slab})));
    std::vector<std::string> remarks;
    CHECK(labels_of(of, "all: {element}{index}", remarks) == "C1 H3 H4 ");
    CHECK(remarks.empty());
    CHECK(labels_of(of, "element O: {element}", remarks).empty());
    REQUIRE(remarks.size() == 1);
    CHECK(remarks[0] == "--label \"element O\" is left out, as the image does not show its atoms");
    Annotations distances;
    distances.distances = {distance_words_of("--distance", "index 1: index 2")};
    CHECK(remarks_of(distances, of) ==
          std::vector<std::string>{"--distance \"index 1: index 2\" is left out, as the image "
                                   "shows no atoms of one of its ends"});
    CHECK(svg(distances, of).find("3.00") == std::string::npos);
    CHECK(has(svg(distances, drawn("element")), "3.00"));
}

TEST_CASE("copies of atoms that planes cut away have no labels") {
    const Drawn of = drawn_of(
        "a.xyz", "1\nLattice=\"4 0 0 0 4 0 0 0 4\" pbc=\"T T T\"\nCs 0 0 0\n", [](Drawing& d) {
            d.style = Style::spheres;
            d.radius = "0.5";
            d.cuts = {cut_plane_of("--cut", "x<2")};
            d.view = core::NamedView{"", {-1.0F, -0.3F, -0.2F}, {0.0F, 0.0F, 1.0F}};
        });
    std::vector<std::string> remarks;
    CHECK(labels_of(of, "all: {element}", remarks) == "Cs Cs Cs Cs ");
}

TEST_CASE("the label of a chain is not at its ligand that a cartoon does not show") {
    Legend legend;
    LoadOptions options;
    options.legend = &legend;
    options.drawing.style = Style::cartoon;
    const core::Scene scene = load_scene(RAYLANE_SOURCE_DIR "/scenes/protease.pdb.gz", options);
    core::Camera camera;
    camera.from = {0.0F, 0.0F, 200.0F};
    camera.at = {0.0F, 0.0F, 0.0F};
    const auto place_of = [&](const std::string& label) {
        Annotations annotations;
        annotations.labels = {label_words_of("--label", label)};
        const Sheet sheet =
            sheet_of(annotations, legend, {camera, 800, 600, core::Color(1.0F), &scene}, {});
        REQUIRE(sheet.groups.at(0).marks.size() == 1);
        const Point at = std::get<SheetText>(sheet.groups[0].marks[0]).at;
        return std::pair(at.x, at.y);
    };
    CHECK(place_of("chain A: {chain}") == place_of("chain A and not ligand: {chain}"));
    std::vector<std::string> remarks;
    SheetComposer({.labels = {{"ligand", "L"}}}, legend,
                  [&](const std::string& remark) { remarks.push_back(remark); });
    CHECK(remarks.size() == 1);
}

TEST_CASE("legend and axes stay while the camera moves, if they are steady") {
    const Drawn figure = drawn("element");
    Annotations annotations{.legend = true,
                            .axes = Axes::of_space,
                            .labels = {label_words_of("--label", "all: {index}")},
                            .is_steady = true};
    std::vector<Sheet> sheets;
    for (const float x : {-3.0F, 0.5F, 4.0F}) {
        core::Camera camera = figure.scene.camera();
        camera.from.x += x;
        camera.at.x += 0.2F * x;
        sheets.push_back(sheet_of(annotations, figure.legend, {camera, 300, 225, {}}, {}));
    }
    const auto origin = [](const Sheet& sheet) {
        for (const MarkGroup& group : sheet.groups)
            if (group.name == "axes")
                for (const Mark& mark : group.marks)
                    if (const auto* const line = std::get_if<SheetLine>(&mark)) return line->from;
        return Point{-1.0, -1.0};
    };
    for (const Sheet& sheet : sheets) {
        CHECK(std::abs(origin(sheet).x - origin(sheets[0]).x) < 1e-9);
        CHECK(std::abs(origin(sheet).y - origin(sheets[0]).y) < 1e-9);
    }
}

TEST_CASE("a legend that is refused says why") {
    const auto message = [](const Drawn& figure, const Annotations& annotations) {
        return tests::message_of<BadInput>([&] { svg(annotations, figure); });
    };
    CHECK(message(drawn("orange"), {.legend = true, .is_legend_implied = true}) ==
          "--legend-title: must have colours of elements, chains or numbers to explain, but the "
          "atoms have colours by name");
    const Drawn scene =
        drawn_of("a.json", R"({"camera": "auto", "materials": {"a": {}}, "objects": [{"type":)"
                           R"("sphere", "center": [0, 0, 0], "radius": 1, "material": "a"}]})");
    CHECK(message(scene, {.legend = true}) ==
          "--legend: goes with a file of atoms, not with a scene");
    Drawn rainbow = drawn("orange");
    rainbow.legend.has_too_many_colors = true;
    CHECK(message(rainbow, {.legend = true}) ==
          "--legend: must have at most 64 colours to explain, got more: colours of residues have "
          "no legend");
    CHECK(tests::message_of<BadInput>([] { label_words_of("--label", "index 1: {element"); }) ==
          "--label: must have a } behind each {, got \"{element\"");
}

TEST_CASE("options of annotations have the words of the command line") {
    Annotations annotations;
    annotations.has_dashes = false;
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"legend", "on"},
                                     {"legend_title", "Atoms"},
                                     {"scale_bar", "2.5"},
                                     {"triad", "on"},
                                     {"labels", "index 1: a"},
                                     {"labels", "all: b"},
                                     {"--distance", "index 1: index 2"},
                                     {"font", "serif"},
                                     {"font_size", "12"}})
        CHECK(set_option(annotations, name, text));
    CHECK(annotations.legend);
    CHECK(!annotations.is_legend_implied);
    CHECK(annotations.legend_title == "Atoms");
    CHECK(*annotations.scale_bar == 2.5);
    CHECK(*annotations.axes == Axes::automatic);
    CHECK(annotations.labels.at(1).option == "labels/1");
    CHECK(annotations.distances.at(0).to == "index 2");
    CHECK(annotations.font_size == 50.0); // 12 points at 300 pixels per inch
    CHECK(annotations.option("scale-bar") == "scale_bar");
    CHECK(!set_option(annotations, "style", "balls"));
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"legend", "yes"},
                                     {"scale_bar", "0"},
                                     {"triad", "abx"},
                                     {"labels", "all"},
                                     {"font_size", "0.5"}})
        CHECK_THROWS_AS(set_option(annotations, name, text), BadInput);
}

TEST_CASE("an overlay of codes is blended over codes") {
    CHECK(over(0, 0x123456) == 0x123456);
    CHECK(over(0xFFABCDEF, 0x123456) == 0xABCDEF);
    CHECK(over(0x80800000U, 0xFFFFFF) == 0xFF7F7F);
}
