#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/tachyon/reader.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;
using core::Color, core::Vec3f;

namespace {

const std::string begin = "BEGIN_SCENE\nRESOLUTION 40 30\n";
const std::string plain = " TEXTURE AMBIENT 0.1 DIFFUSE 0.8 SPECULAR 0 OPACITY 1 COLOR 1 0.5 0.25 "
                          "TEXFUNC 0\n";
const std::string ball = "SPHERE CENTER 1 2 3 RAD 0.5" + plain;

struct Reading {
    core::Scene scene;
    std::vector<std::string> remarks;
};

Reading read(const std::string& body, const TachyonShading& over = {}) {
    LoadOptions options;
    std::vector<std::string> remarks;
    options.on_remark = [&](const std::string& remark) {
        if (!remark.ends_with("the image shows only the background")) remarks.push_back(remark);
    };
    options.tachyon = over;
    core::Scene scene = parse_scene("a.dat", begin + body + "\nEND_SCENE\n", options);
    return {std::move(scene), remarks};
}

/// Returns the scene of a body that is read without remarks.
core::Scene scene_of(const std::string& body) {
    Reading reading = read(body);
    CHECK(reading.remarks == std::vector<std::string>());
    return std::move(reading.scene);
}

std::string complaint(const std::string& body) {
    return tests::message_of<BadInput>([&] { read(body); });
}

std::string data(const std::string& name) {
    return RAYLANE_SOURCE_DIR "/tests/scenes/formats/tachyon/data/" + name;
}

std::string camera(const std::string& before, const std::string& zoom = "1") {
    return "CAMERA " + before + " ZOOM " + zoom +
           " ASPECTRATIO 1 ANTIALIASING 3 RAYDEPTH 5 CENTER 1 2 -6 VIEWDIR 0 0 2 UPDIR 0 1 0 ";
}

} // namespace

TEST_CASE("a Tachyon camera is read with its z negated") {
    const core::Scene scene = scene_of(camera("") + "END_CAMERA");
    CHECK(scene.camera().from == Vec3f(1, 2, 6));
    CHECK(core::normalized(scene.camera().at - scene.camera().from) == Vec3f(0, 0, -1));
    CHECK(scene.camera().up == Vec3f(0, 1, 0));
    CHECK(std::abs(scene.camera().field_of_view - 53.130102F) < 1e-5F);
    CHECK(scene.settings().width == 40);
    CHECK(scene.settings().height == 30);
    CHECK(scene.settings().grid == 2);
    CHECK(scene.settings().max_depth == 4);
    CHECK(scene.settings().transfer == core::Transfer::linear);

    const core::Scene flat = scene_of(camera("PROJECTION ORTHOGRAPHIC", "0.25") + "END_CAMERA");
    CHECK(flat.camera().projection == core::Projection::orthographic);
    CHECK(flat.camera().height == 4.0F);
    const core::Scene frustum = scene_of(camera("") + "FRUSTUM -1 1 -1 1 END_CAMERA");
    CHECK(std::abs(frustum.camera().field_of_view - 90.0F) < 1e-5F);
    const core::Scene lens =
        scene_of(camera("PROJECTION PERSPECTIVE_DOF FOCALLENGTH 4 APERTURE 0.5") + "END_CAMERA");
    CHECK(lens.camera().lens_radius == 0.25F);
    CHECK(lens.camera().focus_distance == 1.0F);
    // The default camera is at the origin.
    CHECK(scene_of("").camera().from == Vec3f(0.0F));
}

