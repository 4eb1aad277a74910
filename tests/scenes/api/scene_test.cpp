#include "raylane/raylane.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "tests/scenes/api/in_library.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

#include <array>
#include <limits>
#include <string>
#include <utility>

using namespace raylane;
using library::Internals;
using tests::message_of;

namespace {

const std::string around = R"({"camera": {"from": [0, 0, 90], "at": [0, 0, 0]},
    "lights": [{"type": "directional", "direction": [0, -1, 0]}], "materials": {"m": {}},
    "objects": [)";

std::string with_objects(const std::string& objects) {
    return around + objects + "]}";
}

bool same_shapes(const core::Scene& a, const core::Scene& b) {
    bool same = true;
    core::for_each_table(a.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        const auto& other = std::get<core::Table<Shape>>(b.shapes());
        same &= table.size() == 1 && other.size() == 1;
        if (!same) return;
        const core::Place first{0, 0};
        same &= core::numbers_of(table.get(first)) == core::numbers_of(other.get(first)) &&
                table.id(first) == other.id(first);
    });
    return same;
}

Scene ball() {
    SceneBuilder builder;
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    return builder.build();
}

} // namespace

TEST_CASE("every kind of shape has its fields in a file's order") {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    ShapeId count = 0;
    std::string objects;
    core::for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        using InLibrary = typename tests::InLibrary<core::InDouble<Shape>>::Type;
        CHECK(builder.add(tests::Written<Shape>::template by_name<InLibrary>(), m) == count++);
        objects += (objects.empty() ? "{" : ", {") + std::string(tests::Written<Shape>::text) +
                   R"(, "material": "m"})";
    });
    CHECK(builder.shape_count() == static_cast<std::size_t>(core::kind_count));
    const Scene built = builder.build();
    CHECK(same_shapes(Internals::of(built), Internals::of(parse(with_objects(objects)))));
}

