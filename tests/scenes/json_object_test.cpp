#include "tests/catch.hpp"
#include "tests/scenes/json_scenes.hpp"

#include <limits>

using namespace raylane;
using namespace raylane::tests;
using core::Color;
using core::Vec3f;

namespace {

core::Material material_of(const std::string& material) {
    const core::Scene scene = scene_of(with_objects(
        R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": )" + material + "}"));
    return scene.material_of(0);
}

} // namespace

TEST_CASE("each shape is the floats of its file") {
    const core::Scene scene = scene_of(with_objects(R"(
        {"type": "sphere", "material": "clay", "center": [0.1, -2, 3], "radius": 0.7},
        {"type": "plane", "material": "clay", "point": [0, -9, 0], "normal": [0, 3, 0.1]},
        {"type": "disc", "material": "clay", "center": [1, 2, 3], "normal": [0, 0, -2], "radius": 0.3},
        {"type": "triangle", "material": "clay", "a": [0, 0, 0], "b": [1, 0.1, 0], "c": [0, 1, 0.2]},
        {"type": "triangle", "material": "glass", "a": [0, 0, 0], "b": [1, 0.1, 0], "c": [0, 1, 0.2],
         "normals": [[0, 0, 1], [0.1, 0, 1], [0, 0.2, 1]]},
        {"type": "box", "material": "clay", "corner": [1, 2, 3], "edges": [[1, 0, 0.5], [0, 2, 0], [0, 0.1, 3]]},
        {"type": "box", "material": "clay", "min": [-0.1, 0.2, 1], "max": [0.3, 0.7, 1.5]},
        {"type": "cylinder", "material": "clay", "base": [1, 2, 3], "axis": [0, 0.1, 4], "radius": 0.6},
        {"type": "cylinder", "material": "clay", "base": [1, 2, 3], "axis": [0, 0.1, 4], "radius": 0.6, "capped": false},
        {"type": "cone", "material": "clay", "base": [1, 2, 3], "axis": [0, 5, 0], "base_radius": 0.9},
        {"type": "cone", "material": "clay", "base": [1, 2, 3], "axis": [0, 5, 0], "base_radius": 0.9, "top_radius": 0.4, "capped": false},
        {"type": "quadric", "material": "clay", "lower": [-1, -2, -3], "upper": [1, 2, 3],
         "matrix": [[1, 2, 3, 4], [2, 5, 6, 7], [3, 6, 8, 9], [4, 7, 9, 10]]},
        {"type": "quadric", "material": "clay", "center": [0.1, 0.2, 0.3], "lower": [-1, -1, -1], "upper": [1, 1, 1],
         "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -0.1]]})"));
    REQUIRE(scene.shape_count() == 13);
    using core::floats_of;
    CHECK(floats_of(shape<core::Sphere>(scene, 0)) ==
          core::Floats<core::Sphere>{0.1F, -2, 3, 0.7F});
    CHECK(floats_of(shape<core::Plane>(scene, 1)) ==
          core::Floats<core::Plane>{0, -9, 0, 0, 3, 0.1F});
    CHECK(floats_of(shape<core::Disc>(scene, 2)) ==
          core::Floats<core::Disc>{1, 2, 3, 0, 0, -2, 0.3F});
    CHECK(floats_of(shape<core::Triangle>(scene, 3)) ==
          core::Floats<core::Triangle>{0, 0, 0, 1, 0.1F, 0, 0, 1, 0.2F});
    CHECK(floats_of(shape<core::SmoothTriangle>(scene, 4)) ==
          core::Floats<core::SmoothTriangle>{0, 0, 0, 1, 0.1F, 0, 0, 1, 0.2F, 0, 0, 1, 0.1F, 0, 1,
                                             0, 0.2F, 1});
    CHECK(floats_of(shape<core::Box>(scene, 5)) ==
          core::Floats<core::Box>{1, 2, 3, 1, 0, 0.5F, 0, 2, 0, 0, 0.1F, 3});
    CHECK(
        floats_of(shape<core::Box>(scene, 6)) ==
        core::Floats<core::Box>{-0.1F, 0.2F, 1, 0.3F - -0.1F, 0, 0, 0, 0.7F - 0.2F, 0, 0, 0, 0.5F});
    CHECK(floats_of(shape<core::CappedCylinder>(scene, 7)) ==
          core::Floats<core::CappedCylinder>{1, 2, 3, 0, 0.1F, 4, 0.6F});
    CHECK(floats_of(shape<core::OpenCylinder>(scene, 8)) ==
          core::Floats<core::OpenCylinder>{1, 2, 3, 0, 0.1F, 4, 0.6F});
    CHECK(floats_of(shape<core::CappedCone>(scene, 9)) ==
          core::Floats<core::CappedCone>{1, 2, 3, 0, 5, 0, 0.9F, 0});
    CHECK(floats_of(shape<core::OpenCone>(scene, 10)) ==
          core::Floats<core::OpenCone>{1, 2, 3, 0, 5, 0, 0.9F, 0.4F});
    // center; xx, yy, zz, xy, xz, yz, x, y, z, one; lower, upper
    CHECK(floats_of(shape<core::Quadric>(scene, 11)) ==
          core::Floats<core::Quadric>{0, 0, 0, 1, 5, 8, 2, 3, 6, 4, 7, 9, 10, -1, -2, -3, 1, 2, 3});
    CHECK(floats_of(shape<core::Quadric>(scene, 12)) ==
          core::Floats<core::Quadric>{0.1F, 0.2F, 0.3F, 1, 1, 1, 0, 0, 0, 0, 0, 0, -0.1F, -1, -1,
                                      -1, 1, 1, 1});
    CHECK(scene.material_of(3).transmission == 0.0F);
    CHECK(scene.material_of(4).transmission == 1.0F);
}

TEST_CASE("numbers become the nearest float") {
    const auto radius = [](const std::string& digits) {
        return shape<core::Sphere>(
                   scene_of(with_objects(
                       R"({"type": "sphere", "material": "clay", "center": [0, 0, 0], "radius": )" +
                       digits + "}")),
                   0)
            .radius;
    };
    // Nearer to 1 + 2^-23 than to 1, though the nearest double is half-way and would go to 1.
    CHECK(radius("1.000000059604644775390626") == 1.0F + 0x1p-23F);
    CHECK(radius("1.000000059604644775390625") == 1.0F);
    CHECK(radius("123456789012345678901234567890") == 123456789012345678901234567890.0F);
    CHECK(radius("16777217") == 16777216.0F);
    CHECK(radius("1e-45") == std::numeric_limits<float>::denorm_min());
    CHECK(
        complaint_about_text(with_objects(
            R"({"type": "sphere", "material": "clay", "center": [1e-60, -1e-400, 0], "radius": 1})")) ==
        "");
}

TEST_CASE("materials have defaults, and every key of theirs counts") {
    const core::Material plain = material_of("{}");
    const core::Material defaults;
    CHECK(plain.pattern.kind == core::PatternKind::solid);
    CHECK(plain.pattern.colors[0] == Color(1.0F));
    CHECK(plain.ambient == defaults.ambient);
    CHECK(plain.diffuse == defaults.diffuse);
    CHECK(plain.reflection == core::Reflection::constant);
    CHECK(plain.index == defaults.index);

    const core::Material all =
        material_of(R"({"color": [0.1, 0.2, 0.3], "ambient": 0.2, "diffuse": 0.3, "specular": 0.4,
        "exponent": 50, "reflectivity": 0.6, "transmission": 0.7, "index": 1.33, "absorption": [1, 2, 3.5], "visible": "inside"})");
    CHECK(all.pattern.colors[0] == Color(0.1F, 0.2F, 0.3F));
    CHECK(all.ambient == 0.2F);
    CHECK(all.diffuse == 0.3F);
    CHECK(all.specular == 0.4F);
    CHECK(all.exponent == 50.0F);
    CHECK(all.reflection == core::Reflection::constant);
    CHECK(all.reflectivity == 0.6F);
    CHECK(all.transmission == 0.7F);
    CHECK(all.index == 1.33F);
    CHECK(all.absorption == Vec3f(1, 2, 3.5F));
    CHECK(all.visible == core::Visible::inside);

    CHECK(material_of(R"({"reflection": "schlick"})").reflection == core::Reflection::schlick);
    CHECK(material_of(R"({"reflection": "dielectric"})").reflection ==
          core::Reflection::dielectric);
    CHECK(material_of(R"({"visible": "outside"})").visible == core::Visible::outside);
    CHECK(material_of(R"({"visible": "both"})").visible == core::Visible::both);
}