TEST_CASE("a Tachyon texture becomes one material") {
    const std::string red = "TEXDEF red AMBIENT 0.1 DIFFUSE 0.5 SPECULAR 0.25 OPACITY 1 PHONG "
                            "PLASTIC 0.75 PHONG_SIZE 40 COLOR 1 0 0 TEXFUNC 0\nTEXALIAS r red\n";
    const core::Scene scene = scene_of(red +
                                       "SPHERE CENTER 0 0 0 RAD 1 red SPHERE CENTER 3 0 0 "
                                       "RAD 1 r " +
                                       ball);
    REQUIRE(scene.materials().size() == 2);
    CHECK(scene.material_name(0) == "red");
    CHECK(scene.material_name(1).empty());
    const core::Material& material = scene.material_of(0);
    CHECK(material.pattern.colors[0] == Color(1, 0, 0));
    CHECK(material.ambient == 0.1F);
    CHECK(material.diffuse == 0.5F);
    CHECK(material.reflectivity == 0.25F);
    CHECK(material.specular == 0.75F);
    CHECK(material.exponent == 40.0F);
    CHECK(scene.material_index_of(1) == 0);
    CHECK(scene.material_of(2).pattern.colors[0] == Color(1, 0.5F, 0.25F));
    CHECK(scene.material_of(2).specular == 0.0F);

    // The first definition of a name counts.
    const std::string blue =
        "TEXDEF red AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 0 0 1 TEXFUNC 0\n";
    CHECK(scene_of(red + blue + "SPHERE CENTER 0 0 0 RAD 1 red").material_of(0).pattern.colors[0] ==
          Color(1, 0, 0));

    TachyonShading over;
    over.highlight = TachyonShading::Highlight::none;
    CHECK(read(red + "SPHERE CENTER 0 0 0 RAD 1 r", over).scene.material_of(0).specular == 0.0F);
    over.quality = TachyonShading::Quality::flat;
    CHECK(read(ball, over).scene.material_of(0).ambient == 1.0F);
}

TEST_CASE("a Tachyon surface is as transparent as its mode says") {
    const auto material = [](const std::string& mode, const std::string& opacity) {
        Reading reading = read("SHADER_MODE FULL " + mode +
                               " END_SHADER_MODE SPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 0.25 "
                               "DIFFUSE 0.5 SPECULAR 0.25 OPACITY " +
                               opacity + " PHONG PLASTIC 0.75 PHONG_SIZE 40 COLOR 1 0 0 TEXFUNC 0");
        CHECK(reading.remarks == std::vector<std::string>());
        return reading.scene.material_of(0);
    };
    const core::Material weighed = material("TRANS_VMD", "0.5");
    CHECK(weighed.opacity == 0.5F);
    CHECK(weighed.ambient == 0.25F);
    // TRANS_ORIG adds the light from behind to the whole 0.25, which is 0.5 at opacity 0.5.
    for (const char* const mode : {"", "TRANS_ORIG"}) {
        const core::Material added = material(mode, "0.5");
        CHECK(added.opacity == 0.5F);
        CHECK(added.ambient == 0.5F);
        CHECK(added.diffuse == 1.0F);
        CHECK(added.specular == 1.5F);
        CHECK(added.reflectivity == 0.5F);
    }
    const core::Material unseen = material("", "0");
    CHECK(unseen.opacity < 0.001F);
    CHECK(unseen.opacity * unseen.diffuse == 0.5F);
    CHECK(material("TRANS_VMD", "0").opacity == 0.0F);
    CHECK(material("", "1").opacity == 1.0F);
    CHECK(material("", "2").opacity == 1.0F);
    CHECK(material("TRANS_MAX_SURFACES 0", "0.5").opacity == 0.0F);

    const auto most = [](const std::string& mode) {
        return scene_of("SHADER_MODE FULL " + mode + " END_SHADER_MODE").settings().max_transparent;
    };
    CHECK(most("") == core::Settings::transparent_limit);
    CHECK(most("TRANS_MAX_SURFACES 3") == 3);
    CHECK(most("TRANS_MAX_SURFACES 2000000000") == core::Settings::transparent_limit);
    CHECK(read("SHADER_MODE FULL TRANS_RASTER3D TRANS_VMD END_SHADER_MODE SPHERE CENTER 0 0 0 RAD "
               "1 TEXTURE AMBIENT 0 DIFFUSE 0 SPECULAR 0 OPACITY 0.5")
              .remarks ==
          std::vector<std::string>{
              "a.dat:3: TRANS_RASTER3D is ignored: opacity does not change with the angle"});
    CHECK(read("SHADER_MODE FULL SHADOW_FILTER_OFF END_SHADER_MODE").remarks.size() == 1);
    CHECK(read("SHADER_MODE FULL SHADOW_FILTER_ON END_SHADER_MODE").remarks.empty());
}

