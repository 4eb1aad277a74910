#include "core/scene/scene.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;

namespace {

struct Read {
    core::Scene scene;
    std::vector<std::string> remarks;

    bool remarks_on(const std::string& what) const {
        for (const std::string& remark : remarks)
            if (remark.find(what) != std::string::npos) return true;
        return false;
    }
};

LoadOptions noting(std::vector<std::string>& remarks) {
    LoadOptions options;
    options.on_remark = [&](const std::string& remark) { remarks.push_back(remark); };
    return options;
}

/// A right-handed camera as in raylane, so that coordinates are read as they are written.
const std::string camera = "camera { location <0, 0, 9> look_at 0 right -x up y }\n";

Read read(const std::string& text, const std::string& before = camera) {
    std::vector<std::string> remarks;
    core::Scene scene = parse_scene("a.pov", before + text, noting(remarks));
    return {std::move(scene), std::move(remarks)};
}

std::string complaint(const std::string& text) {
    return tests::message_of<BadInput>([&] { parse_scene("a.pov", text); });
}

Read from_program(const std::string& name) {
    const auto path = std::filesystem::path(RAYLANE_SOURCE_DIR) / "tests/scenes/formats/pov" / name;
    std::vector<std::string> remarks;
    core::Scene scene = load_scene(path, noting(remarks));
    return {std::move(scene), std::move(remarks)};
}

/// Returns kind and numbers of all shapes, as text.
std::string shapes_of(const core::Scene& scene) {
    std::string text;
    for_each_by_id(scene, [&](const auto& shape, core::ShapeId) {
        text += core::name_of(core::kind_of<std::decay_t<decltype(shape)>>);
        for (const auto number : core::numbers_of(shape))
            text += " " + to_text(static_cast<float>(number));
        text += "\n";
    });
    return text;
}

const core::Material& material_of(const Read& result, core::ShapeId id = 0) {
    return result.scene.material_of(id);
}

} // namespace

TEST_CASE("shapes are read as they are written") {
    CHECK(shapes_of(read("sphere { <1, 2, 3>, 0.5 }").scene) == "sphere 1 2 3 0.5\n");
    CHECK(shapes_of(read("cylinder { <1, 2, 3> <1, 4, 3> .5 }").scene) ==
          "capped cylinder 1 2 3 0 2 0 0.5\n");
    CHECK(shapes_of(read("cylinder { 0, y, 1 open }").scene) == "open cylinder 0 0 0 0 1 0 1\n");
    CHECK(shapes_of(read("cone { 0, 1, 2*y, 0.5 }").scene) == "capped cone 0 0 0 0 2 0 1 0.5\n");
    CHECK(shapes_of(read("cone { 0, 1, 2*y, 0.5 open }").scene) == "open cone 0 0 0 0 2 0 1 0.5\n");
    CHECK(shapes_of(read("cone { 0, -1, 2*y, 1 }").scene) ==
          "capped cone 0 0 0 0 1 0 1 0\ncapped cone 0 2 0 0 -1 0 1 0\n");
    CHECK(shapes_of(read("cone { 0, -3, 4*y, 1 open }").scene) ==
          "open cone 0 0 0 0 3 0 3 0\nopen cone 0 4 0 0 -1 0 1 0\n");
    CHECK(shapes_of(read("cone { 0, -1, y, -2 }").scene) == "capped cone 0 0 0 0 1 0 1 1\n");
    CHECK(read("intersection { cone { -y, -1, y, 1 } box { -2, 2 } }").scene.solids().any());
    CHECK(shapes_of(read("cone { 0, 0, y, 0 }").scene).empty());
    CHECK(shapes_of(read("box { <1, 1, 1>, <-1, 0, 3> }").scene) ==
          "box -1 0 1 2 0 0 0 1 0 0 0 2\n");
    CHECK(shapes_of(read("plane { y, -2 }").scene) == "plane 0 -2 0 0 1 0\n");
    CHECK(shapes_of(read("plane { y, -2 inverse }").scene).starts_with("plane 0 -2 0 0 1 0"));
    CHECK(shapes_of(read("disc { x, y, 2 }").scene) == "disc 1 0 0 0 1 0 2\n");
    CHECK(shapes_of(read("triangle { 0, x, y }").scene) == "triangle 0 0 0 1 0 0 0 1 0\n");
    CHECK(shapes_of(read("smooth_triangle { 0, z, x, z, y, z }").scene) ==
          "smooth triangle 0 0 0 1 0 0 0 1 0 0 0 1 0 0 1 0 0 1\n");
    CHECK(shapes_of(
              read("mesh { triangle { 0, x, y } smooth_triangle { 0, z, x, z, y, z } }").scene) ==
          "triangle 0 0 0 1 0 0 0 1 0\nsmooth triangle 0 0 0 1 0 0 0 1 0 0 0 1 0 0 1 0 0 1\n");
    CHECK(shapes_of(read("mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0, 2, 1> } }")
                        .scene) == "triangle 0 0 0 0 1 0 1 0 0\n");
    CHECK(read("polygon { 5, 0, x, x+y, y, 0 }").scene.shape_count() == 2);
    CHECK(
        shapes_of(read("quadric { <1, 1, 0>, <0, 0, 0>, <0, 0, 0>, -1 clipped_by { box { -2, 2 } } "
                       "translate <1, 0, 0> }")
                      .scene) == "quadric 1 0 0 1 1 0 0 0 0 0 0 0 -1 -2 -2 -2 2 2 2\n");
}