TEST_CASE("a scene returns all values that its builder was given") {
    SceneBuilder builder;
    builder.camera = {.projection = Projection::orthographic,
                      .from = {1, 2, 3},
                      .at = {4, 5, 6.5F},
                      .up = {0, 0, 2},
                      .field_of_view = 30,
                      .height = 3.5F,
                      .lens_radius = 0.5F,
                      .focus_distance = 6};
    builder.background = {0.1F, 0.2F, 0.3F};
    builder.fog = {
        .kind = FogKind::linear_z, .color = {0.4F, 0.5F, 0.6F}, .start = 7, .end = 8, .density = 9};
    builder.settings = {.width = 30,
                        .height = 40,
                        .grid = 2,
                        .samples = SamplePattern::stratified,
                        .quality = 40,
                        .filter = PixelFilter::gaussian,
                        .light_samples = 3,
                        .transfer = Transfer::linear,
                        .alpha = true,
                        .max_depth = 5,
                        .min_weight = 0.25F,
                        .outline = {.width = 2, .color = {0, 0.5F, 1}, .creases = 30}};
    builder.add_light({.position = {1, 2, 3}, .color = {4, 5, 6}});
    builder.add_light({.kind = LightKind::directional, .direction = {7, 8, 9}});
    builder.add_light({.kind = LightKind::sky, .ground = {0.5F, 0.25F, 0}, .reach = 4});
    builder.add_light(
        {.kind = LightKind::rectangle, .radius = 2, .edge_u = {0, 3, 0}, .edge_v = {4, 0, 0}});
    builder.add_material({});
    const MaterialIndex m = builder.add_material({.pattern = {.kind = PatternKind::gradient,
                                                              .colors = {{1, 2, 3}, {4, 5, 6}},
                                                              .size = 7,
                                                              .axes = 2,
                                                              .direction = {8, 9, 10},
                                                              .from = {11, 12, 13},
                                                              .to = {14, 15, 16}},
                                                  .ambient = 17,
                                                  .diffuse = 18,
                                                  .specular = 19,
                                                  .exponent = 20,
                                                  .reflection = Reflection::dielectric,
                                                  .reflectivity = 0.21F,
                                                  .transmission = 0.22F,
                                                  .index = 23,
                                                  .absorption = {24, 25, 26},
                                                  .visible = Visible::inside,
                                                  .opacity = 0.27F});
    builder.add(Sphere{{0, 0, 0}, 1}, m);
    const Scene scene = builder.build();

    const Camera camera = scene.camera();
    CHECK(camera.projection == Projection::orthographic);
    CHECK(camera.from == Vec3{1, 2, 3});
    CHECK(camera.at == Vec3{4, 5, 6.5F});
    CHECK(camera.up == Vec3{0, 0, 2});
    CHECK(camera.field_of_view == 30);
    CHECK(camera.height == 3.5F);
    CHECK((camera.lens_radius == 0.5F && camera.focus_distance == 6));
    CHECK(scene.background() == Vec3{0.1F, 0.2F, 0.3F});
    const Fog fog = scene.fog();
    CHECK(fog.kind == FogKind::linear_z);
    CHECK(fog.color == Vec3{0.4F, 0.5F, 0.6F});
    CHECK((fog.start == 7 && fog.end == 8 && fog.density == 9));
    const Settings settings = scene.settings();
    CHECK((settings.width == 30 && settings.height == 40 && settings.grid == 2));
    CHECK(settings.samples == SamplePattern::stratified);
    CHECK(settings.quality == 40);
    CHECK(settings.filter == PixelFilter::gaussian);
    CHECK(settings.light_samples == 3);
    CHECK(settings.transfer == Transfer::linear);
    CHECK(settings.alpha);
    CHECK((settings.max_depth == 5 && settings.min_weight == 0.25F));
    CHECK((settings.outline.width == 2 && settings.outline.creases == 30));
    CHECK((settings.outline.color.y == 0.5F && settings.outline.color.z == 1));

    const std::vector<Light> lights = scene.lights();
    REQUIRE(lights.size() == 4);
    CHECK(lights[0].kind == LightKind::point);
    CHECK(lights[0].position == Vec3{1, 2, 3});
    CHECK(lights[0].color == Vec3{4, 5, 6});
    CHECK(lights[1].kind == LightKind::directional);
    CHECK(lights[1].direction == Vec3{7, 8, 9});
    CHECK(lights[2].kind == LightKind::sky);
    CHECK(lights[2].ground == Vec3{0.5F, 0.25F, 0});
    CHECK(lights[2].reach == 4);
    CHECK(lights[3].kind == LightKind::rectangle);
    CHECK(lights[3].radius == 2);
    CHECK(lights[3].edge_u == Vec3{0, 3, 0});
    CHECK(lights[3].edge_v == Vec3{4, 0, 0});

    REQUIRE(scene.material_count() == 2);
    CHECK(scene.material_of(0) == m);
    const Material material = scene.material(m);
    CHECK(material.pattern.kind == PatternKind::gradient);
    CHECK(material.pattern.colors[0] == Vec3{1, 2, 3});
    CHECK(material.pattern.colors[1] == Vec3{4, 5, 6});
    CHECK((material.pattern.size == 7 && material.pattern.axes == 2));
    CHECK(material.pattern.direction == Vec3{8, 9, 10});
    CHECK(material.pattern.from == Vec3{11, 12, 13});
    CHECK(material.pattern.to == Vec3{14, 15, 16});
    CHECK((material.ambient == 17 && material.diffuse == 18));
    CHECK((material.specular == 19 && material.exponent == 20));
    CHECK(material.reflection == Reflection::dielectric);
    CHECK((material.reflectivity == 0.21F && material.transmission == 0.22F));
    CHECK(material.index == 23);
    CHECK(material.absorption == Vec3{24, 25, 26});
    CHECK(material.visible == Visible::inside);
    CHECK(material.opacity == 0.27F);
}

TEST_CASE("values that are not set have the defaults of a file") {
    SceneBuilder builder;
    builder.camera.from = {0, 0, 90};
    builder.add_light({.kind = LightKind::directional});
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    const Scene built = builder.build();
    const Scene parsed = parse(
        with_objects(R"({"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1})"));
    const core::Material &a = Internals::of(built).materials()[0],
                         &b = Internals::of(parsed).materials()[0];
    CHECK(a.pattern.kind == b.pattern.kind);
    CHECK(a.pattern.colors == b.pattern.colors);
    CHECK((a.ambient == b.ambient && a.diffuse == b.diffuse && a.specular == b.specular));
    CHECK((a.exponent == b.exponent && a.reflection == b.reflection && a.index == b.index));
    CHECK((a.reflectivity == b.reflectivity && a.transmission == b.transmission));
    CHECK((a.absorption == b.absorption && a.visible == b.visible));
    CHECK(built.camera().field_of_view == parsed.camera().field_of_view);
    CHECK(built.settings().max_depth == parsed.settings().max_depth);
    CHECK(built.settings().width == parsed.settings().width);
    CHECK(built.background() == parsed.background());
}