TEST_CASE("the objects of Tachyon become shapes") {
    const auto count = [&](const std::string& body) { return scene_of(body).shape_count(); };
    CHECK(count(ball) == 1);
    CHECK(count("CYLINDER CENTER 0 0 0 AXIS 0 1 0 RAD 1" + plain) == 1);
    CHECK(count("FCYLINDER BASE 0 0 0 APEX 0 1 0 RAD 1" + plain) == 1);
    CHECK(count("Fcylinder Center 0 0 0 Axis 0 1 0 Rad 1" + plain) == 1);
    CHECK(count("POLYCYLINDER POINTS 3 0 0 0 1 0 0 1 1 0 RAD 0.1" + plain) == 5);
    CHECK(count("TRI V0 0 0 0 V1 1 0 0 V2 0 1 0" + plain) == 1);
    CHECK(count("STRI V0 0 0 0 V1 1 0 0 V2 0 1 0 N0 0 0 1 N1 0 0 1 N2 0 0 1" + plain) == 1);
    CHECK(count("PLANE CENTER 0 0 5 NORMAL 0 0 1" + plain) == 1);
    CHECK(count("RING CENTER 0 0 5 NORMAL 0 0 1 INNER 0 OUTER 2" + plain) == 1);
    CHECK(count("RING CENTER 0 0 5 NORMAL 0 0 1 INNER 1 OUTER 2" + plain) == 1);
    CHECK(count("BOX MIN -1 -1 -1 MAX 1 1 1" + plain) == 1);
    CHECK(count("VERTEXARRAY NUMVERTS 4 COORDS 0 0 0 1 0 0 0 1 0 1 1 0 NORMALS 0 0 1 0 0 1 0 0 1 "
                "0 0 1 COLORS 1 0 0 1 0 0 1 0 0 1 0 0" +
                plain + "TRISTRIP 4 0 1 2 3 TRIMESH 1 0 2 3 END_VERTEXARRAY") == 3);
    const Reading colored = read("VCSTRI V0 0 0 0 V1 1 0 0 V2 0 1 0 N0 0 0 1 N1 0 0 1 N2 0 0 1 C0 "
                                 "1 0 0 C1 0 1 0 C2 0 0 1 AMBIENT 1 DIFFUSE 0 SPECULAR 0 OPACITY "
                                 "1");
    CHECK(colored.scene.material_of(0).pattern.colors[0] == Color(1.0F / 3.0F));
    CHECK(colored.remarks.size() == 1);
}

TEST_CASE("objects without an extent in a Tachyon scene are left out with one remark") {
    const Reading reading =
        read("SPHERE CENTER 0 0 0 RAD 0" + plain + "TRI V0 0 0 0 V1 1 1 1 V2 2 2 2" + plain +
             "FCYLINDER BASE 1 1 1 APEX 1 1 1 RAD 1" + plain + ball);
    CHECK(reading.scene.shape_count() == 1);
    CHECK(reading.remarks ==
          std::vector<std::string>{"a.dat:3: objects without a size are omitted"});
}

