#include "core/scene/fields.hpp"
#include "raylane/raylane.hpp"
#include "tests/places.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

/// The builder knows all that a JSON file can say: each key, each type and each word of the schema
/// is in a scene below, which a builder makes with the same bits.
using namespace raylane;

namespace {

using nlohmann::json;
using Words = std::set<std::string>;

constexpr MaterialIndex m = 0, n = 1; ///< materials of the base

const json base = json::parse(R"({
    "image": {"width": 24, "height": 18}, "camera": {"from": [1, 2, 9], "at": [0, 0, 0]},
    "lights": [{"type": "point", "position": [5, 9, 7]}],
    "materials": {"m": {"color": [0.8, 0.3, 0.2]},
                  "n": {"color": [0.1, 0.4, 0.9], "reflectivity": 0.25}},
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1.5, "material": "m"}]})");

/// Keys that replace those of the base, and the same in code.
struct Case {
    const char* name;
    std::string keys;
    std::function<void(SceneBuilder&)> build;
};

/// Gives a builder the values of the base that the keys do not replace.
void give_base(SceneBuilder& builder, const json& keys) {
    builder.settings.width = 24;
    builder.settings.height = 18;
    builder.camera.from = {1, 2, 9};
    if (!keys.contains("lights")) builder.add_light({.position = {5, 9, 7}});
    if (!keys.contains("materials")) {
        builder.add_material({.pattern = {.colors = {{0.8F, 0.3F, 0.2F}}}}, "m");
        builder.add_material({.pattern = {.colors = {{0.1F, 0.4F, 0.9F}}}, .reflectivity = 0.25F},
                             "n");
    }
    if (!keys.contains("objects")) builder.add(Sphere{{0, 0, 0}, 1.5F}, m);
}

template <class Value>
bool same_bits(const Value& a, const Value& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Returns true for shapes of one type with the same bits.
bool same_shape(const ShapeVariant& a, const ShapeVariant& b) {
    return a.index() == b.index() &&
           std::visit([&]<class Shape>(
                          const Shape& shape) { return same_bits(shape, std::get<Shape>(b)); },
                      a);
}

void check_same(const Scene& built, const Scene& read) {
    REQUIRE(built.shape_count() == read.shape_count());
    for (ShapeId id = 0; id < built.shape_count(); ++id) {
        CAPTURE(id);
        CHECK(same_shape(built.shape(id), read.shape(id)));
        CHECK(built.material_of(id) == read.material_of(id));
        CHECK(built.solid_of(id) == read.solid_of(id));
    }
    REQUIRE(built.material_count() == read.material_count());
    for (MaterialIndex index = 0; index < built.material_count(); ++index) {
        CAPTURE(index);
        CHECK(built.material_name(index) == read.material_name(index));
        CHECK(built.material(index).pattern.colors[0] == read.material(index).pattern.colors[0]);
        CHECK(built.material(index).index == read.material(index).index);
    }
    CHECK(built.lights().size() == read.lights().size());
    CHECK(built.camera().from == read.camera().from);
    const Image image = render(built), other = render(read);
    CHECK(image.rgb == other.rgb);
    CHECK(image.alpha == other.alpha);
}

void check_case(const Case& one) {
    CAPTURE(one.name);
    const json keys = json::parse(one.keys);
    json scene = base;
    scene.update(keys);
    SceneBuilder builder;
    give_base(builder, keys);
    one.build(builder);
    check_same(builder.build(), parse(scene.dump(), "scene.json"));
}

Case shapes() {
    return {"shapes", R"({"objects": [
            {"type": "sphere", "center": [0, 0.1, 0], "radius": 1, "material": "m"},
            {"type": "plane", "point": [0, -2, 0], "normal": [0, 1, 0.1], "material": "n"},
            {"type": "disc", "center": [2, 0, 0], "normal": [0, 0, 1], "radius": 0.7,
             "material": "m"},
            {"type": "triangle", "a": [0, 2, 0], "b": [1, 2, 0], "c": [0, 3, 0.1], "material": "m"},
            {"type": "triangle", "a": [0, 2, 1], "b": [1, 2, 1], "c": [0, 3, 1],
             "normals": [[0, 0, 1], [0, 0.1, 1], [0.1, 0, 1]], "material": "m"},
            {"type": "box", "corner": [-3, 0, 0], "edges": [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]],
             "material": "n"},
            {"type": "box", "min": [-3.1, 1.5, 0], "max": [-2, 2.2, 0.3], "material": "m"},
            {"type": "cylinder", "base": [-1, -1, 2], "axis": [0, 0.1, 1], "radius": 0.3,
             "material": "m"},
            {"type": "cylinder", "base": [1, -1, 2], "axis": [0, 0.1, 1], "radius": 0.3,
             "capped": false, "material": "m"},
            {"type": "cone", "base": [-2, -1, 2], "axis": [0, 1, 0], "base_radius": 0.3,
             "material": "m"},
            {"type": "cone", "base": [2, -1, 2], "axis": [0, 1, 0], "base_radius": 0.3,
             "top_radius": 0.1, "capped": false, "material": "n"},
            {"type": "quadric", "center": [0, -1.2, 1], "matrix": [[1, 0.1, 0, 0],
             [0.1, -1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -0.2]], "lower": [-1, -0.5, -1],
             "upper": [1, 0.5, 1], "material": "m"},
            {"type": "ellipsoid", "center": [3, 1, 0], "material": "n",
             "axes": [[0.5, 0.1, 0], [0, 1, 0], [0, 0, 0.3]]}]})",
            [](SceneBuilder& to) {
                to.add(SphereOf<double>{{0, 0.1, 0}, 1}, m);
                to.add(PlaneOf<double>{{0, -2, 0}, {0, 1, 0.1}}, n);
                to.add(DiscOf<double>{{2, 0, 0}, {0, 0, 1}, 0.7}, m);
                to.add(TriangleOf<double>{{0, 2, 0}, {1, 2, 0}, {0, 3, 0.1}}, m);
                to.add(
                    SmoothTriangleOf<double>{
                        {0, 2, 1}, {1, 2, 1}, {0, 3, 1}, {0, 0, 1}, {0, 0.1, 1}, {0.1, 0, 1}},
                    m);
                to.add(BoxOf<double>{{-3, 0, 0}, {1, 0.1, 0}, {0, 1, 0}, {0, 0, 1}}, n);
                to.add(aligned_box({-3.1, 1.5, 0}, {-2, 2.2, 0.3}), m);
                to.add(CappedCylinderOf<double>{{-1, -1, 2}, {0, 0.1, 1}, 0.3}, m);
                to.add(OpenCylinderOf<double>{{1, -1, 2}, {0, 0.1, 1}, 0.3}, m);
                to.add(CappedConeOf<double>{{-2, -1, 2}, {0, 1, 0}, 0.3, 0}, m);
                to.add(OpenConeOf<double>{{2, -1, 2}, {0, 1, 0}, 0.3, 0.1}, n);
                to.add(QuadricOf<double>{.center = {0, -1.2, 1},
                                         .xx = 1,
                                         .yy = -1,
                                         .zz = 1,
                                         .xy = 0.1,
                                         .one = -0.2,
                                         .lower = {-1, -0.5, -1},
                                         .upper = {1, 0.5, 1}},
                       m);
                to.add(EllipsoidOf<double>{{3, 1, 0}, {0.5, 0.1, 0}, {0, 1, 0}, {0, 0, 0.3}}, n);
            }};
}

