#include "core/scene/scene.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/pov/read.hpp"
#include "tests/support/catch.hpp"

#include <string>

using namespace raylane;
using tests::camera, tests::complaint, tests::number, tests::read, tests::Read;

namespace {

core::Color color_of(const Read& result, core::ShapeId id = 0) {
    return result.material_of(id).pattern.colors[0];
}

} // namespace

TEST_CASE("POV-Ray: an element of an array may stand wherever a name may") {
    const core::Color red(1, 0, 0), green(0, 1, 0);
    CHECK(color_of(read("#declare T = array[2] { texture { pigment { rgb x } }, "
                        "texture { pigment { rgb y } } }\nsphere { 0, 1 texture { T[1] } }")) ==
          green);
    CHECK(color_of(read("#declare P = array[2] { pigment { rgb x }, pigment { rgb y } }\n"
                        "sphere { 0, 1 pigment { P[0] } }")) == red);
    CHECK(read("#declare F = array[1] { finish { specular 0.75 } } sphere { 0, 1 finish { F[0] } }")
              .material_of()
              .specular == 0.75F);
    CHECK(read("#declare I = array[1] { interior { ior 1.25 } }\n"
               "sphere { 0, 1 pigment { rgbt 1 } interior { I[0] } }")
              .material_of()
              .index == 1.25F);
    CHECK(color_of(read("#declare M = array[1] { material { texture { pigment { rgb y } } } }\n"
                        "sphere { 0, 1 material { M[0] } }")) == green);
    CHECK(read("#declare C = array[1] { camera { location 9*x look_at 0 } } camera { C[0] }\n"
               "sphere { 0, 1 }",
               "")
              .scene.camera()
              .from == core::Vec3f(9, 0, 0));
    CHECK(read("#declare L = array[1] { light_source { 9*x, rgb 1 } } light_source { L[0] }")
              .scene.lights()
              .at(0)
              .position == core::Vec3f(9, 0, 0));
    CHECK(number("1", "#declare T = array[1] { transform { translate 5*x } }\n"
                      "sphere { 0, 1 transform T[0] } sphere { 0, 1 transform { T[0] } }") == "1");
    CHECK(number("strlen(S[1])", "#declare S = array[2] { \"a\", \"abc\" };") == "3");
    CHECK(
        number(
            "V[1].y + A[1][0] + A[0][1]",
            "#declare V = array[2] { x, <1, 20, 3> } #declare A = array[2][2] {{1, 2}, {3, 4}}") ==
        "25");
    CHECK(complaint("#declare T = array[1]; sphere { 0, 1 texture { T[0] } }") ==
          "a.pov:1:48: must be an element with a value, got an unset element of \"T\"");
}

TEST_CASE("POV-Ray: nested arrays keep separate elements") {
    const std::string nested = "#declare A = array[2]; #declare A[0] = array[2] {1, 2};\n"
                               "#declare A[1] = array[1] { sphere { 0, 7 } };\n";
    CHECK(number("A[0][1]", nested) == "2");
    CHECK(read(nested + "object { A[1][0] }").scene.shape_count() == 1);
    CHECK(number("A[0][1]*10 + B[0][1]", nested + "#declare B = A; #declare B[0][1] = 5;") == "25");
    CHECK(number("dimension_size(A[0], 1)", nested) == "2");
    CHECK(number("defined(A[0][1]) + 2*defined(C[1]) + 4*defined(C[0])",
                 nested + "#declare C = array[2]; #declare C[0] = 1;") == "5");
    CHECK(number("N", nested + "#ifdef (A[0][1]) #declare N = 3; #end") == "3");
    CHECK(complaint(nested + "#declare A[0][1][2] = 5;").find("must have fewer indices") !=
          std::string::npos);
    CHECK(complaint("#declare A = array[1] {array[1]} #for (I, 1, 200) #declare A[0][0] = A; #end")
              .find("must not nest arrays more than 128 deep") != std::string::npos);
}

TEST_CASE("POV-Ray: macros that yield numbers may call themselves") {
    const std::string halves = "#macro F(n) #if (n<=1) 0 #else (F(n/2)+1) #end #end\n";
    CHECK(number("F(8)/3", halves) == "1");
    CHECK(number("F(8)*2 + 1", halves) == "7");
    CHECK(number("G(4)", "#macro G(n) #if (n<=1) 1 #else n*G(n-1) #end #end\n") == "24");
    CHECK(number("S(2)*2 + 1",
                 "#macro S(n) #switch (n) #case (1) 10 #break #case (2) 20 #break #end #end\n") ==
          "41");
    CHECK(number("L(3)*2", "#macro L(n) 0 #for (I, 1, n) + I #end #end\n") == "9");
    CHECK(number("D(3)*2", "#macro D(n) n #local Q = n; #debug \"so\" #end\n") == "6");
    CHECK(number("vlength(<2 #if (1) * 3 #end, 0, 0>)") == "6");
    CHECK(number("X", halves + "#declare X = F(8)*2 + 1;") == "7");
}

