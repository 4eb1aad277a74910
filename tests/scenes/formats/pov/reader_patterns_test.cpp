#include "core/scene/pattern.hpp"
#include "core/scene/scene.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/formats/pov/read.hpp"
#include "tests/support/catch.hpp"

#include <string>

using namespace raylane;
using tests::complaint, tests::read, tests::Read;

namespace {

core::Pattern pattern_of(const Read& result) {
    return result.material_of().pattern;
}

Read with_pigment(const std::string& text, const std::string& before = "") {
    return read(before + "sphere { 0, 1 pigment { " + text + " } }");
}

Read with_texture(const std::string& text, const std::string& before = "") {
    return read(before + "sphere { 0, 1 texture { " + text + " } }");
}

/// A PNG of one pixel, 128 64 255.
constexpr unsigned char one_pixel[] = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
    0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00, 0x0C, 0x49, 0x44, 0x41, 0x54, 0x78,
    0xDA, 0x63, 0x68, 0x70, 0xF8, 0x0F, 0x00, 0x03, 0x03, 0x01, 0xC0, 0xC0, 0x7A, 0x88,
    0x48, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
/// A PNG of two pixels: red, and blue with alpha 0.
constexpr unsigned char half_clear[] = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
    0x00, 0xF4, 0x22, 0x7F, 0x8A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x44, 0x41, 0x54, 0x78,
    0xDA, 0x63, 0xF8, 0xCF, 0xC0, 0x00, 0x46, 0x00, 0x0E, 0xFA, 0x02, 0xFE, 0x2A, 0x40,
    0x5E, 0xB9, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

template <std::size_t size>
std::string bytes_of(const unsigned char (&bytes)[size]) {
    return {bytes, bytes + size};
}

const core::Color red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), white(1, 1, 1),
    grey(0.5F, 0.5F, 0.5F);

} // namespace

TEST_CASE("POV-Ray: a face on an edge of a checker's cells has the colour of the cell above") {
    const std::string left_handed = "camera { location <0, 0, -9> look_at 0 }\n";
    const auto color_at = [&](double z, const std::string& motion = "") {
        const Read box = read(
            "box { -1, <1, 1, 5> pigment { checker rgb 0, rgb 1 " + motion + "} }", left_handed);
        return core::color_at(pattern_of(box), core::Vec3d(0.5, 0.5, -z)).x;
    };
    CHECK(color_at(4.5) == 0.0);
    CHECK(color_at(5.0) == 1.0);
    CHECK(color_at(-1.0) == 1.0);
    CHECK(color_at(4.5, "scale <1, 1, -1>") == 1.0);
    CHECK(color_at(5.0, "scale <1, 1, -1>") == 1.0);
    CHECK(color_at(5.5, "scale <1, 1, -1>") == 0.0);
}

TEST_CASE("POV-Ray: checkers may be of colours or pigments or textures") {
    for (const std::string text :
         {"checker rgb x, rgb y", "checker pigment { rgb x } pigment { rgb y }",
          "checker pigment { rgb x }, rgb y", "checker R[0] pigment { P }"}) {
        CAPTURE(text);
        const Read checker = with_pigment(
            text + " scale 2", "#declare R = array[1] { rgb x } #declare P = pigment { rgb y }\n");
        CHECK(pattern_of(checker).kind == core::PatternKind::checker);
        CHECK(pattern_of(checker).colors[0] == red);
        CHECK(pattern_of(checker).colors[1] == green);
        CHECK(pattern_of(checker).size == 2.0F);
        CHECK(checker.remarks.empty());
    }
    const Read textures = with_texture("checker texture { pigment { rgb x } } texture { T[0] }",
                                       "#declare T = array[1] { texture { pigment { rgb y } } }\n");
    CHECK(pattern_of(textures).colors[0] == red);
    CHECK(pattern_of(textures).colors[1] == green);
    CHECK(textures.remarks.empty());
    CHECK(pattern_of(with_pigment("checker")).colors[0] == blue);
    const Read nested =
        with_pigment("checker pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } } rgb x");
    CHECK(pattern_of(nested).colors[0] == grey);
    CHECK(pattern_of(nested).colors[1] == red);
    CHECK(nested.remarks_on("patterns in a pattern are not supported"));
}