TEST_CASE("a Tachyon clip group cuts each of its objects") {
    const core::Scene scene =
        scene_of("START_CLIPGROUP NUMPLANES 2 1 0 0 0.5 0 0 2 6\n" + ball +
                 "TRI V0 0 0 0 V1 1 0 0 V2 0 1 0" + plain + "TRI V0 2 0 0 V1 3 0 0 V2 2 1 0" +
                 plain + "END_CLIPGROUP\n" + ball);
    // A ball, half a triangle in two parts, nothing of the second triangle, a ball.
    CHECK(scene.shape_count() == 4);
    CHECK(scene.solids().any());
}

TEST_CASE("Tachyon's lights and ambient occlusion become lights") {
    const core::Scene scene =
        scene_of("LIGHT CENTER 1 2 3 RAD 0 COLOR 0.5 0.25 1\nDIRECTIONAL_LIGHT DIRECTION 1 2 3 "
                 "COLOR 1 1 1\nLIGHT CENTER 0 0 1 RAD 0 ATTENUATION CONSTANT 2 LINEAR 0 QUADRATIC "
                 "0 COLOR 1 1 0.5\n");
    REQUIRE(scene.lights().size() == 3);
    CHECK(scene.lights()[0].position == Vec3f(1, 2, -3));
    CHECK(scene.lights()[0].color == Color(0.5F, 0.25F, 1));
    CHECK(scene.lights()[1].direction == Vec3f(1, 2, -3));
    CHECK(scene.lights()[2].color == Color(0.5F, 0.5F, 0.25F));

    const std::string light = "DIRECTIONAL_LIGHT DIRECTION 0 0 1 COLOR 1 1 1\n";
    const std::string sky = " AMBIENT_OCCLUSION AMBIENT_COLOR 0.5 0.5 1 RESCALE_DIRECT 0.25 "
                            "SAMPLES 16 END_SHADER_MODE\n";
    const core::Scene full = scene_of("SHADER_MODE FULL" + sky + light);
    REQUIRE(full.lights().size() == 2);
    CHECK(full.lights()[0].color == Color(0.25F));
    CHECK(full.lights()[1].kind == core::LightKind::sky);
    CHECK(full.lights()[1].color == Color(0.5F, 0.5F, 1));
    CHECK(full.lights()[1].ground == Color(0.5F, 0.5F, 1));
    CHECK(full.settings().light_samples == 16);
    const Reading medium = read("SHADER_MODE MEDIUM" + sky + light);
    CHECK(medium.scene.lights().size() == 1);
    CHECK(medium.remarks ==
          std::vector<std::string>{
              "a.dat: SHADER_MODE MEDIUM is not supported: objects cast shadows, same as FULL"});
    TachyonShading over;
    over.sky = Color(0.75F);
    over.direct = 0.5F;
    const core::Scene overridden = read("SHADER_MODE FULL" + sky + light, over).scene;
    CHECK(overridden.lights()[0].color == Color(0.5F));
    CHECK(overridden.lights()[1].color == Color(0.75F));
}

TEST_CASE("a Tachyon light on a surface moves off the surface") {
    const Reading reading = read(ball + "LIGHT CENTER 1 2 3.5 RAD 0 COLOR 1 1 1\n");
    CHECK(reading.remarks ==
          std::vector<std::string>{"a.dat: LIGHT: a light on a surface is moved off it"});
    CHECK(reading.scene.lights().at(0).position.z != -3.5F);
    CHECK(reading.scene.lights().at(0).position.z == Approx(-3.5F).epsilon(0.01));
}

