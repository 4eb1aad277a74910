#include "core/scene/scene.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/pov/read.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using namespace raylane::scenes;
using tests::complaint, tests::number, tests::Read, tests::read;

namespace {

std::size_t shapes(const std::string& text) {
    return read(text).scene.shape_count();
}

} // namespace

TEST_CASE("a mesh with an inside gives a warning in both forms of meshes") {
    const std::string inside = " inside_vector z }", told = "the mesh is a surface";
    const std::string triangle = "mesh { triangle { 0, x, y }",
                      list = "mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0, 1, 2> }";
    for (const std::string& mesh : {triangle, list}) {
        CHECK(read(mesh + inside).remarks.find(told) != std::string::npos);
        CHECK(read(mesh + " }").remarks.find(told) == std::string::npos);
    }
}

TEST_CASE("POV-Ray: a gradient gets a remark since it repeats in POV-Ray") {
    const std::string gradient =
        "sphere { 0, 3 pigment { gradient y color_map { [0 rgb 0] [1 rgb 1] } } }";
    CHECK(read(gradient).remarks_on("repetition of a gradient is not supported"));
    const std::string by_convert = "// povray +W640 +H480 +A0.3\n#version 3.7;\n"
                                   "global_settings { assumed_gamma 1 }\n";
    CHECK(read(gradient, by_convert + tests::camera).remarks.empty());
    const std::string stripes = "sphere { 0, 3 pigment { gradient y color_map { [0 rgb 0] "
                                "[0.5 rgb 0] [0.5 rgb 1] [1 rgb 1] } } }";
    CHECK(read(stripes).remarks.empty());
}

TEST_CASE("POV-Ray: a pattern of colours with different transparency gets a remark") {
    const std::string what = "different transparencies in a pattern are not supported";
    CHECK(read("plane { y, 0 pigment { checker rgb 1, rgbt 1 } }").remarks_on(what));
    CHECK(read("plane { y, 0 pigment { gradient y color_map { [0 rgb 0] [1 rgbf 1] } } }")
              .remarks_on(what));
    CHECK_FALSE(read("plane { y, 0 pigment { checker rgbt 1, rgbt 1 } }").remarks_on(what));
}

TEST_CASE("POV-Ray: cutaway_textures give a cut the texture of the object that is cut") {
    const std::string cut = "difference { sphere { 0, 2 pigment { rgb x } } box { -3, <3, 3, 0> } ";
    const auto color_of_cut = [](const Read& result) {
        return result.material_of(1).pattern.colors[0];
    };
    CHECK(color_of_cut(read(cut + "}")) == core::Color(0, 0, 0));
    const Read one = read(cut + "cutaway_textures }");
    CHECK(color_of_cut(one) == core::Color(1, 0, 0));
    CHECK(one.remarks.empty());
    CHECK(color_of_cut(read(cut + "cutaway_textures off }")) == core::Color(0, 0, 0));
    CHECK(read("difference { union { sphere { 0, 2 pigment { rgb x } } sphere { y, 2 pigment { rgb "
               "y } } } box { -3, <3, 3, 0> } cutaway_textures }")
              .remarks_on("cutaway_textures of several textures are not supported"));
}

TEST_CASE("POV-Ray: albedo is the share of all reflected light") {
    // POV-Ray's images have these values: an albedo of 0.01 is 0.1275 at the brightest point.
    const auto finish = [](const std::string& text) {
        return read("sphere { 0, 1 finish { " + text + " } }").material_of();
    };
    CHECK(finish("specular albedo 0.01 roughness 0.01").specular == Approx(0.1275F));
    CHECK(finish("roughness 0.01 specular 0.01").specular == 0.01F);
    CHECK(finish("phong albedo 0.01 phong_size 40").specular == Approx(0.205F));
    CHECK(finish("diffuse albedo 0.25 brilliance 1").diffuse == 0.25F);
    CHECK(finish("diffuse albedo 0.25 brilliance 3").diffuse ==
          Approx(2.0F * finish("diffuse 0.25 brilliance 3").diffuse));
}