Case sphereflake() {
    return {"a sphereflake", R"({"objects": [{"type": "sphereflake", "center": [0.1, 0, 0],
            "radius": 1, "depth": 2, "up": [0, 1, 0.3], "material": "m"}]})",
            [](SceneBuilder& to) {
                to.add(Sphereflake{{0.1F, 0, 0}, 1, 2, {0, 1, 0.3F}}, m);
            }};
}

Case lattices() {
    return {"lattices", R"({"objects": [
            {"type": "lattice", "corner": [-1.1, -1, -1], "n": 3, "spacing": 0.9,
             "sphere_radius": 0.3, "strut_radius": 0.1, "material": "m", "strut_material": "n"},
            {"type": "lattice", "center": [0.1, 2, 0], "n": 2, "spacing": 0.3,
             "sphere_radius": 0.1, "strut_radius": 0.05, "material": "n"}]})",
            [](SceneBuilder& to) {
                const double x = double(-1.1F); // generators round a file's numbers to floats
                to.add(Lattice{{x, -1, -1}, 3, 0.9F, 0.3F, 0.1F}, m, n);
                to.add(centered_at(Lattice{{}, 2, 0.3F, 0.1F, 0.05F}, {double(0.1F), 2, 0}), n);
            }};
}

Case solids() {
    return {"solids", R"({"objects": [
            {"type": "union", "material": "m", "objects": [
                {"type": "sphere", "center": [0, 0, 0], "radius": 1},
                {"type": "sphere", "center": [1, 0, 0], "radius": 0.8, "material": "n"},
                {"type": "sphere", "center": [0, 1, 0], "radius": 0.7}]},
            {"type": "intersection", "material": "n", "objects": [
                {"type": "quadric", "center": [-2, 0, 0], "matrix": [[1, 0, 0, 0], [0, 1, 0, 0],
                 [0, 0, -0.1, 0], [0, 0, 0, -0.3]]},
                {"type": "box", "min": [-3, -1, -1], "max": [-1.5, 1, 1]}]},
            {"type": "difference", "objects": [
                {"type": "box", "min": [-1, -2, 0], "max": [1, -1.2, 1], "material": "m"},
                {"type": "cylinder", "base": [0, -1.5, 0], "axis": [0, 0, 1], "radius": 0.2,
                 "capped": false, "material": "n"},
                {"type": "cone", "base": [0.7, -1.5, 0], "axis": [0, 0, 1.5], "base_radius": 0.2,
                 "capped": false, "material": "n"}]},
            {"type": "clip", "material": "n", "objects": [
                {"type": "sphere", "center": [2.5, 0, 0], "radius": 0.8},
                {"type": "plane", "point": [2.5, 0.3, 0], "normal": [0, 1, 0]}]},
            {"type": "lens", "vertex": [2, 2, 0], "axis": [0, 0.1, 1], "radii": [3, -2],
             "conics": [0, -1], "thickness": 0.5, "radius": 0.6, "material": "m"}]})",
            [](SceneBuilder& to) {
                to.add(SphereOf<double>{{0, 0, 0}, 1} | Solid(SphereOf<double>{{1, 0, 0}, 0.8}, n) |
                           SphereOf<double>{{0, 1, 0}, 0.7},
                       m);
                to.add(intersection_of({QuadricOf<double>{.center = {-2, 0, 0},
                                                          .xx = 1,
                                                          .yy = 1,
                                                          .zz = -0.1,
                                                          .one = -0.3,
                                                          .lower = {},
                                                          .upper = {}},
                                        aligned_box({-3, -1, -1}, {-1.5, 1, 1})}),
                       n);
                to.add(Solid(aligned_box({-1, -2, 0}, {1, -1.2, 1}), m) -
                       Solid(OpenCylinderOf<double>{{0, -1.5, 0}, {0, 0, 1}, 0.2}, n) -
                       Solid(OpenConeOf<double>{{0.7, -1.5, 0}, {0, 0, 1.5}, 0.2, 0}, n));
                to.add(clipped(SphereOf<double>{{2.5, 0, 0}, 0.8},
                               {PlaneOf<double>{{2.5, 0.3, 0}, {0, 1, 0}}}),
                       n);
                to.add(solid_of(Lens{{2, 2, 0}, {0, 0.1, 1}, {3, -2}, {0, -1}, 0.5, 0.6}), m);
            }};
}