TEST_CASE("a quadric without a box ends at its ellipsoid or at POV-Ray's greatest depth") {
    const auto ends_of = [](const std::string& text) {
        std::vector<float> ends;
        scenes::for_each_by_id(read(text).scene, [&](const auto& shape, core::ShapeId) {
            for (const auto number : core::numbers_of(shape))
                ends.push_back(static_cast<float>(number));
        });
        REQUIRE(ends.size() == 19);
        return std::vector<float>(ends.end() - 6, ends.end());
    };
    const auto ellipsoid =
        ends_of("quadric { <1, 0.25, 1>, 0, 0, -1 rotate 90*z translate <3, 0, 0> }");
    const float expected[] = {-2.0F, -1.0F, -1.0F, 2.0F, 1.0F, 1.0F};
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(ellipsoid[i] == Approx(expected[i]).epsilon(1e-3));
    for (const float end : ends_of("quadric { <1, 0, 1>, 0, 0, -1 scale 0.1 }"))
        CHECK(std::abs(end) > 1e7F);
    CHECK(read("intersection { quadric { <1, 0, 1>, 0, 0, -1 } plane { y, 1 } plane { -y, 1 } }")
              .scene.shape_count() == 3);
    CHECK(read("difference { box { -1, 1 } quadric { <1, 0, 1>, 0, 0, -0.25 } }")
              .scene.shape_count() == 2);
    CHECK(
        read("quadric { <1, -1, 1>, 0, 0, 0 clipped_by { plane { y, 1 } } }").scene.shape_count() ==
        1);
}

TEST_CASE("transformations of objects are applied in order and exactly") {
    CHECK(shapes_of(read("sphere { x, 1 translate y scale 2 }").scene) == "sphere 2 2 0 2\n");
    CHECK(shapes_of(read("sphere { x, 1 scale 2 translate y }").scene) == "sphere 2 1 0 2\n");
    CHECK(shapes_of(read("sphere { x, 1 rotate 90*z }").scene) == "sphere 0 1 0 1\n");
    CHECK(shapes_of(read("sphere { 0, 1 scale <1, 2, 3> }").scene) ==
          "ellipsoid 0 0 0 1 0 0 0 2 0 0 0 3\n");
    CHECK(shapes_of(read("box { 0, 1 matrix <1, 2, 0, 0, 1, 0, 0, 0, 1, 5, 6, 7> }").scene) ==
          "box 5 6 7 1 2 0 0 1 0 0 0 1\n");
    CHECK(shapes_of(read("#declare T = transform { scale 2 translate x }\n"
                         "union { sphere { 0, 1 } sphere { y, 1 transform T } translate z }")
                        .scene) == "sphere 0 0 1 1\nsphere 1 2 1 2\n");
}