TEST_CASE("POV-Ray: shapes without a size are left out and those with a negative one are read") {
    CHECK(number("0", "sphere { 0, -1 } cylinder { 0, y, -1 } disc { 0, y, -1 }") == "0");
    CHECK(shapes("sphere { 0, 0 } cylinder { 0, y, 0 } cylinder { 0, 0, 1 }") == 0);
    CHECK(read("sphere { 0, 0 }").remarks_on("objects without a size are omitted"));
    CHECK(shapes("box { 0, <1, 1, 0> }") == 2);
    CHECK(shapes("box { 0, <1, 0, 0> }") == 0);
    const std::string smooth = "smooth_triangle { 0, z, x, 0, y, z }";
    for (const std::string& text : {smooth, "mesh { " + smooth + " }"})
        scenes::for_each_by_id(read(text).scene, [](const auto& shape, core::ShapeId) {
            CHECK(core::kind_of<std::decay_t<decltype(shape)>> == core::Kind::triangle);
        });
}

TEST_CASE("POV-Ray: polygons that are not flat are left out") {
    const std::string what = "polygons with corners outside their plane are omitted";
    const auto polygon = [](const std::string& height) {
        return read("polygon { 5, -y, x, <1, 1, 0>, <0, 1, " + height + ">, -y } sphere { 0, 1 }");
    };
    const Read flat = polygon("9e-11"), bent = polygon("2e-10"); // the bound is POV-Ray's
    CHECK(flat.scene.shape_count() == 3);
    CHECK(flat.remarks.empty());
    CHECK(bent.scene.shape_count() == 1);
    CHECK(bent.remarks_on(what));
    CHECK(read("polygon { 6, 0, <0, 0.1, 0>, z, <3, 0, 1>, 3*x, 0 }").remarks_on(what));
}

TEST_CASE("POV-Ray: negative components of a light become 0 with a remark") {
    const Read dark = read("light_source { 9*y, rgb <-1, 0.5, 0> } sphere { 0, 1 }");
    REQUIRE(dark.scene.lights().size() == 1);
    CHECK(dark.scene.lights()[0].color == core::Color(0, 0.5F, 0));
    CHECK(dark.remarks_on("negative components of lights are not supported: 0 is used"));
}

TEST_CASE("POV-Ray: a light that fog dims gets a remark") {
    const auto is_remarked = [](const std::string& modifier, const std::string& fog) {
        return read("light_source { 9*y, rgb 1 media_attenuation " + modifier + " } " + fog +
                    " sphere { 0, 1 }")
            .remarks_on("dimming of lights by fog is not supported: lights keep their brightness");
    };
    const std::string fog = "fog { distance 80 rgb 0.5 }";
    CHECK(is_remarked("on", fog));
    CHECK(is_remarked("", fog));
    CHECK_FALSE(is_remarked("off", fog));
    CHECK_FALSE(is_remarked("on", ""));
}

TEST_CASE("POV-Ray: transparent objects that fog fills in another way get a remark") {
    const auto is_remarked = [](const std::string& object, const std::string& modifiers,
                                const std::string& fog = "fog { distance 80 rgb 0.5 }") {
        return read(fog + object + " pigment { rgbt 1 } " + modifiers + " }")
            .remarks_on("hollow is ignored in fog: fog fills exactly the transparent objects");
    };
    const std::string ball = "sphere { 0, 1", bends = "interior { ior 1.5 } ";
    CHECK(is_remarked(ball, ""));
    CHECK(is_remarked(ball, bends + "hollow"));
    CHECK_FALSE(is_remarked(ball, "hollow"));
    CHECK_FALSE(is_remarked(ball, bends + "hollow off"));
    CHECK(is_remarked("union { " + ball + " }", bends + "hollow"));
    CHECK_FALSE(is_remarked("difference { " + ball + " } sphere { x, 1 }", "hollow on"));
    CHECK_FALSE(is_remarked("disc { 0, y, 1", ""));
    CHECK_FALSE(is_remarked(ball, "", ""));
    CHECK_FALSE(read("fog { distance 80 rgb 0.5 } sphere { 0, 1 pigment { rgb 1 } }")
                    .remarks_on("hollow is ignored in fog"));
}