TEST_CASE("patterns land in the material") {
    const core::Pattern checker =
        material_of(
            R"({"pattern": {"type": "checker", "colors": [[1, 0, 0], [0, 1, 0]], "size": 0.3, "axes": "xyz"}})")
            .pattern;
    CHECK(checker.kind == core::PatternKind::checker);
    CHECK(checker.colors[0] == Color(1, 0, 0));
    CHECK(checker.colors[1] == Color(0, 1, 0));
    CHECK(checker.size == 0.3F);
    CHECK(checker.axes == 7);
    CHECK(material_of(
              R"({"pattern": {"type": "checker", "colors": [[1, 0, 0], [0, 1, 0]], "size": 1}})")
              .pattern.axes == 5);

    const core::Pattern stripes =
        material_of(
            R"({"pattern": {"type": "stripes", "colors": ["#000000", "#ffffff"], "width": 0.3, "direction": [1, 1, 0]}})")
            .pattern;
    CHECK(stripes.kind == core::PatternKind::stripes);
    CHECK(stripes.colors[0] == Color(0.0F));
    CHECK(stripes.colors[1] == Color(1.0F));
    CHECK(stripes.size == 0.3F);
    CHECK(stripes.direction == Vec3f(1, 1, 0));

    const core::Pattern gradient =
        material_of(
            R"({"pattern": {"type": "gradient", "colors": [[1, 0, 0], [0, 1, 0]], "from": [0, 1, 2], "to": [3, 4, 5]}})")
            .pattern;
    CHECK(gradient.kind == core::PatternKind::gradient);
    CHECK(gradient.from == Vec3f(0, 1, 2));
    CHECK(gradient.to == Vec3f(3, 4, 5));

    CHECK(material_of(R"({"pattern": {"type": "back-plane"}})").pattern.kind ==
          core::PatternKind::back_plane);
}