TEST_CASE("expressions and macros and conditions and loops are evaluated") {
    const auto radius = [](const std::string& expression) {
        const std::string text = shapes_of(read("sphere { 0, " + expression + " }").scene);
        return text.substr(13, text.size() - 14);
    };
    CHECK(radius("1 + 2*3 - 4/2") == "5");
    CHECK(radius("-(-2)*+3") == "6");
    CHECK(radius("vlength(<3, 4, 0>)") == "5");
    CHECK(radius("vdot(<1, 2, 3>, <1, 1, 1>) + vcross(x, y).z + <7, 8, 9>.y") == "15");
    CHECK(radius("sqrt(16) + pow(2, 3) + abs(-1) + min(4, 2, 3) + max(1, 5) + floor(2.5)") == "22");
    CHECK(radius("log(1000) + pow(10, -3)*1000 + pow(0.1, -308)*1e-308 + pow(1e-308, 1)*1e308") ==
          "6");
    CHECK(radius("sin(radians(90)) + cos(0) + degrees(pi)") == "182");
    CHECK(radius("(2 > 1 ? 3 : 4) + (1 = 1 & !false)") == "4");
    CHECK(radius("(rgb <0.25, 0.5, 1>).green + (rgbt <0, 0, 0, 0.5>).transmit") == "1");
    CHECK(radius("vaxis_rotate(x, z, 90).y") == "1");
    const std::string text = R"(
        // a comment, /* and */ one /* within /* another */ */
        #macro ball(P, R) sphere { P, R } #end
        #declare N = 0;
        #while (N < 3) ball(N*x, 1) #declare N = N + 1; #end
        #for (I, 10, 14, 2) #if (I = 12) ball(I*x, 2) #else ball(I*x, 3) #end #end
        #ifdef (M) ball(0, 99) #else #ifndef (N) ball(0, 98) #end #end
        #macro twice(A) 2*A #end
        #declare A = array[2][2] {{1, 2}, {3, 4}};
        ball(0, twice(A[1][0]) + 1)
        #macro outer(P) #local N = 50; ball(P*N, 1) #end
        outer(x)
        ball(N*y, 1))";
    CHECK(shapes_of(read(text).scene) == "sphere 0 0 0 1\nsphere 1 0 0 1\nsphere 2 0 0 1\n"
                                         "sphere 10 0 0 3\nsphere 12 0 0 2\nsphere 14 0 0 3\n"
                                         "sphere 0 0 0 7\nsphere 50 0 0 1\nsphere 0 3 0 1\n");
}

TEST_CASE("an object has the texture that it is given or inherits one") {
    const Read one = read(R"(#include "colors.inc"
        #default { finish { ambient 0.25 diffuse 0.5 } }
        union {
            sphere { 0, 1 }
            sphere { x*3, 1 pigment { color Red } finish { specular 0.5 roughness 0.01 } }
            texture { pigment { rgb <0, 1, 0> } finish { phong 0.75 phong_size 10 reflection 0.125 } }
        }
        sphere { y*3, 1 })");
    CHECK(material_of(one).pattern.colors[0] == core::Color(0, 1, 0));
    CHECK(material_of(one).specular == 0.75F);
    CHECK(material_of(one).exponent == 40.0F);
    CHECK(material_of(one).reflectivity == 0.125F);
    CHECK(material_of(one).ambient == 0.25F);
    CHECK(material_of(one, 1).pattern.colors[0] == core::Color(1, 0, 0));
    CHECK(material_of(one, 1).specular == 0.5F);
    CHECK(material_of(one, 1).exponent == 100.0F);
    CHECK(material_of(one, 2).pattern.colors[0] == core::Color(0, 0, 0));
    CHECK(material_of(one, 2).diffuse == 0.5F);

    const Read glass =
        read("sphere { 0, 1 pigment { rgbt <1, 1, 1, 0.75> } finish { ambient 0.5 diffuse 1 "
             "reflection { 0, 1 fresnel on } } interior { ior 1.25 } }");
    CHECK(material_of(glass).transmission == 0.75F);
    CHECK(material_of(glass).index == 1.25F);
    CHECK(material_of(glass).reflection == core::Reflection::dielectric);
    CHECK(material_of(glass).ambient == 0.125F);

    const Read floor = read("plane { y, -1 pigment { checker rgb 1, rgb 0 scale 2 } }");
    CHECK(material_of(floor).pattern.kind == core::PatternKind::checker);
    CHECK(material_of(floor).pattern.size == 2.0F);
    CHECK(material_of(floor).pattern.axes == (1 | 4));
    CHECK(material_of(floor).pattern.colors[0] == core::Color(0, 0, 0)); // the cells below 0
}