TEST_CASE("Tachyon's background and fog are read or approximated with a remark") {
    CHECK(scene_of("BACKGROUND 0.1 0.2 0.3").background() == Color(0.1F, 0.2F, 0.3F));
    const std::string gradient = "BACKGROUND_GRADIENT SKY_SPHERE UPDIR 0 1 0 TOPVAL 1 BOTTOMVAL "
                                 "-1 TOPCOLOR 1 0 0 BOTTOMCOLOR 0 0 1";
    CHECK(read(gradient).scene.background() == Color(0.5F, 0, 0.5F));
    CHECK(read(gradient).remarks.size() == 1);
    const core::Fog linear = scene_of("FOG LINEAR START 1 END 5 DENSITY 1 COLOR 0.5 0.5 0.5").fog();
    CHECK(linear.kind == core::FogKind::linear);
    CHECK(linear.start == 1.0F);
    CHECK(linear.end == 5.0F);
    const core::Fog exponential = scene_of("FOG EXP START 0 END 5 DENSITY 0.5 COLOR 1 1 1").fog();
    CHECK(exponential.kind == core::FogKind::exponential);
    CHECK(exponential.density == 0.5F);
    CHECK(scene_of("FOG OFF").fog().kind == core::FogKind::none);
    CHECK(scene_of("SHADER_MODE LOW END_SHADER_MODE FOG EXP DENSITY 1 COLOR 1 1 1").fog().kind ==
          core::FogKind::none);
    const std::string planar = "SHADER_MODE FULL FOG_VMD END_SHADER_MODE BACKGROUND 1 1 1 ";
    CHECK(scene_of(planar + camera("PROJECTION ORTHOGRAPHIC") +
                   "END_CAMERA FOG EXP DENSITY 0.5 COLOR 1 1 1")
              .fog()
              .kind == core::FogKind::exponential);
    CHECK(read(planar + camera("") + "END_CAMERA FOG EXP DENSITY 0.5 COLOR 1 1 0").remarks ==
          std::vector<std::string>{
              "a.dat: FOG_VMD: the background has the colour of the fog",
              "a.dat: FOG_VMD is ignored: fog depends on distance, not on depth"});
    const Reading squared =
        read(planar + camera("") + "END_CAMERA FOG EXP2 START 0 END 9 DENSITY 0.5 COLOR 1 1 1");
    CHECK(squared.scene.fog().kind == core::FogKind::linear_z);
    CHECK(squared.remarks.size() == 1);
    // The line is within 0.04 of the curve where the curve is not close to 0 or 1.
    for (const float depth : {1.0F, 1.5F, 2.0F, 2.5F}) {
        const core::Fog& fog = squared.scene.fog();
        const float share = (6.0F - depth - fog.start) / (fog.end - fog.start);
        CHECK(std::abs(share - (1.0F - std::exp(-0.25F * depth * depth))) < 0.04F);
    }
}

TEST_CASE("each unsupported feature of a Tachyon scene gives one remark") {
    const std::string image = " TEXTURE AMBIENT 0.1 DIFFUSE 0.8 SPECULAR 0 OPACITY 1 PHONG METAL "
                              "0.5 PHONG_SIZE 9 COLOR 1 1 1 TEXFUNC 9 a.ppm CENTER 0 0 0 ROTATE 0 "
                              "0 0 SCALE 1 1 1 UAXIS 1 0 0 VAXIS 0 1 0\n";
    const Reading reading =
        read("SPHERE CENTER 0 0 0 RAD 1" + image + "SPHERE CENTER 3 0 0 RAD 1" + image +
             "SPHERE CENTER 6 0 0 RAD 1 nothing\nSCAPE RES 3 3 SCALE 1 1 CENTER 0 0 0" + plain +
             "IMAGEDEF ::x FORMAT RGB24 RESOLUTION 2 1 1 ENCODING HEX f00 00f\n");
    CHECK(reading.scene.shape_count() == 3);
    CHECK(reading.remarks ==
          std::vector<std::string>{
              "a.dat:3: METAL is ignored: highlights have its brightness, but not its colour",
              "a.dat:3: TEXFUNC is ignored: COLOR replaces images and patterns",
              "a.dat:5: the texture \"nothing\" is not defined",
              "a.dat:6: SCAPE is omitted: landscapes are not supported"});
}