TEST_CASE("POV-Ray: a name is declared before the next directive that may use it") {
    CHECK(number("N", "#declare N = 5 #if (N = 5) #declare N = 6 #end") == "6");
    CHECK(number("N", "#declare N = 0 #while (N < 3) #declare N = N + 1 #end") == "3");
    CHECK(number("N", "#if (1) #declare N = 1 #else #declare N = 2 #end") == "1");
    CHECK(number("version", "#version 3.6 #if (version = 3.6) #version 3.5 #end") == "3.5");
    // Each #declare ends before the next begins.
    std::string many;
    for (int i = 0; i < 5000; ++i)
        many += "#declare N = " + std::to_string(i) + "\n";
    CHECK(number("N", many) == "4999");
}

TEST_CASE("POV-Ray: the word inverse counts inside the braces of a transformation alone") {
    const std::string turned =
        "#declare T = transform { rotate <0, 90, 90> translate x scale 2 }\n";
    const auto center = [&](const std::string& motion) {
        std::string text;
        scenes::for_each_by_id(read(turned + "sphere { <1, 2, 3>, 1 " + motion + " }").scene,
                               [&](const auto& shape, core::ShapeId) {
                                   CHECK(core::kind_of<std::decay_t<decltype(shape)>> ==
                                         core::Kind::sphere);
                                   for (const auto value : core::numbers_of(shape))
                                       text += scenes::to_text(static_cast<float>(value)) + " ";
                               });
        return text;
    };
    const std::string back = center("scale 1/2 translate -x rotate -90*z rotate -90*y");
    CHECK(back == center("transform { T inverse }"));
    CHECK(back == center("transform { inverse T }"));
    CHECK(back != center("transform { T }"));
    CHECK(center("transform T inverse") == center("transform T"));
    CHECK(center("transform { T transform { T inverse } }") == "1 2 3 1 ");
    CHECK(center("translate <4, 5, 6> transform { translate <4, 5, 6> inverse }") == "1 2 3 1 ");
    CHECK(center("transform { rotate <10, 20, 30> inverse } rotate <10, 20, 30>") == "1 2 3 1 ");
    CHECK(read("#declare T = transform { matrix <1, 2, 0, 0, 1, 0, 0, 0, 1, 5, 6, 7> }\n"
               "box { 0, 1 transform { T } transform { T inverse } }")
              .scene.shape_count() == 1);
}

TEST_CASE("POV-Ray: unions and objects may have lights") {
    const auto positions = [](const std::string& text) {
        std::string joined;
        const Read result = read(text);
        for (const core::Light& light : result.scene.lights())
            joined += std::to_string(static_cast<int>(light.position.x)) + " ";
        return joined;
    };
    CHECK(positions("union { sphere { 0, 1 } light_source { 2*x, rgb 1 } translate x }") == "3 ");
    const std::string light = "#declare L = light_source { x, rgb 1 }\n";
    CHECK(positions(light + "L light_source { L translate x } object { L translate 2*x }") ==
          "1 2 3 ");
    CHECK(positions(light + "#declare U = union { object { L } object { L translate x } }\n"
                            "object { U } object { U translate 9*x }") == "1 2 10 11 ");
    CHECK(positions("difference { sphere { 0, 2 } light_source { 3*x, rgb 1 } sphere { x, 1 } }") ==
          "3 ");
    CHECK(positions("union { light_source { x, rgb 1 } no_image }") == "1 ");
    CHECK(positions(
              "light_group { light_source { x, rgb 1 } sphere { 0, 0.5 } global_lights off }") ==
          "1 ");
    const core::Light parallel =
        read(light + "union { light_source { 2*x, rgb 1 parallel point_at 0 } rotate 90*z }")
            .scene.lights()
            .at(0);
    CHECK(parallel.direction == core::Vec3f(0, -2, 0));
    // POV-Ray's left-handed camera, which mirrors the scene.
    CHECK(read("union { light_source { <1, 2, 3>, rgb 1 } }",
               "camera { location <0, 0, -9> look_at 0 }")
              .scene.lights()
              .at(0)
              .position == core::Vec3f(1, 2, -3));
    CHECK(complaint("#declare U = union { light_source { x, rgb 1 } }\n"
                    "#for (I, 1, 40) #declare U = union { object { U } object { U } } #end\nU")
              .find("must not be of more than 65536 lights") != std::string::npos);
}