TEST_CASE("Materials have the names of declared textures and pigments and materials") {
    const auto names = [](const std::string& text) {
        const Read scene = read(text);
        std::vector<std::string> found;
        for (core::ShapeId id = 0; id < scene.scene.shape_count(); ++id)
            found.emplace_back(scene.scene.material_name(scene.scene.material_index_of(id)));
        return found;
    };
    const std::string declared = R"(
        #declare Clay = pigment { rgb <1, 0, 0> }
        #local Gold = texture { pigment { rgb <0, 1, 0> } finish { specular 0.5 } }
        #declare Copy = Gold
        #declare Glass = material { texture { pigment { rgbt <0, 0, 1, 0.5> } } interior { ior 1.5 } }
        )";
    const std::string begin = declared + "sphere { 0, 1 ", end = " }";
    using Names = std::vector<std::string>;
    CHECK(names(begin + "pigment { Clay }" + end) == Names{"Clay"});
    CHECK(names(begin + "texture { pigment { Clay } finish { ambient 0.5 } }" + end) ==
          Names{"Clay"});
    CHECK(names(begin + "texture { Gold }" + end) == Names{"Gold"});
    CHECK(names(begin + "texture { Gold finish { ambient 0.5 } scale 2 }" + end) == Names{"Gold"});
    CHECK(names(begin + "texture { Copy }" + end) == Names{"Copy"});
    CHECK(names(begin + "material { Glass }" + end) == Names{"Glass"});
    CHECK(names(begin + "pigment { rgb 1 }" + end) == Names{""});
    CHECK(names(begin + end) == Names{""});
    // An object has the name of the default only if it has its pigment.
    CHECK(names(declared + "#default { pigment { Clay } } sphere { 0, 1 pigment { rgb 1 } } "
                           "sphere { x, 1 }") == Names{"", "Clay"});
    CHECK(names(declared + "#default { texture { Gold } } sphere { 0, 1 pigment { rgb 1 } }") ==
          Names{""});
    // Several materials have one name if a loop declares it again.
    CHECK(names("#declare I = 1; #while (I < 3) #declare T = texture { pigment { rgb I/4 } } "
                "sphere { x*I, 1 texture { T } } #declare I = I + 1; #end") == Names{"T", "T"});
}

TEST_CASE("solids of other objects are read as in POV-Ray") {
    const Read solid =
        read("difference { box { -1, 1 } sphere { 0, 1.25 } cylinder { -2*z, 2*z, 0.5 } "
             "pigment { rgb x } }");
    CHECK(solid.scene.solids().any());
    CHECK(solid.scene.shape_count() == 3);
    CHECK_FALSE(read("union { sphere { 0, 1 } box { 0, 1 } }").scene.solids().any());
    CHECK(read("merge { sphere { 0, 1 } box { 0, 1 } }").scene.solids().any());
    CHECK(read("sphere { 0, 1 clipped_by { plane { x, 0 } } }").scene.solids().any());
    CHECK(
        read("intersection { sphere { 0, 1 } cylinder { -y, y, 0.5 open } }").scene.shape_count() ==
        2);
}

TEST_CASE("the version that is in force at the end decides on the gamma") {
    const auto transfer = [](const std::string& text) {
        return read(text + "sphere { 0, 1 }").scene.settings().transfer;
    };
    const std::string include = "#include \"colors.inc\"\n";
    CHECK(transfer("") == core::Transfer::linear);
    CHECK(transfer(include) == core::Transfer::srgb);
    CHECK(transfer("#version 3.6;\n" + include) == core::Transfer::linear);
    CHECK(transfer(include + "#version 3.6;\n") == core::Transfer::linear);
    // POV-Ray's own files begin and end in this way.
    CHECK(transfer("#declare T = version;\n#version 3.5;\n#version T;\n") == core::Transfer::srgb);
    const tests::TemporaryDirectory directory;
    directory.write("own.inc", "#version 3.7;\n");
    CHECK(load_scene(directory.write("a.pov", camera + "#include \"own.inc\"\nsphere { 0, 1 }"))
              .settings()
              .transfer == core::Transfer::srgb);
}