TEST_CASE("POV-Ray: a pattern of textures has the mean of their finishes") {
    const Read mirror =
        with_texture("checker texture { pigment { rgb 1 } finish { reflection 0.5 } } "
                     "texture { pigment { rgb 1 } finish { reflection 0 } }");
    CHECK(mirror.material_of().reflectivity == 0.25F);
    CHECK(
        mirror.remarks_on("different finishes in a pattern are not supported: their mean is used"));
    const Read dull =
        with_texture("checker texture { pigment { rgb 1 } finish { ambient 0 diffuse 0.5 } } "
                     "texture { pigment { rgb 1 } finish { ambient 0 diffuse 0.25 } }");
    const core::Material& material = dull.material_of();
    for (const int i : {0, 1})
        CHECK(material.diffuse * material.pattern.colors[static_cast<std::size_t>(i)].x ==
              Approx(i == 0 ? 0.5F : 0.25F));
}

TEST_CASE("POV-Ray: gradients may have maps of colours or pigments or textures") {
    for (const std::string text :
         {"color_map { [0 rgb x] [1 rgb y] }", "color_map { [0, 1 rgb x rgb y] }",
          "pigment_map { [0 rgb x] [1 P] }", "color_map { C }", "colour_map { M[0] }"}) {
        CAPTURE(text);
        const Read gradient =
            with_pigment("gradient y " + text, "#declare P = pigment { rgb y }\n"
                                               "#declare C = color_map { [0 rgb x] [1 rgb y] }\n"
                                               "#declare M = array[1] { color_map { C } }\n");
        CHECK(pattern_of(gradient).kind == core::PatternKind::gradient);
        CHECK(pattern_of(gradient).colors[0] == red);
        CHECK(pattern_of(gradient).colors[1] == green);
    }
    const Read textures = with_texture(
        "gradient y texture_map { [0 pigment { rgb x } finish { diffuse 0.5 }] [1 T] }",
        "#declare T = texture { pigment { rgb y } finish { diffuse 0.5 } }\n");
    CHECK(pattern_of(textures).kind == core::PatternKind::gradient);
    CHECK(pattern_of(textures).colors[1] == green);
    CHECK(textures.material_of().diffuse == 0.5F);
    CHECK(pattern_of(with_pigment("gradient y color_map { [0 rgb 0] [0.5 rgb 0] [0.5 rgb 1] "
                                  "[1 rgb 1] }"))
              .kind == core::PatternKind::stripes);
    CHECK(complaint("sphere { 0, 1 pigment { gradient y color_map { } } }") ==
          "a.pov:1:48: must have an entry, got an empty map");
}