Case transforms() {
    return {
        "transforms", R"({"objects": [
            {"type": "sphere", "center": [0.1, 0, 0], "radius": 1, "scale": [1, 0.7, 1.2],
             "rotate": [10, 20, 30], "translate": [0.3, 0.1, 0], "material": "m"},
            {"type": "disc", "center": [2, 0, 0], "normal": [0, 0, 1], "radius": 0.3,
             "scale": 1.3, "rotate": [0, 10, 0], "material": "n"},
            {"type": "cylinder", "base": [-1, -1, 2], "axis": [0, 0.1, 1], "radius": 0.3,
             "capped": false, "transform": [[1, 0.1, 0, 0], [0, 1.2, 0, 0.5], [0, 0.2, 1, 0]],
             "material": "m"},
            {"type": "cone", "base": [-2, -1, 1], "axis": [0, 1, 0], "base_radius": 0.3,
             "scale": [1.1, 1.3, 0.9], "material": "m"},
            {"type": "quadric", "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0],
             [0, 0, 0, -1]], "lower": [-1, -0.5, -1], "upper": [1, 0.5, 1],
             "translate": [0, 2.2, 0], "rotate": [0, 0, 33], "material": "n"},
            {"type": "difference", "material": "n", "rotate": [5, 6, 7], "objects": [
                {"type": "sphere", "center": [2, -1, 0], "radius": 0.8},
                {"type": "cylinder", "base": [2, -1, -1], "axis": [0, 0, 2], "radius": 0.3,
                 "scale": [1, 1.1, 1]}]}]})",
        [](SceneBuilder& to) {
            const auto add = [&](const auto& shape, const Transform& transform, auto material) {
                Group group;
                group.add(shape, material);
                to.add(group.transformed(transform));
            };
            add(SphereOf<double>{{0.1, 0, 0}, 1},
                Transform().scaled({1, 0.7, 1.2}).rotated({10, 20, 30}).translated({0.3, 0.1, 0}),
                m);
            add(DiscOf<double>{{2, 0, 0}, {0, 0, 1}, 0.3},
                Transform().scaled(1.3).rotated({0, 10, 0}), n);
            add(OpenCylinderOf<double>{{-1, -1, 2}, {0, 0.1, 1}, 0.3},
                Transform({{{1, 0.1, 0, 0}, {0, 1.2, 0, 0.5}, {0, 0.2, 1, 0}}}), m);
            add(CappedConeOf<double>{{-2, -1, 1}, {0, 1, 0}, 0.3, 0},
                Transform().scaled({1.1, 1.3, 0.9}), m);
            add(QuadricOf<double>{.center = {},
                                  .xx = 1,
                                  .yy = 1,
                                  .zz = 1,
                                  .one = -1,
                                  .lower = {-1, -0.5, -1},
                                  .upper = {1, 0.5, 1}},
                Transform().rotated({0, 0, 33}).then(Transform().translated({0, 2.2, 0})), n);
            const Solid hole = CappedCylinderOf<double>{{2, -1, -1}, {0, 0, 2}, 0.3};
            to.add((SphereOf<double>{{2, -1, 0}, 0.8} -
                    hole.transformed(Transform().scaled({1, 1.1, 1})))
                       .transformed(Transform().rotated({5, 6, 7})),
                   n);
        }};
}