TEST_CASE("a camera along its sky vector keeps its right vector") {
    const core::Camera down =
        read("sphere { 0, 1 }", "camera { location <0, 10, 0> look_at <0, 0, 0> }\n")
            .scene.camera();
    CHECK(down.from == core::Vec3f(0, 10, 0));
    CHECK(core::dot(down.up, core::Vec3f(0, 1, 0)) == 0.0F);
    CHECK(std::abs(down.up.z) == 1.0F);
    CHECK(down.up.x == 0.0F);
}

TEST_CASE("a camera along its sky vector has the handedness of its right and up vectors") {
    const auto up_of = [](const std::string& image) {
        return read("sphere { 0, 1 }", "camera { " + image + " look_at 0 }\n").scene.camera().up;
    };
    // The directions are those of POV-Ray's images. z is negated if the scene is mirrored.
    CHECK(up_of("location 9*y") == core::Vec3f(0, 0, -1));
    CHECK(up_of("location 9*y right -x") == core::Vec3f(0, 0, -1));
    CHECK(up_of("location 9*y up -y") == core::Vec3f(0, 0, 1));
    CHECK(up_of("location 9*y direction -z") == core::Vec3f(0, 0, 1));
    CHECK(up_of("location 9*z sky z right -x") == core::Vec3f(0, 1, 0));
    CHECK(up_of("location 9*y right z up x") == core::Vec3f(-1, 0, 0));
}

TEST_CASE("a camera nearly along its sky vector is as upright as in POV-Ray") {
    const auto up_of = [](const std::string& location) {
        const core::Vec3f up =
            read("sphere { 0, 1 }", "camera { location " + location + " look_at 0 }\n")
                .scene.camera()
                .up;
        return core::Vec3f(std::round(1e6F * up.x), std::round(1e6F * up.y),
                           std::round(1e6F * up.z));
    };
    CHECK(up_of("<10*cos(pi/2), 10, 10*cos(pi/2)>") == core::Vec3f(0, 0, -1e6F));
    CHECK(up_of("<0.0000001, 10, 0>") == core::Vec3f(-1e6F, 0, 0));
    CHECK(up_of("<1, 1, 0>") == core::Vec3f(0, 1e6F, 0)); // as given
}

TEST_CASE("a camera whose axes do not span an image is refused") {
    const std::string axes =
        "a.pov:1:1: must have a right, an up and a direction that are not 0 or along each other";
    CHECK(complaint("camera { location 10*x sky x look_at 0 }") == axes);
    CHECK(complaint("camera { location 10*x up 0 look_at 0 }") == axes);
    CHECK(complaint("camera { location 10*x right 0 }") == axes);
    CHECK(complaint("camera { right 1e200*x up 1e200*y }") == axes);
}

TEST_CASE("the angle of a camera has the bounds of its projection") {
    const auto angle = [](const std::string& image) {
        return "camera { " + image + " location <0, 0, -9> look_at 0 }\nsphere { 0, 1 }";
    };
    CHECK(complaint(angle("angle -1")) == "a.pov:1:10: must be an angle between 0 and 180 degrees");
    CHECK(read(angle("angle 0"), "").scene.camera().field_of_view == Approx(53.1301F));
    CHECK(complaint(angle("orthographic angle 200")) ==
          "a.pov:1:23: must be an angle between 0 and 180 degrees");
    CHECK(read(angle("orthographic angle 0"), "").scene.camera().projection ==
          core::Projection::orthographic);
    CHECK(read(angle("fisheye angle 225"), "")
              .remarks_on("is not supported: the image is in perspective"));
    CHECK(read(angle("spherical angle 360 180"), "")
              .remarks_on("is not supported: the image is in perspective"));
}

TEST_CASE("fog by height and a scene without objects get a remark") {
    const Read ground = read("fog { fog_type 2 distance 5 fog_alt 0.3 rgb 1 } sphere { 0, 1 }");
    CHECK(ground.scene.fog().kind == core::FogKind::none);
    CHECK(ground.remarks_on("ground fog is omitted"));
    CHECK_FALSE(ground.remarks_on("only the background"));
    CHECK(read("").remarks_on("has no objects: the image shows only the background"));
}

