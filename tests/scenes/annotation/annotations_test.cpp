#include "core/scene/camera_rays.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/annotation/annotations.hpp"
#include "scenes/annotation/projector.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/support/catch.hpp"

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

Drawn drawn(const std::string& color) {
    Legend legend;
    LoadOptions options;
    options.legend = &legend;
    options.drawing.color = color;
    core::Scene scene = parse_scene("a.xyz", atoms, options);
    return {std::move(scene), std::move(legend)};
}

AnnotatedView view_of(const Drawn& of) {
    return {of.scene.camera(), 800, 600, of.scene.background()};
}

std::string svg(const Annotations& annotations, const Drawn& of) {
    return svg_of(sheet_of(annotations, of.legend, view_of(of), {}));
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
    const Drawn of = drawn("charge");
    REQUIRE(of.legend.colors.size() == 1);
    CHECK(of.legend.colors[0].property == "charge");
    CHECK(of.legend.colors[0].range == ColorRange(-1.0, 3.0));
    const std::string text = svg({.legend = true}, of);
    CHECK(has(text, "<g id=\"legend-charge\">"));
    CHECK(has(text, ">Charge (e)</text>"));
    CHECK(has(text, ">\u22121</text>"));
    CHECK(has(text, ">3</text>"));
    CHECK(has(svg({.legend = true, .legend_title = "a < b & c"}, of), ">a &lt; b &amp; c</text>"));
}

TEST_CASE("a legend of elements has those that are shown") {
    const Drawn of = drawn("element");
    REQUIRE(of.legend.colors.size() == 1);
    CHECK(of.legend.colors[0].entries.size() == 3);
    const std::string text = svg({.legend = true}, of);
    CHECK(text.find(">C</text>") < text.find(">H</text>"));
    CHECK(text.find(">H</text>") < text.find(">O</text>"));
    CHECK_THROWS_AS(svg({.legend = true}, drawn("orange")), BadInput);
}

TEST_CASE("labels and distances are at the middles of their atoms") {
    const Drawn of = drawn("element");
    Annotations annotations;
    annotations.labels = {label_words_of("--label", "element H: {element}{index}"),
                          label_words_of("--label", "element H: both")};
    annotations.distances = {distance_words_of("--distance", "index 1: element O")};
    annotations.font_size = 20.0;
    const std::string text = svg(annotations, of);
    CHECK(has(text, ">H3</text>"));
    CHECK(has(text, ">H4</text>"));
    CHECK(has(text, ">3.00 \u00c5</text>"));
    const auto middle = Projector(of.scene.camera(), 800, 600).point_of(core::Vec3d(0.0));
    const Sheet sheet = sheet_of(annotations, of.legend, view_of(of), {});
    REQUIRE(sheet.groups.back().name == "label-2");
    const auto& label = std::get<SheetText>(sheet.groups.back().marks.at(0));
    CHECK(std::abs(label.at.x - middle->x) < 1e-9);
    CHECK_THROWS_AS(label_words_of("--label", "element H"), BadInput);
    annotations.labels = {{"element Fe", "iron"}};
    CHECK_THROWS_AS(svg(annotations, of), BadInput);
}

TEST_CASE("a scale bar is as long as it says") {
    Drawn of = drawn("element");
    core::Camera camera = of.scene.camera();
    camera.projection = core::Projection::orthographic;
    camera.height = 12.0F;
    const Sheet sheet =
        sheet_of({.scale_bar = 2.0}, of.legend, {camera, 800, 600, core::Color(1.0F)}, {});
    const auto& bar = std::get<SheetLine>(sheet.groups.at(0).marks.at(0));
    CHECK(std::abs(bar.to.x - bar.from.x - 100.0) < 1e-9);
    CHECK(std::get<SheetText>(sheet.groups[0].marks.at(1)).text == "2 \u00c5");
    CHECK_THROWS_AS(svg({.axes = Axes::of_cell}, of), BadInput);
    CHECK(has(svg({.axes = Axes::of_space}, of), ">x</text>"));
}

TEST_CASE("texts of any bytes are texts of XML") {
    const Drawn of = drawn("element");
    const std::string text = svg({.labels = {{"index 1", "a<b]]>\xe9"}}}, of);
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