TEST_CASE("each enumerator of the library equals core's of that name") {
    const auto same = [](auto ours, auto theirs) {
        return static_cast<int>(ours) == static_cast<int>(theirs);
    };
    CHECK(same(PatternKind::checker, core::PatternKind::checker));
    CHECK(same(PatternKind::stripes, core::PatternKind::stripes));
    CHECK(same(PatternKind::gradient, core::PatternKind::gradient));
    CHECK(same(PatternKind::formula, core::PatternKind::formula));
    CHECK(same(PatternKind::image, core::PatternKind::image));
    CHECK(same(PatternKind::cutaway, core::PatternKind::cutaway));
    CHECK(same(PatternSpace::object, core::PatternSpace::object));
    CHECK(same(ImageWrap::clamp, core::ImageWrap::clamp));
    CHECK(same(Highlight::phong, core::Highlight::phong));
    CHECK(same(Reflection::schlick, core::Reflection::schlick));
    CHECK(same(Reflection::dielectric, core::Reflection::dielectric));
    CHECK(same(Visible::outside, core::Visible::outside));
    CHECK(same(Visible::inside, core::Visible::inside));
    CHECK(same(LightKind::directional, core::LightKind::directional));
    CHECK(same(FogKind::linear_z, core::FogKind::linear_z));
    CHECK(same(FogKind::linear, core::FogKind::linear));
    CHECK(same(FogKind::exponential, core::FogKind::exponential));
    CHECK(same(Projection::orthographic, core::Projection::orthographic));
    CHECK(same(Transfer::linear, core::Transfer::linear));
    CHECK(same(SamplePattern::stratified, core::SamplePattern::stratified));
    CHECK(same(PixelFilter::gaussian, core::PixelFilter::gaussian));
    CHECK(same(PixelFilter::blackman_harris, core::PixelFilter::blackman_harris));
    CHECK(no_shape == core::no_shape);
}

TEST_CASE("an invalid value is refused and the builder stays usable") {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    try {
        builder.add(Sphere{{0, 0, 0}, -1}, m);
        FAIL("not refused");
    } catch (const InvalidValue& invalid) {
        CHECK(invalid.field == "radius");
        CHECK(invalid.expectation == "must be positive, got -1");
        CHECK(std::string(invalid.what()) == "radius: must be positive, got -1");
    }
    const auto message = [](const auto& act) { return message_of<InvalidValue>(act); };
    CHECK(message([&] { builder.add(Sphere{}, m); }) == "radius: must be positive, got 0");
    CHECK(message([&] {
              builder.add(SphereOf<double>{{0, 0, 0}, 1e-40}, m);
          }) == "radius: must be at least 1.2e-38, got 1e-40");
    CHECK(message([&] {
              builder.add(SphereOf<double>{{1e-40, 0, 0}, 1}, m);
          }) == "center/0: must be 0 or at least 1.2e-38 in size, got 1e-40");
    CHECK(message([&] { builder.add(Plane{}, m); }) ==
          "normal: must not be the zero vector, got [0, 0, 0]");
    CHECK(message([&] {
              builder.add(Sphere{{0, 0, 0}, 1}, m + 1);
          }) == "material: must be the index of a material, got 1");
    CHECK(message([&] {
              builder.add_material({.pattern = {.colors = {{0, -1, 0}, {}}}});
          }) == "pattern/colors/0/1: must not be negative, got -1");
    CHECK(message([&] { builder.add_light({.kind = LightKind::directional, .direction = {}}); }) ==
          "direction: must not be the zero vector, got [0, 0, 0]");
    CHECK(message([&] { builder.add_polygon(std::span<const Triangle>(), m); }) ==
          "must have at least one triangle, got none");
    CHECK(builder.shape_count() == 0);
    CHECK(builder.add(Sphere{{0, 0, 0}, 1}, m) == 0);
    CHECK(builder.build().shape_count() == 1);
}