TEST_CASE("camera and lights and fog and settings are read as in POV-Ray") {
    const Read flat = read(R"(#version 3.7;
        global_settings { assumed_gamma 1 max_trace_level 7 adc_bailout 0.25 }
        camera { orthographic location <0, 0, 9> look_at <0, 0, 0> right -4*x up 3*y }
        background { color rgb <0.25, 0.5, 1> }
        fog { distance 4 color rgb 1 }
        light_source { <1, 2, 3> color rgb <1, 0.5, 0.25> }
        light_source { <0, 8, 0> rgb 1 parallel point_at <0, 0, 0> }
        sphere { 0, 1 })",
                           "// +W100\n");
    CHECK(flat.scene.camera().projection == core::Projection::orthographic);
    CHECK(flat.scene.camera().height == 3.0F);
    CHECK(flat.scene.camera().from == core::Vec3f(0, 0, 9));
    CHECK(flat.scene.settings().width == 100);
    CHECK(flat.scene.settings().height == 75);
    CHECK(flat.scene.settings().max_depth == 6);
    CHECK(flat.scene.settings().transfer == core::Transfer::srgb);
    CHECK(flat.scene.background() == core::Color(0.25F, 0.5F, 1.0F));
    CHECK(flat.scene.fog().density == 0.25F);
    REQUIRE(flat.scene.lights().size() == 2);
    CHECK(flat.scene.lights()[1].direction == core::Vec3f(0, -8, 0));

    // The default camera is left-handed, so the scene is mirrored. Older scenes have no gamma.
    const Read left = read("camera { location <0, 0, -9> look_at 0 angle 90 right 2*x up y } "
                           "sphere { z, 1 }",
                           "");
    CHECK(shapes_of(left.scene) == "sphere 0 0 -1 1\n");
    CHECK(left.scene.camera().from == core::Vec3f(0, 0, 9));
    CHECK(left.scene.camera().field_of_view == Approx(53.1301F));
    CHECK(left.scene.settings().transfer == core::Transfer::linear);
    // Transformations of a camera apply last, wherever they are written.
    const Read moved =
        read("camera { translate x location <0, 0, 9> look_at 0 right -x up y }", "");
    CHECK(moved.scene.camera().from == core::Vec3f(1, 0, 9));
    CHECK(moved.scene.camera().at == core::Vec3f(1, 0, 0));
}

TEST_CASE("each feature that is rendered in another way gets one remark") {
    const Read one = read("sphere { 0, 1 no_shadow } sphere { 3*x, 1 no_shadow }\n"
                          "light_source { <9, 9, 9> rgb 1 spotlight radius 3 }");
    REQUIRE(one.remarks.size() == 2);
    CHECK(one.remarks[0] == "a.pov:2:15: no_shadow is ignored: the objects cast shadows");
    CHECK(one.remarks_on("a.pov:3:32: spotlight is ignored"));
}

TEST_CASE("a mistake gives an error of one line with its position") {
    CHECK(complaint("sphere { 0, 1 }\n torus { 1, 2 }") ==
          "a.pov:2:2: must be made of quadrics, got \"torus\", which is not supported");
    CHECK(complaint("sphere { 0, }") == "a.pov:1:13: must be a number, got \"}\"");
    CHECK(complaint("sphere { 0, R }") ==
          "a.pov:1:13: must be a number, got the unknown name \"R\"");
    CHECK(complaint("sphere { 0, 1 frobnicate }") ==
          "a.pov:1:15: must be of an object, got \"frobnicate\"");
    CHECK(complaint("/* comment") == "a.pov:1:1: must have an end, got a comment without \"*/\"");
    CHECK(complaint("#if (1)\nsphere { 0, 1 }") ==
          "a.pov:1:1: must have an #end before the end of a.pov");
    CHECK(complaint("#error \"too old\"") == "a.pov:1:1: #error: too old");
    CHECK(complaint("#include \"none.inc\"")
              .starts_with("a.pov:1:10: must be a file in the folder of this file"));
    CHECK(complaint("#declare A = 1/0;") == "a.pov:1:15: must not be divided by 0");
    CHECK(complaint("intersection { sphere { 0, 1 } triangle { 0, x, y } }")
              .starts_with("a.pov:1:32: must have an inside"));
}

TEST_CASE("POV-Ray's language is recognised by the ending and by the beginning of a file") {
    const auto shapes = [](const std::string& name, const std::string& text) {
        return parse_scene(name, text).shape_count();
    };
    CHECK(shapes("a.POV", "sphere { 0, 1 }") == 1);
    CHECK(shapes("a", "// by hand\n/* so */ #version 3.7;\nsphere { 0, 1 }") == 1);
    CHECK(shapes("a", "camera\n{ look_at z } sphere { 0, 1 }") == 1);
    CHECK(tests::message_of<BadInput>([&] {
              shapes("a", "// JSON\n{ camera { }");
          }).find("a:2:3: ") == 0);
}