TEST_CASE("a Tachyon scene is recognised by its first word") {
    const std::string scene = "# by hand\n  Begin_Scene resolution 4 4 " + ball + "End_Scene";
    CHECK(parse_scene("a.dat", scene).shape_count() == 1);
    CHECK(parse_scene("standard input", scene).shape_count() == 1);
    CHECK(tests::message_of<BadInput>([&] {
              parse_scene("a", "begin_scenery");
          }).find("Tachyon .dat") != std::string::npos);
}

TEST_CASE("a Tachyon scene can include files in its folder") {
    const tests::TemporaryDirectory directory;
    directory.write("balls.dat", ball + ball + "SPHERE CENTER x");
    const std::filesystem::path path =
        directory.write("a.dat", begin + "INCLUDE balls.dat\nEND_SCENE");
    CHECK(tests::message_in<BadInput>(directory.path(), [&] { load_scene(path); }) ==
          "balls.dat:3: SPHERE: center: must be a finite number, got \"x\"");
    directory.write("balls.dat", "INCLUDE balls.dat");
    CHECK(tests::message_in<BadInput>(directory.path(), [&] { load_scene(path); }) ==
          "balls.dat:1: INCLUDE: must not be included more than 16 deep");
    directory.write("balls.dat", ball);
    CHECK(load_scene(path).shape_count() == 1);
    // Each file includes ten more, over several levels. The limit is 1,000.
    directory.write("deep.dat", "");
    for (const std::string name : {"d.dat", "c.dat", "b.dat", "balls.dat"}) {
        std::string text;
        for (int i = 0; i < 10; ++i)
            text += "INCLUDE " +
                    std::string(name == "d.dat"   ? "deep.dat"
                                : name == "c.dat" ? "d.dat"
                                : name == "b.dat" ? "c.dat"
                                                  : "b.dat") +
                    "\n";
        directory.write(name, text);
    }
    CHECK(tests::message_in<BadInput>(directory.path(), [&] {
              load_scene(path);
          }).ends_with(": INCLUDE: must be one of at most 1000 included files"));
}

