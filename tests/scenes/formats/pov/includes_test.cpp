#include "scenes/formats/pov/includes.hpp"
#include "tests/scenes/formats/pov/read.hpp"
#include "tests/support/catch.hpp"

#include <string>

using namespace raylane;
using tests::complaint, tests::number, tests::Read, tests::read;

namespace {

std::string include(const std::string& name) {
    return "#include \"" + name + "\"\n";
}

constexpr const char* files[] = {
    "chars.inc",  "colors.inc",    "consts.inc",  "finish.inc",     "functions.inc", "glass.inc",
    "golds.inc",  "ior.inc",       "math.inc",    "metals.inc",     "rad_def.inc",   "rand.inc",
    "shapes.inc", "shapes2.inc",   "shapesq.inc", "shapes_old.inc", "skies.inc",     "stars.inc",
    "stdinc.inc", "stones.inc",    "stones1.inc", "stones2.inc",    "strings.inc",   "textures.inc",
    "woods.inc",  "transforms.inc"};

} // namespace

TEST_CASE("POV-Ray: an include is accepted until a name is used that raylane does not read") {
    for (const char* file : files) {
        CAPTURE(file);
        const Read result = read(include(file) + "sphere { 0, 1 }");
        CHECK(result.scene.shape_count() == 1);
        CHECK(result.remarks.empty());
    }
    CHECK(complaint(include("chars.inc") + "sphere { 0, 1 }\nobject { char_A }") ==
          "a.pov:3:10: must be a supported object, got \"char_A\", which is declared in "
          "\"chars.inc\" and not supported");
    CHECK(complaint(include("functions.inc") + "sphere { 0, f_torus(1, 2, 3, 4, 5) }") ==
          "a.pov:2:13: must be a number, got the unknown name \"f_torus\", which is declared in "
          "\"functions.inc\" and not supported");
    CHECK(complaint(include("math.inc") + "sphere { 0, Nothing }") ==
          "a.pov:2:13: must be a number, got the unknown name \"Nothing\"");
    CHECK(complaint("sphere { 0, 1 texture { T_Silver_3A } }") ==
          "a.pov:1:25: must be of a texture, got \"T_Silver_3A\"");
    CHECK(complaint(include("other.inc"))
              .starts_with("a.pov:1:10: must be a file in the folder of this file"));
    CHECK(number("A", include("chars.inc") + "#ifdef (char_A) #declare A = 2; #end") == "2");
}

TEST_CASE("POV-Ray: each declaration of an include can be read") {
    std::size_t values = 0, macros = 0;
    for (const char* file : files)
        for (const auto& [name, text] : scenes::pov::standard_file(file)->declarations) {
            if (text.empty()) continue;
            CAPTURE(file, name, text);
            const bool is_macro = text.starts_with("#macro");
            ++(is_macro ? macros : values);
            if (is_macro)
                CHECK(number("A", include(file) + "#ifdef (" + std::string(name) +
                                      ") #declare A = 1; #end") == "1");
            else
                CHECK_NOTHROW(read(include(file) + "#declare A = " + std::string(name) + ";"));
        }
    CHECK(values > 800);
    CHECK(macros > 50);
}

TEST_CASE("POV-Ray: textures of includes are those of POV-Ray's files") {
    const auto material = [](const std::string& file, const std::string& texture) {
        return read(include(file) + "sphere { 0, 1 texture { " + texture + " } }").material_of();
    };
    const core::Material silver = material("metals.inc", "T_Silver_3A");
    CHECK(silver.pattern.colors[0] == core::Vec3f(0.94F, 0.93F, 0.9F));
    CHECK(silver.reflectivity == 0.1F);
    CHECK(silver.ambient == 0.35F);
    CHECK(material("metals.inc", "T_Chrome_1A").pattern.colors[0] == core::Vec3f(0.2F));
    CHECK(material("metals.inc", "T_Brass_2C").reflectivity == 0.5F);
    CHECK(material("metals.inc", "pigment { P_Copper3 } finish { F_MetalE }").reflectivity == 0.8F);
    // metals.inc replaces the finishes of golds.inc, but not in textures that already use them.
    const float gold = material("golds.inc", "T_Gold_1A").reflectivity;
    CHECK(gold > 0.4F);
    CHECK(material("metals.inc", "T_Gold_1A").reflectivity == gold);
    CHECK(material("golds.inc", "pigment { P_Gold1 } finish { F_MetalA }").reflectivity == gold);
}

TEST_CASE("POV-Ray: a pattern of an include gives its mean colour and a remark where it is used") {
    const Read result = read(include("woods.inc") + "sphere { 0, 1 texture { T_Wood1 } }");
    CHECK(result.remarks ==
          "a.pov:3:25: pattern \"wood\" is not supported: its mean colour is used\n");
    const core::Vec3f color = result.material_of().pattern.colors[0];
    CHECK((color.x > color.y && color.y > color.z && color.z > 0.0F));
    CHECK(read("sphere { 0, 1 pigment { bozo color_map { [0.5 rgb 0] [0.5 rgb 1] [1 rgb 0] } } }")
              .material_of()
              .pattern.colors[0] == core::Vec3f(0.25F));
}

TEST_CASE("POV-Ray: the last declaration of a name counts in a scene and in an include") {
    CHECK(number("Cube.x", include("shapes.inc") + "#declare Cube = <3, 4, 5>;") == "3");
    CHECK(number("Red.x", "#declare Red = <3, 4, 5>;\n" + include("colors.inc")) == "1");
    CHECK(number("Red.x", include("colors.inc") + "#declare Red = <3, 4, 5>;\n" +
                              include("colors.inc")) == "3");
}

TEST_CASE("POV-Ray: shapes and macros of includes are those of POV-Ray's files") {
    const auto count = [](const std::string& file, const std::string& text) {
        return read(include(file) + text).scene.shape_count();
    };
    CHECK(count("shapes.inc", "object { Cube } object { UnitBox } object { Disk_Y } Sphere") == 4);
    CHECK(count("shapes.inc", "object { Cylinder_X } object { Paraboloid_Y scale 2 }") == 2);
    CHECK(count("shapes.inc", "intersection { object { QCone_Y } plane { y, 1 } "
                              "plane { -y, 0 } }") == 3);
    CHECK(count("shapes.inc", "object { Round_Box(<0, 0, 0>, <3, 4, 5>, 0.5, 0) }") == 23);
    CHECK(count("shapes.inc", "Wire_Box(<0, 0, 0>, <3, 4, 5>, 0.5, 0)") == 20);
    CHECK(count("shapes2.inc", "object { Dodecahedron } object { Hexagon }") == 20);
    CHECK(number("sind(30)", include("math.inc")) == "0.5");
    CHECK(number("VMax(<1, 7, 3>) + VDist(x, -x)", include("math.inc")) == "9");
    CHECK(number("Interpolate(0.5, 0, 1, 10, 20, 2)", include("math.inc")) == "12.5");
    CHECK(number("RRand(5, 5, S)", include("rand.inc") + "#declare S = seed(1);") == "5");
    // Turns x onto y: the sphere on x moves to y.
    const Read turned = read(include("transforms.inc") + "sphere { 2*x, 1 Reorient_Trans(x, y) }");
    scenes::for_each_by_id(turned.scene, [](const auto& shape, core::ShapeId) {
        CHECK(core::numbers_of(shape)[0] == Approx(0.0).margin(1e-12));
        CHECK(core::numbers_of(shape)[1] == Approx(2.0));
    });
}