TEST_CASE("endless recursions and loops end with an error") {
    CHECK(complaint("#macro A() A() #end A()").find("deep") != std::string::npos);
    const std::string words = "must not expand to more than 100 million words",
                      bytes = "must not take more than 256 MB";
    const std::string loops[] = {
        "#macro A(n) #if (n > 0) A(n - 1) A(n - 1) #end #end A(100)", "#while (1) #end",
        "camera { location 1 } #while (1) sphere { 0, 1 } #end",
        "#declare F = function(x) { x + 1 } #declare S = 0; #while (1) #declare S = F(S); #end"};
    // Each one takes seconds; under sanitizers, a minute.
    const int count = raylane::tests::fixed_rounds(1, 0, 4);
    for (int i = 0; i < count; ++i)
        CHECK(complaint(loops[i]).find(words) != std::string::npos);
    const std::string many = "#declare A = union { #for (I, 1, 1000) sphere { I, 1 } #end }\n";
    CHECK(complaint(many + "#while (1) object { A } #end").find(words) != std::string::npos);
    CHECK(complaint("#while (1) sphere { 0, 1 } #end").find(bytes) != std::string::npos);
    CHECK(complaint("union { #while (1) sphere { 0, 1 } #end }").find(bytes) != std::string::npos);
    CHECK(complaint("mesh { #while (1) triangle { 0, x, y } #end }").find(bytes) !=
          std::string::npos);
    CHECK(complaint("#for (I, 1, 1e7) sphere { 0, 1 pigment { rgb I } } #end").find(bytes) !=
          std::string::npos);
    CHECK(complaint("#declare B = array[1000000];\n"
                    "#for (I, 0, 999999) #declare B[I] = texture { pigment { rgb I } } #end")
              .find(bytes) != std::string::npos);
    const std::string text = "#declare S = \"0123456789abcdef\"; "
                             "#for (I, 1, 12) #declare S = concat(S, S); #end\n",
                      arrays = "#declare B = array[1000];\n";
    CHECK(complaint(text + "#while (1) #declare T = concat(S, \"\"); #end").find(bytes) !=
          std::string::npos);
    CHECK(complaint(arrays + "#for (I, 0, 999) #declare B[I] = array[1000000]; #end").find(bytes) !=
          std::string::npos);
    CHECK(
        complaint(arrays + "#declare C = array[1000000]; #for (I, 0, 999) #declare B[I] = C; #end")
            .find(bytes) != std::string::npos);
    // Values that are gone do not count.
    CHECK(read("#for (I, 1, 100) #declare C = array[100000]; #end sphere { 0, 1 }")
              .scene.shape_count() == 1);
    std::string doubled = "#declare A = sphere { 0, 1 }\n";
    for (int i = 0; i < 40; ++i)
        doubled += "#declare A = union { object { A } object { A } }\n";
    CHECK(complaint(doubled + "object { A }").find("more than") != std::string::npos);
    CHECK(complaint("sphere { 0, " + std::string(100000, '(')).find("deep") != std::string::npos);
}

TEST_CASE("scenes by other programs are read") {
    CHECK(from_program("ase.pov").scene.shape_count() == 37);
    CHECK(from_program("ase.pov").scene.settings().transfer == core::Transfer::srgb);
    CHECK(from_program("pymol.pov").scene.shape_count() > 20);
    const Read surface = from_program("pymol_surface.pov");
    CHECK(surface.scene.shape_count() == 3);
    CHECK(surface.remarks_on("different colours at the corners of a triangle are not supported"));
    const Read vmd = from_program("vmd.pov");
    CHECK(vmd.scene.settings().width == 512);
    CHECK(shapes_of(vmd.scene).starts_with(
        "sphere 0 0 0 0.2645\nsphere 0.464 -0.2429 0.6897 0.2594\n"
        "open cylinder 0 0 0 0.231984 -0.12144 0.344874 0.0512\n"));
    const Read ovito = from_program("ovito.pov");
    CHECK(ovito.scene.shape_count() == 4);
    CHECK(ovito.scene.camera().height == 13.8917F);
}