TEST_CASE("POV-Ray: declared values that are not rendered are accepted") {
    const Read values = read(
        "#declare N = array[1] { normal { bumps 0.5 scale 2 } } #declare M = media { emission 1 }\n"
        "#declare D = density { spherical } #declare F = function(x, y) { x*y + sin(x) }\n"
        "#declare S = spline { linear_spline 0, x 1, y } #declare R = rainbow { angle 42 }\n"
        "#default { normal { N[0] } }\n"
        "sphere { 0, 1 texture { pigment { rgb x } normal { N[0] } } interior { media { M } } }\n"
        "sphere { 3*x, 1 texture { pigment { function { F(x, y) } color_map { [0 rgb y] [1 rgb y] "
        "} } } }");
    CHECK(color_of(values) == core::Color(1, 0, 0));
    CHECK(color_of(values, 1) == core::Color(0, 1, 0));
    CHECK(complaint("#declare F = function { pigment { rgb x } } sphere { 0, F(1, 2, 3) }") ==
          "a.pov:1:57: must be the name of a number, vector or colour, got \"F\"");
    const Read sky =
        read("#declare S = sky_sphere { pigment { rgb y } pigment { rgbt <1, 0, 0, 0.75> } }\n"
             "#declare F = fog { distance 4 rgb 1 } sky_sphere { S } fog { F }");
    CHECK(sky.scene.background() == core::Color(0.25F, 0.75F, 0));
    CHECK(sky.scene.fog().density == 0.25F);
    const Read horizon =
        read("sky_sphere { pigment { gradient y color_map { [0 rgb 0] [1 rgb 1] } } }");
    CHECK(horizon.scene.background() == core::Color(0.5F, 0.5F, 0.5F));
}

TEST_CASE("POV-Ray: layers of textures are combined into one") {
    const std::string layers =
        "texture { pigment { rgb x } finish { specular 0.5 } } "
        "texture { pigment { rgbt <0, 0, 1, 0.75> } finish { specular 0.25 } }";
    for (const std::string& text : {"sphere { 0, 1 " + layers + " }",
                                    "#declare T = " + layers + " sphere { 0, 1 texture { T } }"}) {
        CAPTURE(text);
        const Read result = read(text);
        CHECK(color_of(result) == core::Color(0.75F, 0, 0.25F));
        CHECK(result.material_of().opacity == 1.0F);
        CHECK(result.material_of().specular == 0.4375F);
        CHECK(result.remarks_on("layered textures are not supported: their mean is used"));
    }
    CHECK(color_of(read("#declare T = texture { pigment { rgb y } }\n"
                        "#declare S = sphere { 0, 1 texture { T } }\nobject { S }")) ==
          core::Color(0, 1, 0));
    const Read checker = read("sphere { 0, 1 texture { pigment { checker rgb 1, rgb 0 } } "
                              "texture { pigment { rgbt <0, 0, 0, 0.5> } } }");
    CHECK(checker.material_of().pattern.kind == core::PatternKind::checker);
    CHECK(color_of(checker) == core::Color(0.5F, 0.5F, 0.5F));
    CHECK(read("sphere { 0, 1 texture { pigment { rgb x } } texture { pigment { rgb y } } }")
              .remarks.empty());
}

TEST_CASE("POV-Ray: words that a scene can do without are accepted") {
    const Read words = read(
        "default { finish { ambient 0.25 } }\n"
        "sphere { 0, 1 uv_mapping pigment { mandel 50 interior 2, 0.5 exterior 1, 1 rgb y } }\n"
        "triangle { <3, 0, 0>, <4, 0, 0>, <3, 1, 0> uv_vectors <0, 0>, <1, 0>, <0, 1> }",
        "camera { mesh_camera { 1 0 mesh { triangle { 0, x, y } } } location 9*z look_at 0 }\n");
    CHECK(words.scene.shape_count() == 2);
    CHECK(words.material_of().ambient == 0.25F);
    CHECK(color_of(words) == core::Color(0, 1, 0));
    CHECK(words.remarks_on("uv_mapping is ignored: patterns are in space"));
}

TEST_CASE("POV-Ray: a light on a surface moves off the surface") {
    const std::string above = "camera { location <0, 3, 9> look_at 0 right -x up y }\n";
    const auto position = [&](const std::string& light, const std::string& object,
                              const std::string& before) {
        const Read result = read("light_source { " + light + ", rgb 1 } " + object, before);
        CHECK(result.remarks_on("lights on a surface are moved off it"));
        return result.scene.lights().at(0).position;
    };
    const auto is_just_above = [](float value, float edge) {
        return value > edge && value < edge + 0.01F;
    };
    const auto is_just_below = [](float value, float edge) {
        return value < edge && value > edge - 0.01F;
    };
    CHECK(is_just_above(position("<2, 0, -3>", "plane { y, 0 }", above).y, 0));
    CHECK(is_just_below(position("<2, 4, -3>", "plane { y, 4 }", above).y, 4));
    CHECK(position("<2, 0, -3>", "plane { y, 0 }", camera).y != 0.0F); // seen edge on
    CHECK(is_just_above(position("z", "sphere { 0, 1 }", above).z, 1));
    CHECK(is_just_below(position("-z", "sphere { 0, 1 }", above).z, -1)); // behind the sphere
    CHECK(is_just_below(position("<0, 5, 0>", "box { <-9, -5, -9>, <9, 5, 10> }", above).y, 5));
    // The camera is at the same point as the light.
    CHECK(is_just_above(position("<0, 0, 9>", "box { -9, 9 }",
                                 "camera { location <0, 0, 9> look_at <0, 0, 20> right -x up y }\n")
                            .z,
                        9));
    CHECK(is_just_below(position("<0, 0, 9>", "box { -9, 9 }", camera).z, 9));
    CHECK_FALSE(
        read("light_source { 2*y, rgb 1 } plane { y, 0 }", above).remarks_on("on a surface"));
}