Case groups() {
    return {"groups and instances", R"({
            "definitions": {"pair": {"type": "group", "objects": [
                {"type": "sphere", "center": [0, 0, 0], "radius": 0.4},
                {"type": "quadric", "center": [0, 0.5, 0], "matrix": [[1, 0, 0, 0], [0, 1, 0, 0],
                 [0, 0, 1, 0], [0, 0, 0, -0.1]], "lower": [-1, 0, -1], "upper": [1, 1, 1]}]}},
            "objects": [
                {"type": "instance", "of": "pair", "material": "m"},
                {"type": "instance", "of": "pair", "translate": [1, 0.1, 0], "material": "n"},
                {"type": "instance", "of": "pair", "material": "m", "placements": [
                    {"scale": 0.5, "rotate": [0, 0, 30], "translate": [2, 0.3, 0]},
                    {"translate": [-2, 0.1, 0]}]},
                {"type": "group", "material": "n", "rotate": [0, 0, 45], "objects": [
                    {"type": "instance", "of": "pair", "translate": [-1, -0.1, 0]},
                    {"type": "union", "objects": [
                        {"type": "sphere", "center": [0, -1, 0], "radius": 0.4, "material": "m"}]},
                    {"type": "disc", "center": [0, -2, 0], "normal": [0, 1, 1], "radius": 1,
                     "material": "m"}]},
                {"type": "difference", "material": "m", "objects": [
                    {"type": "box", "min": [-2, 1, -1], "max": [0, 2, 1]},
                    {"type": "instance", "of": "pair", "translate": [-0.5, 1.5, 1]},
                    {"type": "group", "objects": [
                        {"type": "sphere", "center": [-1.5, 1.5, 1], "radius": 0.2},
                        {"type": "sphere", "center": [-1.5, 1.8, 1], "radius": 0.2}]}]}]})",
            [](SceneBuilder& to) {
                Group pair;
                pair.add(SphereOf<double>{{0, 0, 0}, 0.4});
                pair.add(QuadricOf<double>{.center = {0, 0.5, 0},
                                           .xx = 1,
                                           .yy = 1,
                                           .zz = 1,
                                           .one = -0.1,
                                           .lower = {-1, 0, -1},
                                           .upper = {1, 1, 1}});
                to.add(pair, m);
                to.add(pair.transformed(Transform().translated({1, 0.1, 0})), n);
                const Placement small{{2, 0.3, 0}, {0, 0, 30}, 0.5}, left{{-2, 0.1, 0}};
                to.add(pair, std::vector{small, left}, m);
                Group group;
                group.add(pair.transformed(Transform().translated({-1, -0.1, 0})));
                group.add(Solid(SphereOf<double>{{0, -1, 0}, 0.4}, m));
                group.add(DiscOf<double>{{0, -2, 0}, {0, 1, 1}, 1}, m);
                to.add(group.transformed(Transform().rotated({0, 0, 45})), n);
                // An instance in a solid is closed by its box before it is transformed.
                to.add(difference_of(
                           aligned_box({-2, 1, -1}, {0, 2, 1}),
                           {solid_of(pair).transformed(Transform().translated({-0.5, 1.5, 1})),
                            union_of({SphereOf<double>{{-1.5, 1.5, 1}, 0.2},
                                      SphereOf<double>{{-1.5, 1.8, 1}, 0.2}})}),
                       m);
            }};
}

/// Adds a sphere of the material in each place from left to right.
void add_spheres(SceneBuilder& to, const std::vector<Material>& materials) {
    for (std::size_t i = 0; i < materials.size(); ++i)
        to.add(SphereOf<double>{{static_cast<double>(i) - 3, 0, 0}, 0.5},
               to.add_material(materials[i]));
}
std::string spheres_of(const std::vector<std::string>& materials) {
    std::string objects;
    for (std::size_t i = 0; i < materials.size(); ++i)
        objects += std::string(i == 0 ? "" : ", ") + R"({"type": "sphere", "radius": 0.5,
            "center": [)" +
                   std::to_string(static_cast<int>(i) - 3) + R"(, 0, 0], "material": )" +
                   materials[i] + "}";
    return R"({"materials": {}, "objects": [)" + objects + "]}";
}