TEST_CASE("POV-Ray: an unsupported pattern has the mean of its colours") {
    const auto color = [](const std::string& text) {
        const Read result = with_pigment(text, "#declare N = 3;\n");
        CHECK(result.remarks_on("is not supported: its mean"));
        CHECK(pattern_of(result).kind == core::PatternKind::solid);
        return pattern_of(result).colors[0];
    };
    CHECK(color("bozo") == grey);
    CHECK(color("image_map { png \"none.png\" map_type 1 interpolate 2 once }") == grey);
    CHECK(color("wood color_map { [0 rgb 0] [1 rgb 1] }") == grey);
    // Each colour weighs its share of the map.
    CHECK(
        color("marble turbulence 1 color_map { [0 rgb 0] [0.75 rgb 0] [0.75 rgb 1] [1 rgb 1] }") ==
        core::Color(0.25F, 0.25F, 0.25F));
    CHECK(color("granite color_map { [0.25 rgb x] [0.75 rgb x] }") == red);
    CHECK(color("average pigment_map { [3 rgb 0] [1 rgb 1] }") == core::Color(0.25F, 0.25F, 0.25F));
    CHECK(color("hexagon pigment { rgb x } rgb 0, rgb 0").x == Approx(1.0F / 3));
    CHECK(color("object { box { 0, 1 } rgb 0, rgb 1 }") == grey);
    CHECK(color("brick rgb 1, rgb 1 brick_size <4, 2, 1> mortar 0.25") == white);
    CHECK(color("spiral1 N color_map { [0 rgb 1] [1 rgb 1] } warp { turbulence 1 octaves 3 }") ==
          white);
    CHECK(color("function { F(x, y, z) } color_map { [0 rgb 1] [1 rgb 1] }") == white);
    CHECK(color("crackle form <1, 0, 0> metric 2 solid pigment_map { [0 rgb 1] [1 rgb 1] }") ==
          white);
    CHECK(color("density_file df3 \"a.df3\" interpolate 1 color_map { [0 rgb 1] [1 rgb 1] }") ==
          white);
    const Read textures = with_texture("granite texture_map { [0 pigment { rgb 0 }] [1 pigment { "
                                       "rgb 1 } finish { phong 1 }] } scale 3");
    CHECK(pattern_of(textures).colors[0] == grey);
    CHECK(textures.material_of().specular == 0.5F);
    CHECK(textures.remarks_on("pattern \"granite\" is not supported: its mean colour is used"));
}

TEST_CASE("POV-Ray: words that distort a pattern are ignored with a remark") {
    const Read turbulent = with_pigment("checker rgb 0, rgb 1 turbulence 0.5 frequency 2");
    CHECK(pattern_of(turbulent).kind == core::PatternKind::checker);
    CHECK(turbulent.remarks_on("\"turbulence\" of a pattern is ignored"));
    CHECK(turbulent.remarks_on("\"frequency\" of a pattern is ignored"));
    const Read on_surface = with_texture("uv_mapping pigment { checker rgb 0, rgb 1 }");
    CHECK(pattern_of(on_surface).kind == core::PatternKind::checker);
    CHECK(on_surface.remarks_on("uv_mapping is ignored: patterns are in space"));
}

TEST_CASE("POV-Ray: an image_map has the mean colour of its image") {
    const tests::TemporaryDirectory directory;
    directory.write("one.png", bytes_of(one_pixel));
    directory.write("half.png", bytes_of(half_clear));
    directory.write("cut.png", bytes_of(one_pixel).substr(0, 60));
    const auto read_with = [&](const std::string& version, const std::string& image) {
        std::string remarks;
        scenes::LoadOptions options;
        options.on_remark = [&](const std::string& remark) { remarks += remark + "\n"; };
        const std::string text = "#version " + version + ";\n" + tests::camera +
                                 "sphere { 0, 1 pigment { image_map { " + image + " } } }";
        core::Scene scene = scenes::load_scene(directory.write("a.pov", text), options);
        CHECK(remarks.find("pattern \"image_map\" is not supported: its mean colour is used") !=
              std::string::npos);
        return scene.material_of(0);
    };
    const std::string one = "png \"one.png\" map_type 1 interpolate 2";
    // Versions before 3.7 take the file's codes.
    CHECK(read_with("3.6", one).pattern.colors[0].x == Approx(128.0F / 255.0F));
    for (const std::string version : {"3.7", "3.6; global_settings { assumed_gamma 1 }"}) {
        const core::Color linear = read_with(version, one).pattern.colors[0];
        CHECK(linear.x == Approx(0.21586F).epsilon(1e-4));
        CHECK(linear.y == Approx(0.05127F).epsilon(1e-4));
        CHECK(linear.z == 1.0F);
    }
    const core::Material half = read_with("3.7", "\"half.png\" once");
    CHECK(half.pattern.colors[0] == red);
    CHECK(half.opacity == 0.5F);
    for (const char* other : {"png \"cut.png\"", "png \"none.png\"", "jpeg \"a.pov\""})
        CHECK(read_with("3.7", other).pattern.colors[0] == grey);
}