TEST_CASE("the triangles of a polygon are numbered in order and known as coplanar") {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    const std::array<Triangle, 2> halves = {
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
    const Vec3 up{0, 0, 1};
    const std::array<SmoothTriangle, 2> smooth = {{{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, up, up, up},
                                                   {{0, 0, 2}, {1, 1, 2}, {0, 1, 2}, up, up, up}}};
    const auto message = [](const auto& act) { return message_of<InvalidValue>(act); };
    std::array<SmoothTriangle, 2> wrong = smooth;
    wrong[1].normal_b = {};
    CHECK(message([&] { builder.add_polygon(wrong, m); }) ==
          "1/normals/1: must not be the zero vector, got [0, 0, 0]");
    const std::array<Triangle, 2> thin = {halves[0], {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}};
    CHECK(message([&] {
              builder.add_polygon(thin, m);
          }).starts_with("1: must have three corners that are not collinear"));
    CHECK(builder.shape_count() == 0);
    CHECK(builder.add(Sphere{{0, 0, 0}, 1}, m) == 0);
    CHECK(builder.add_polygon(halves, m) == 1);
    CHECK(builder.add_polygon(smooth, m) == 3);
    const Scene scene = builder.build();
    CHECK(scene.shape_count() == 5);
    CHECK(Internals::of(scene).coplanar_with(2).first == 1);
    CHECK(Internals::of(scene).coplanar_with(3).last == 4);
}

TEST_CASE("build checks the whole scene and empties the builder") {
    const auto message = [](const auto& act) { return message_of<InvalidValue>(act); };
    SceneBuilder builder;
    builder.camera.at = builder.camera.from;
    CHECK(message([&] { builder.build(); }) ==
          "camera/at: must differ from \"from\", got [0, 0, 5]");
    CHECK(builder.build().shape_count() == 0);

    builder.background = {-1, 0, 0};
    CHECK(message([&] { builder.build(); }) == "background/0: must not be negative, got -1");
    builder.settings.grid = 0;
    CHECK(message([&] { builder.build(); }) == "settings/grid: must be from 1 to 256, got 0");

    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    builder.add_light({.position = {0, 0, 1}});
    CHECK(message([&] { builder.build(); }) ==
          "lights/0/position: must not be on a surface, got a point of shape 0");
    CHECK(builder.shape_count() == 0);
    CHECK(builder.build().material_count() == 0);
}

TEST_CASE("builders can be moved and scenes can be copied and moved") {
    SceneBuilder builder;
    builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    SceneBuilder other = std::move(builder);
    Scene scene = other.build();
    Scene copy = scene;
    const Scene moved = std::move(scene);
    CHECK(moved.shape_count() == 1);
    CHECK(scene.shape_count() == 1); // NOLINT: a scene is never empty
    copy = SceneBuilder().build();
    CHECK(copy.shape_count() == 0);
    CHECK(moved.shape_count() == 1);
}

TEST_CASE("an index behind the last shape or material is refused") {
    const Scene scene = ball();
    CHECK(message_of<InvalidValue>([&] { scene.material_of(1); }) ==
          "must be one of 1 shapes, got 1");
    CHECK_THROWS_AS(scene.material_of(no_shape), InvalidValue);
    CHECK_THROWS_AS(scene.material(1), InvalidValue);
}

TEST_CASE("the headers' version is the library's") {
    CHECK(std::string(version()) == RAYLANE_VERSION);
    CHECK(version_number() == RAYLANE_VERSION_NUMBER);
    CHECK(std::string(RAYLANE_VERSION) == std::to_string(RAYLANE_VERSION_MAJOR) + "." +
                                              std::to_string(RAYLANE_VERSION_MINOR) + "." +
                                              std::to_string(RAYLANE_VERSION_PATCH));
}

TEST_CASE("a moved-from builder is empty and can be reused") {
    SceneBuilder first;
    first.camera.from = {1, 2, 3};
    first.background = {1, 0, 0};
    first.settings.width = 7;
    first.add(Sphere{{0, 0, 0}, 1}, first.add_material({}));
    SceneBuilder second = std::move(first);
    CHECK(second.shape_count() == 1);
    CHECK(first.shape_count() == 0);
    CHECK(first.camera.from == Camera{}.from);
    CHECK(first.background == Color{});
    CHECK(first.add_material({}) == 0);
    CHECK(first.add(Sphere{{0, 0, 0}, 2}, 0) == 0);
    CHECK(first.build().settings().width == Settings{}.width);
    first = std::move(second);
    CHECK(second.build().shape_count() == 0);
    const SceneBuilder& itself = first;
    first = std::move(const_cast<SceneBuilder&>(itself));
    const Scene scene = first.build();
    CHECK(scene.shape_count() == 1);
    CHECK(scene.settings().width == 7);
    CHECK(scene.camera().from == Vec3{1, 2, 3});
}

TEST_CASE("a material has the formula that it was given, and a mistake is refused") {
    const auto material = [](const ChannelTexts& texts) {
        return Material{.pattern = {.kind = PatternKind::formula, .formula = texts}};
    };
    SceneBuilder builder;
    builder.camera.from = {0, 0, 9};
    const ChannelTexts texts = {"abs(cos(x))", "y < 0 ? 0 : 1", "0.5"};
    const MaterialIndex index = builder.add_material(material(texts));
    builder.add_material({});
    CHECK(message_of<InvalidValue>([&] {
              builder.add_material(material({"x", "y +", "0"}));
          }) ==
          "pattern/formula/1: must be a formula: line 1, column 4: expected a number, a name or "
          "\"(\", got the end");
    CHECK(message_of<InvalidValue>([&] { builder.add_material(material({})); }) ==
          "pattern/formula: must be three formulas, got none");
    builder.add(Sphere{{0, 0, 0}, 1}, index);
    builder.add_light({.position = {9, 9, 9}});
    const Scene scene = std::move(builder).build();
    CHECK(scene.material(0).pattern.kind == PatternKind::formula);
    CHECK(scene.material(0).pattern.formula == texts);
    CHECK(scene.material(1).pattern.formula == ChannelTexts{});
}

TEST_CASE("a number that matches no enumerator is refused") {
    SceneBuilder builder;
    const auto message = [](const auto& call) { return message_of<InvalidValue>(call); };
    const auto material = [&](const Material& wrong) {
        return message([&] { builder.add_material(wrong); });
    };
    CHECK(material({.pattern = {.kind = static_cast<PatternKind>(7)}}) ==
          "pattern/kind: must be one of its enumerators, 0 to 6, got 7");
    CHECK(material({.highlight = static_cast<Highlight>(2)}).starts_with("highlight: must be"));
    CHECK(material({.reflection = static_cast<Reflection>(3)}).starts_with("reflection: must be"));
    CHECK(material({.visible = static_cast<Visible>(255)}).starts_with("visible: must be"));
    CHECK(message([&] {
              builder.add_light({.kind = static_cast<LightKind>(6)});
          }).starts_with("kind: must be"));
    const auto built = [&](auto change) {
        SceneBuilder wrong;
        change(wrong);
        return message([&] { wrong.build(); });
    };
    CHECK(built([](SceneBuilder& b) {
              b.fog.kind = static_cast<FogKind>(4);
          }).starts_with("fog/kind: must be"));
    CHECK(built([](SceneBuilder& b) {
              b.camera.projection = static_cast<Projection>(2);
          }).starts_with("camera/projection: must be"));
    CHECK(built([](SceneBuilder& b) {
              b.settings.samples = static_cast<SamplePattern>(2);
          }).starts_with("settings/samples: must be"));
    CHECK(built([](SceneBuilder& b) {
              b.settings.filter = static_cast<PixelFilter>(3);
          }).starts_with("settings/filter: must be"));
    CHECK(built([](SceneBuilder& b) {
              b.settings.quality = 5;
          }).starts_with("settings/quality: must be"));
    CHECK(built([](SceneBuilder& b) {
              b.settings.transfer = static_cast<Transfer>(2);
          }).starts_with("settings/transfer: must be"));
}

TEST_CASE("the bounds of a scene enclose all shapes except planes") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    builder.add(Plane{{0, -1, 0}, {0, 1, 0}}, material);
    const Bounds empty = builder.build().bounds();
    CHECK(empty.lower == Vec3{infinity, infinity, infinity});
    CHECK(empty.upper == Vec3{-infinity, -infinity, -infinity});

    builder.add_material({});
    builder.add(Plane{{0, -100, 0}, {0, 1, 0}}, material);
    builder.add(Sphere{{1, 2, 3}, 0.5F}, material);
    builder.add(CappedCylinder{{-4, 0, 0}, {0, 0, 5}, 0.25F}, material);
    const Bounds bounds = builder.build().bounds();
    const auto close = [](const Vec3& outer, const Vec3& truth, float side) {
        const auto within = [&](float a, float b) {
            return side * (a - b) >= 0.0F && side * (a - b) < 1e-5F;
        };
        return within(outer.x, truth.x) && within(outer.y, truth.y) && within(outer.z, truth.z);
    };
    CHECK(close(bounds.lower, {-4.25F, -0.25F, 0}, -1));
    CHECK(close(bounds.upper, {1.5F, 2.5F, 5}, 1));
}