/// Returns a case with a material for each of a material's numbers, which is 1/2 in it.
Case numbers() {
    using core::fields::Field, core::fields::for_each_field;
    std::vector<std::string> texts;
    std::vector<Material> values;
    const auto add = [&](const Field& field, const auto& number) {
        if constexpr (std::is_same_v<decltype(number), const float&>) {
            texts.push_back("{\"" + std::string(field.key()) + "\": 0.5}");
            const auto set = [&](const Field& other, auto& value) {
                if constexpr (std::is_same_v<decltype(value), float&>)
                    if (other.key() == field.key()) value = 0.5F;
            };
            for_each_field(set, values.emplace_back());
        }
    };
    const Material usual{};
    for_each_field(add, usual);
    return {"numbers", spheres_of(texts), [values](SceneBuilder& to) { add_spheres(to, values); }};
}

Case presets() {
    std::vector<std::string> texts;
    std::vector<Material> values;
    for (const char* name : {"matte", "plastic", "metal", "mirror", "glass", "water", "diamond"}) {
        texts.push_back(R"({"preset": ")" + std::string(name) + "\"}");
        values.push_back(material_preset(name));
    }
    return {"presets", spheres_of(texts), [values](SceneBuilder& to) { add_spheres(to, values); }};
}

Case glasses() {
    std::vector<std::string> texts;
    std::vector<Material> values;
    for (const char* name : {"N-BK7", "N-K5", "N-BAK4", "F2", "N-F2", "SF5", "N-SF5", "N-SF10",
                             "N-SF11", "SF11", "fused silica", "calcium fluoride", "diamond"}) {
        texts.push_back(R"({"transmission": 1, "glass": ")" + std::string(name) + "\"}");
        values.push_back({.transmission = 1, .glass = catalogue_glass(name)});
    }
    texts.emplace_back(R"({"glass": {"B": [1, 0.2, 1], "C": [0.006, 0.02, 100]}})");
    values.push_back({.glass = {{1, 0.2, 1}, {0.006, 0.02, 100}}});
    return {"glasses", spheres_of(texts), [values](SceneBuilder& to) { add_spheres(to, values); }};
}

Case looks() {
    return {
        "looks",
        spheres_of({R"({"color": "#ff8000", "ambient": 0.2, "diffuse": 0.7, "specular": 0.3,
                         "exponent": 20, "reflectivity": 0.2, "opacity": 0.5})",
                    R"({"reflection": "schlick", "transmission": 0.9, "index": 1.3,
                         "absorption": [0.1, 0.2, 0.3]})",
                    R"({"reflection": "dielectric", "visible": "outside"})",
                    R"({"visible": "inside"})", R"({"visible": "both", "highlight": "blinn"})",
                    R"({"pattern": {"type": "checker", "colors": ["#000000", "#ffffff"],
                         "size": 0.3, "axes": "xyz", "upper_edges": "y"}})",
                    R"({"pattern": {"type": "stripes", "colors": [[0, 0, 0], [1, 1, 1]],
                         "width": 0.2, "direction": [1, 1, 0]}})",
                    R"({"pattern": {"type": "gradient", "colors": [[0, 0, 0], [1, 1, 1]],
                         "from": [0, -1, 0], "to": [0, 1, 0]}})",
                    R"({"pattern": {"type": "formula", "color": ["x > 0 ? u : v", "y * y", 0.5],
                         "translate": [1, 0, 0]}})",
                    R"({"pattern": {"type": "back-plane"}})", R"({"pattern": {"type": "cutaway"}})",
                    R"({"specular": 0.5, "highlight": "phong"})"}),
        [](SceneBuilder& to) {
            const Color black{}, white{1, 1, 1};
            add_spheres(to, {{.pattern = {.colors = {color_from_srgb("#ff8000")}},
                              .ambient = 0.2F,
                              .diffuse = 0.7F,
                              .specular = 0.3F,
                              .exponent = 20,
                              .reflectivity = 0.2F,
                              .opacity = 0.5F},
                             {.reflection = Reflection::schlick,
                              .transmission = 0.9F,
                              .index = 1.3F,
                              .absorption = {0.1F, 0.2F, 0.3F}},
                             {.reflection = Reflection::dielectric, .visible = Visible::outside},
                             {.visible = Visible::inside},
                             {},
                             {.pattern = {.kind = PatternKind::checker,
                                          .colors = {black, white},
                                          .size = 0.3F,
                                          .axes = 7 | 16}},
                             {.pattern = {.kind = PatternKind::stripes,
                                          .colors = {black, white},
                                          .size = 0.2F,
                                          .direction = {1, 1, 0}}},
                             {.pattern = {.kind = PatternKind::gradient,
                                          .colors = {black, white},
                                          .from = {0, -1, 0},
                                          .to = {0, 1, 0}}},
                             {.pattern = {.kind = PatternKind::formula,
                                          .formula = {"x - 1 > 0 ? u : v", "y * y", "0.5"}}},
                             {.pattern = {.kind = PatternKind::formula,
                                          .formula = {"x^2 + y^2 < 150 ? (y > 0 ? 1 : 0.7) : "
                                                      "y < 0 ? 0 : abs(cos(x))",
                                                      "x^2 + y^2 < 150 ? 0.2 : y < 0 ? 0 : "
                                                      "abs(sin(sqrt(y)))",
                                                      "x^2 + y^2 < 150 ? 0 : "
                                                      "abs(cos(y < 0 ? y : sqrt(y)))"}}},
                             {.pattern = {.kind = PatternKind::cutaway}},
                             {.specular = 0.5F, .highlight = Highlight::phong}});
        }};
}