TEST_CASE("each mistake in a Tachyon scene gives an error with its line") {
    const std::vector<std::pair<std::string, std::string>> mistakes = {
        {"SPHERE CENTER 1 2\n3 RAD big",
         "a.dat:4: SPHERE of line 3: rad: must be a finite number, got \"big\""},
        {"SPHERE RAD 1", "a.dat:3: SPHERE: must continue with CENTER, got \"RAD\""},
        {"Sphere center 1e40 0 0",
         "a.dat:3: Sphere: center: must be a number from -1e30 to 1e30, got \"1e40\""},
        {"BALL", "a.dat:3: must be an object or another statement of Tachyon, got \"BALL\""},
        {ball + "INCLUDE -",
         "a.dat:4: INCLUDE: must be the name of a file, got \"-\", but - does not exist"},
        {"PLANE CENTER 0 0 0 NORMAL 0 0 0" + plain,
         "a.dat:3: PLANE: normal: must not be the zero vector, got [0, 0, 0]"},
        {"TEXDEF t AMBIENT -1 DIFFUSE 0 SPECULAR 0 OPACITY 1\nSPHERE CENTER 0 0 0 RAD 1 t",
         "a.dat:4: SPHERE: ambient: must not be negative, got -1"},
        {"RESOLUTION 0 5", "a.dat:3: RESOLUTION: width: must be a whole number from 1 to 65535, "
                           "got \"0\""},
        {"CAMERA ZOOM 0 ASPECTRATIO 1", "a.dat:3: CAMERA: zoom: must be positive, got 0"},
        {"VERTEXARRAY NUMVERTS 3 COORDS 0 0 0 1 0 0 0 1 0" + plain + "TRIMESH 1 0 1 3",
         "a.dat:4: VERTEXARRAY of line 3: corner: must be a whole number from 0 to 2, got \"3\""},
        {"VERTEXARRAY NUMVERTS 3 TRISTRIP 3 0 1 2",
         "a.dat:3: VERTEXARRAY: must continue with COORDS of more than 0 corners before triangles, "
         "got \"0\""},
        {"SHADER_MODE HIGH",
         "a.dat:3: SHADER_MODE: must continue with FULL, MEDIUM, LOW or LOWEST, got \"HIGH\""},
        {"SHADER_MODE FULL AMBIENT_OCCLUSION AMBIENT_COLOR 1 1 1 RESCALE_DIRECT -1",
         "a.dat:3: SHADER_MODE: rescale_direct: must not be negative, got -1"},
        {"LIGHT CENTER 0 0 0 RAD 0 COLOR -1 0 0",
         "a.dat:3: LIGHT: color/0: must not be negative, got -1"},
        {"FOG CUBIC", "a.dat:3: FOG: must continue with LINEAR, EXP, EXP2 or OFF, got \"CUBIC\""},
        {camera("") + "UPDIR", "a.dat:3: CAMERA: must continue with END_CAMERA, got \"UPDIR\""},
        {"CAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 1 CENTER 0 0 0 VIEWDIR 0 1 0 UPDIR "
         "0 1 0 END_CAMERA",
         "a.dat: up: must not be along the line of sight, got [0, 1, 0]"},
        {"START_CLIPGROUP NUMPLANES 1 0 0 0 1",
         "a.dat:3: START_CLIPGROUP: plane: must have a normal, got 0 0 0"},
    };
    for (const auto& [body, message] : mistakes) {
        INFO(body);
        CHECK(complaint(body) == message);
    }
    CHECK(tests::message_of<BadInput>([] {
              InputFile file("a.dat", "v from");
              read_tachyon(file);
          }) == "a.dat:1: must be BEGIN_SCENE at the start of a scene, got \"v\"");
    CHECK(tests::message_of<BadInput>([] { parse_scene("a.dat", begin + ball); }) ==
          "a.dat: must end with END_SCENE, got a truncated file");
}

TEST_CASE("a Tachyon scene that is truncated or damaged anywhere gives at most one line of error") {
    for (const char* const name : {"vmd.dat", "named.dat"}) {
        const std::string text = tests::content_of(data(name));
        REQUIRE(!text.empty());
        for (std::size_t size = 0; size < text.size() - 12; size += 7) {
            const std::string message = tests::message_of<BadInput>(
                [&] { parse_scene("a.dat", std::string_view(text).substr(0, size)); });
            CHECK(message.starts_with("a.dat"));
            CHECK(message.find('\n') == std::string::npos);
        }
        for (std::size_t at = 0; at < text.size(); at += 5) {
            std::string damaged = text;
            damaged[at] = "-9z.\x01"[at % 5];
            const std::string message =
                tests::message_of<BadInput>([&] { parse_scene("a.dat", damaged); });
            CHECK(message.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("Tachyon scenes in the form of VMD and others are read") {
    LoadOptions options;
    std::vector<std::string> remarks;
    options.on_remark = [&](const std::string& remark) { remarks.push_back(remark); };
    const core::Scene vmd = load_scene(data("vmd.dat"), options);
    CHECK(vmd.shape_count() == 8);
    CHECK(vmd.camera().from == Vec3f(0, 0, 2));
    CHECK(vmd.camera().at == Vec3f(0.0F));
    CHECK(std::abs(vmd.camera().height - 1.5F) < 1e-6F);
    CHECK(vmd.lights().size() == 3);
    CHECK(remarks ==
          std::vector<std::string>{
              data("vmd.dat") +
                  ":78: colours at the corners of a triangle are not supported: their mean is used",
              data("vmd.dat") + ": EXP2 fog is not supported: the nearest linear fog is used"});
    const core::Scene named = load_scene(data("named.dat"));
    CHECK(named.shape_count() == 5);
    CHECK(named.materials().size() == 2);
}