TEST_CASE("POV-Ray: negative components of a surface's colour become 0 with a remark") {
    const std::string what = "negative components of colours are not supported: 0 is used";
    const Read dark = read("sphere { 0, 1 pigment { rgb <-1, 0.5, 0> } }");
    CHECK(dark.material_of().pattern.colors[0] == core::Color(0, 0.5F, 0));
    CHECK(dark.remarks_on(what));
    CHECK(read("plane { y, 0 pigment { checker rgb 1, rgb -1 } }").remarks_on(what));
    CHECK_FALSE(read("sphere { 0, 1 pigment { rgb 0 transmit -1 } }").remarks_on(what));
}

TEST_CASE("POV-Ray: a #switch runs from the first case that holds to a #break") {
    const auto chosen = [](const std::string& value) {
        return number("N", "#declare N = 0; #switch (" + value +
                               ") #case (1) #declare N = N + 1; #case (2) #declare N = N + 10;\n"
                               "#switch (1) #case (1) #break #else #declare N = 77; #end\n"
                               "#if (1) #break #end\n"
                               "#range (3, 5) #declare N = N + 100; #break\n"
                               "#else #declare N = N + 1000; #end");
    };
    CHECK(chosen("1") == "11");
    CHECK(chosen("2") == "10");
    CHECK(chosen("4") == "100");
    CHECK(chosen("6") == "1000");
    CHECK(number("N", "#declare N = 3; #switch (2) #case (1) #declare N = 4; #end") == "3");
    CHECK(complaint("#switch (1) #case (1)").find("must have an #end") != std::string::npos);
}

TEST_CASE("POV-Ray: functions have the values of POV-Ray's") {
    CHECK(number("select(-1, 1, 2, 3) * 100 + select(0, 1, 2, 3) * 10 + select(1, 1, 2, 3)") ==
          "123");
    CHECK(number("select(-1, 1, 2) * 10 + select(0, 1, 2)") == "12");
    CHECK(number("sinh(0) + cosh(0) + tanh(0) + asinh(0) + acosh(1) + atanh(0)") == "1");
    CHECK(number("asc(\"A\") + strcmp(\"a\", \"b\")") == "64");
    CHECK(number("rand(S)", "#declare S = seed(7);") == "0.9539329");
    CHECK(number("rand(S)", "#declare S = seed(7); #declare A = rand(S);") == "0.6104663");
    CHECK(complaint("#declare A = rand(0);") == "a.pov:1:19: must be a result of seed()");
}

TEST_CASE("POV-Ray: maps of colours and layers and skies and functions can be declared") {
    const Read layers = read("#declare M = color_map { [0 rgb 1] [1 rgb 0] }\n"
                             "#declare T = texture { pigment { rgb <0, 1, 0> } }\n"
                             "  texture { pigment { bozo color_map { M } } }\n"
                             "sphere { 0, 1 texture { T } }");
    CHECK(layers.material_of().pattern.colors[0] == core::Vec3f(0.5F));
    const Read seen = read("sphere { 0, 1 texture { pigment { rgb <0, 1, 0> } }\n"
                           "texture { pigment { rgbt <1, 0, 0, 0.75> } } }");
    CHECK(seen.material_of().pattern.colors[0] == core::Vec3f(0.25F, 0.75F, 0.0F));
    CHECK(seen.material_of().opacity == 1.0F);
    CHECK(read("#declare S = sky_sphere { pigment { rgb <0, 0, 1> } }\nsky_sphere { S }")
              .scene.background() == core::Vec3f(0.0F, 0.0F, 1.0F));
    CHECK(number("F(2, 3) * 2", "#declare F = function(a, b) { a + b*b }") == "22");
    CHECK(number("F(1, 2, 3)", "#declare F = function { x + y*z }") == "7");
    CHECK(read("#declare N = normal { bumps 1 } #declare P = function { pigment { bozo } }\n"
               "sphere { 0, 1 normal { N } }")
              .scene.shape_count() == 1);
}

TEST_CASE("POV-Ray: a scene that writes files is rendered and one that reads them is refused") {
    const Read result =
        read("#fopen F \"none.txt\" write\n#write (F, \"a\", (1 + 2) * 3, x, \"\\n\")\n"
             "#fclose F\nsphere { 0, 1 }");
    CHECK(result.scene.shape_count() == 1);
    CHECK(result.remarks == "a.pov:2:2: output to files is ignored\n");
    CHECK(
        complaint("#fopen F \"none.txt\" read").starts_with("a.pov:1:21: must be write or append"));
}