Case patterns_on_objects() {
    const std::string picture = RAYLANE_SOURCE_DIR "/bench/failures/double-sum.png";
    const std::string text = R"({"materials": {
            "m": {"pattern": {"type": "image", "file": ")" +
                             picture + R"("}},
            "n": {"pattern": {"type": "image", "file": ")" +
                             picture + R"(", "width": 0.5,
                  "height": 2, "wrap": "clamp", "axis": [1, 0, 1]}},
            "o": {"pattern": {"type": "formula", "color": ["x", "u", 0.5], "space": "object"}},
            "p": {"pattern": {"type": "image", "file": ")" +
                             picture + R"(", "wrap": "repeat"}},
            "q": {"pattern": {"type": "checker", "colors": ["#000000", "#ffffff"], "size": 0.3,
                  "space": "world"}}},
            "objects": [{"type": "group", "rotate": [10, 20, 30], "objects": [
                {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"},
                {"type": "sphere", "center": [2, 0, 0], "radius": 1, "material": "n"},
                {"type": "sphere", "center": [-2, 0, 0], "radius": 1, "material": "o"},
                {"type": "cylinder", "base": [0, 1.5, 0], "axis": [1, 0, 0], "radius": 0.5,
                 "material": "p"},
                {"type": "sphere", "center": [0, -2, 0], "radius": 1, "material": "q"}]}]})";
    return {"patterns on objects", text, [picture](SceneBuilder& to) {
                const Texture image = read_texture(picture);
                const MaterialIndex materials[] = {
                    to.add_material({.pattern = {.kind = PatternKind::image, .image = image}}, "m"),
                    to.add_material({.pattern = {.kind = PatternKind::image,
                                                 .image = image,
                                                 .width = 0.5F,
                                                 .height = 2,
                                                 .wrap = ImageWrap::clamp,
                                                 .axis = {1, 0, 1}}},
                                    "n"),
                    to.add_material({.pattern = {.kind = PatternKind::formula,
                                                 .formula = {"x", "u", "0.5"},
                                                 .space = PatternSpace::object}},
                                    "o"),
                    to.add_material({.pattern = {.kind = PatternKind::image, .image = image}}, "p"),
                    to.add_material({.pattern = {.kind = PatternKind::checker,
                                                 .colors = {{0, 0, 0}, {1, 1, 1}},
                                                 .size = 0.3F}},
                                    "q")};
                Group group;
                group.add(SphereOf<double>{{0, 0, 0}, 1}, materials[0]);
                group.add(SphereOf<double>{{2, 0, 0}, 1}, materials[1]);
                group.add(SphereOf<double>{{-2, 0, 0}, 1}, materials[2]);
                group.add(CappedCylinderOf<double>{{0, 1.5, 0}, {1, 0, 0}, 0.5}, materials[3]);
                group.add(SphereOf<double>{{0, -2, 0}, 1}, materials[4]);
                to.add(group.transformed(Transform().rotated({10, 20, 30})));
            }};
}

std::vector<Case> checkers() {
    std::vector<Case> cases;
    for (const char* axes : {"x", "y", "z", "xy", "xz", "yz"}) {
        std::uint8_t bits = 0;
        for (const char* axis = axes; *axis != '\0'; ++axis)
            bits = static_cast<std::uint8_t>(bits | 1 << (*axis - 'x'));
        const std::string text(axes);
        cases.push_back({axes,
                         spheres_of({R"({"pattern": {"type": "checker", "size": 0.3,
                                        "colors": [[0, 0, 0], [1, 1, 1]], "axes": ")" +
                                     text + "\"}}"}),
                         [bits](SceneBuilder& to) {
                             add_spheres(to, {{.pattern = {.kind = PatternKind::checker,
                                                           .colors = {{0, 0, 0}, {1, 1, 1}},
                                                           .size = 0.3F,
                                                           .axes = bits}}});
                         }});
    }
    return cases;
}

std::vector<Case> lights_and_fog() {
    return {
        {"lights", R"({"lights": [
            {"type": "point", "position": [5, 9, 7], "color": [0.2, 0.3, 0.4]},
            {"type": "directional", "direction": [1, -1, 0], "color": "#404040"},
            {"type": "sky", "direction": [0, -1, 0.1], "color": [0.1, 0.2, 0.3],
             "ground": [0.2, 0.1, 0], "reach": 5},
            {"type": "sphere", "position": [-5, 5, 5], "radius": 1, "color": [0.3, 0.3, 0.3]},
            {"type": "disc", "position": [-5, 9, 5], "direction": [0, -1, 0], "radius": 2,
             "color": [0.3, 0.3, 0.3]},
            {"type": "rectangle", "position": [5, 9, 5], "edge_u": [2, 0, 0], "edge_v": [0, 0, 1],
             "color": [0.4, 0.3, 0.3]}]})",
         [](SceneBuilder& to) {
             const Color dim{0.3F, 0.3F, 0.3F};
             to.add_light({.position = {5, 9, 7}, .color = {0.2F, 0.3F, 0.4F}});
             to.add_light({.kind = LightKind::directional,
                           .direction = {1, -1, 0},
                           .color = color_from_srgb("#404040")});
             to.add_light({.kind = LightKind::sky,
                           .direction = {0, -1, 0.1F},
                           .color = {0.1F, 0.2F, 0.3F},
                           .ground = {0.2F, 0.1F, 0},
                           .reach = 5});
             to.add_light({.kind = LightKind::sphere, .position = {-5, 5, 5}, .color = dim});
             to.add_light({.kind = LightKind::disc,
                           .position = {-5, 9, 5},
                           .direction = {0, -1, 0},
                           .color = dim,
                           .radius = 2});
             to.add_light({.kind = LightKind::rectangle,
                           .position = {5, 9, 5},
                           .color = {0.4F, 0.3F, 0.3F},
                           .edge_u = {2, 0, 0},
                           .edge_v = {0, 0, 1}});
         }},
        {"lights of the camera", R"({"lights": [{"type": "camera"}]})",
         [](SceneBuilder& to) { to.camera_lights = true; }},
        {"fog by z", R"({"fog": {"type": "linear-z", "color": [0.1, 0.2, 0.3], "start": 3,
            "end": -3}, "background": [0.3, 0.2, 0.1]})",
         [](SceneBuilder& to) {
             to.background = {0.3F, 0.2F, 0.1F};
             to.fog = {
                 .kind = FogKind::linear_z, .color = {0.1F, 0.2F, 0.3F}, .start = 3, .end = -3};
         }},
        {"fog by distance", R"({"fog": {"type": "linear", "start": 3, "end": 12}})",
         [](SceneBuilder& to) { to.fog = {.kind = FogKind::linear, .start = 3, .end = 12}; }},
        {"exponential fog", R"({"fog": {"type": "exponential", "density": 0.1}})",
         [](SceneBuilder& to) { to.fog = {.kind = FogKind::exponential, .density = 0.1F}; }},
    };
}

std::vector<Case> views() {
    std::vector<Case> cases = {
        {"a perspective camera", R"({"camera": {"type": "perspective", "from": [0, 0, 5],
            "at": [0.1, 0, 0], "up": [1, 1, 0], "field_of_view": 50, "lens_radius": 0.1,
            "focus_distance": 4}})",
         [](SceneBuilder& to) {
             to.camera = {.from = {0, 0, 5},
                          .at = {0.1F, 0, 0},
                          .up = {1, 1, 0},
                          .field_of_view = 50,
                          .lens_radius = 0.1F,
                          .focus_distance = 4};
         }},
        {"an orthographic camera", R"({"camera": {"type": "orthographic", "from": [0, 1, 5],
            "at": [0, 0, 0], "height": 4}})",
         [](SceneBuilder& to) {
             to.camera = {.projection = Projection::orthographic, .from = {0, 1, 5}, .height = 4};
         }},
        {"a word for a camera", R"({"camera": "auto", "lights": []})",
         [](SceneBuilder& to) { to.auto_camera.emplace(); }},
        {"an automatic camera", R"({"camera": {"type": "auto", "view": [1, -2, -3],
            "up": [0, 1, 0.5], "zoom": 1.5, "orthographic": true, "depth_cue": 0.5}})",
         [](SceneBuilder& to) {
             to.auto_camera = {.projection = Projection::orthographic,
                               .direction = {1, -2, -3},
                               .up = {0, 1, 0.5F},
                               .zoom = 1.5F,
                               .depth_cue = 0.5F};
         }},
        {"an automatic camera without up", R"({"camera": {"type": "auto", "view": [0, -1, 0],
            "field_of_view": 40}, "lights": [{"type": "camera"}]})",
         [](SceneBuilder& to) {
             to.auto_camera = {.direction = {0, -1, 0}, .field_of_view = 40};
             to.camera_lights = true;
         }},
    };
    for (const char* view :
         {"front", "back", "right", "left", "top", "bottom", "x", "y", "z", "corner"})
        cases.push_back(
            {view,
             R"({"lights": [{"type": "directional", "direction": [1, -1, -2]}],
                             "camera": {"type": "auto", "view": ")" +
                 std::string(view) + "\"}}",
             [view](SceneBuilder& to) {
                 to.add_light({.kind = LightKind::directional, .direction = {1, -1, -2}});
                 to.auto_camera = named_view(view);
             }});
    return cases;
}

std::vector<Case> images() {
    return {
        {"settings", R"({"image": {"width": 24, "height": 18, "transfer": "linear", "alpha": true},
            "sampling": {"grid": 2, "pattern": "stratified", "filter": "gaussian",
            "light_samples": 2, "transparent_shadows": false},
            "limits": {"max_depth": 3, "min_weight": 0.1,
            "max_transparent": 5}, "outline": {"width": 1.5, "color": [1, 0, 0],
            "creases": 30}})",
         [](SceneBuilder& to) {
             to.settings.transfer = Transfer::linear;
             to.settings.alpha = true;
             to.settings.grid = 2;
             to.settings.samples = SamplePattern::stratified;
             to.settings.filter = PixelFilter::gaussian;
             to.settings.light_samples = 2;
             to.settings.transparent_shadows = false;
             to.settings.max_depth = 3;
             to.settings.min_weight = 0.1F;
             to.settings.max_transparent = 5;
             to.settings.outline = {.width = 1.5F, .color = {1, 0, 0}, .creases = 30};
         }},
        {"other settings", R"({"image": {"width": 24, "height": 18, "transfer": "srgb"},
            "sampling": {"quality": 30, "pattern": "regular", "filter": "blackman-harris"}})",
         [](SceneBuilder& to) {
             to.settings.quality = 30;
             to.settings.filter = PixelFilter::blackman_harris;
         }},
        {"a box filter", R"({"sampling": {"grid": 1, "filter": "box"}})", [](SceneBuilder&) {}},
        {"a spectrum", R"({"spectrum": {"wavelengths": [450, 550.5, 650]},
            "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1.5,
            "material": {"glass": "SF11", "transmission": 1, "reflection": "dielectric"}}]})",
         [](SceneBuilder& to) {
             to.wavelengths = {450, 550.5, 650};
             to.add(SphereOf<double>{{0, 0, 0}, 1.5},
                    to.add_material({.reflection = Reflection::dielectric,
                                     .transmission = 1,
                                     .glass = catalogue_glass("SF11")}));
         }},
    };
}

std::vector<Case> all_cases() {
    std::vector<Case> cases = {
        shapes(),  sphereflake(), lattices(), solids(), transforms(),         groups(),
        numbers(), presets(),     glasses(),  looks(),  patterns_on_objects()};
    for (const auto& make : {checkers, lights_and_fog, views, images})
        for (Case& one : make())
            cases.push_back(std::move(one));
    return cases;
}

/// Adds all keys of objects and all texts of a scene.
void list_words(const json& value, Words& words) {
    if (value.is_string()) words.insert(value.get<std::string>());
    if (value.is_object())
        for (const auto& [key, child] : value.items())
            words.insert(key);
    if (value.is_structured())
        for (const json& child : value)
            list_words(child, words);
}

/// Adds all keys and words that the schema knows.
void list_words_of_schema(const json& schema, Words& words) {
    if (schema.is_object()) {
        for (const json& word : schema.value("enum", json::array()))
            if (word.is_string()) words.insert(word.get<std::string>());
        if (schema.contains("const") && schema["const"].is_string())
            words.insert(schema["const"].get<std::string>());
        const json properties = schema.value("properties", json::object());
        for (const auto& [key, child] : properties.items())
            if (!child.value("deprecated", false)) words.insert(key);
    }
    if (schema.is_structured())
        for (const json& child : schema)
            list_words_of_schema(child, words);
}

} // namespace

TEST_CASE("a builder makes the bits of each kind of scene in JSON") {
    for (const Case& one : all_cases())
        check_case(one);
}

TEST_CASE("the scenes that builders make have all keys and words of the JSON schema") {
    Words known;
    list_words_of_schema(
        json::parse(std::ifstream(RAYLANE_SOURCE_DIR "/scenes/raylane-scene.schema.json")), known);
    // The language's own keys: in code these are variables and functions.
    for (const char* key : {"$schema", "parameters", "include"})
        REQUIRE(known.erase(key) == 1);
    Words used;
    list_words(base, used);
    for (const Case& one : all_cases())
        list_words(json::parse(one.keys), used);
    for (const std::string& word : known) {
        CAPTURE(word);
        CHECK(used.contains(word));
    }
}
