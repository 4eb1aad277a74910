#include "core/scene/scene.hpp"
#include "scenes/errors.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/number.hpp"
#include "scenes/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/message_of.hpp"

#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;

namespace {

/// Seen as raylane sees it: the coordinates of what is read are those that are written.
const std::string camera = "camera { location <0, 0, 9> look_at 0 right -x up y }\n";

struct Read {
    core::Scene scene;
    std::string remarks;

    const core::Material& material_of(core::ShapeId id = 0) const { return scene.material_of(id); }
    bool remarks_on(const std::string& what) const {
        return remarks.find(what) != std::string::npos;
    }
};

Read read(const std::string& text, const std::string& before = camera) {
    std::string remarks;
    LoadOptions options;
    options.on_remark = [&](const std::string& remark) { remarks += remark + "\n"; };
    core::Scene scene = parse_scene("a.pov", before + text, options);
    return {std::move(scene), std::move(remarks)};
}

std::string complaint(const std::string& text) {
    return tests::message_of<BadInput>([&] { parse_scene("a.pov", text); });
}

/// What a number is after some statements.
std::string number(const std::string& expression, const std::string& before = "") {
    const Read of = read(before + " sphere { <" + expression + ", 0, 0>, 1 }");
    std::string text;
    for_each_by_id(of.scene, [&](const auto& shape, core::ShapeId) {
        text = to_text(static_cast<float>(core::numbers_of(shape)[0]));
    });
    return text;
}

} // namespace

TEST_CASE("POV-Ray: what is read may declare anew what it is read for") {
    const std::string long_text = "\"" + std::string(100, 'a') + "\"";
    CHECK(read("#macro M(A, B, C, D) sphere { A, B } #end\n"
               "#macro N() #declare M = 5; #declare X = " +
               long_text + "; <0, 0, 0> #end\nM(N(), 1, 2, 3)")
              .scene.shape_count() == 1);
    CHECK(number("dimension_size(A, N())", "#declare A = array[3];\n"
                                           "#macro N() #declare A = array[1]; 1 #end") == "3");
}

TEST_CASE("POV-Ray: clips are counted, and how deep they are in each other") {
    const auto many = [](const std::string& times, const std::string& next) {
        return complaint("#declare S = sphere { 0, 1 }\n#declare I = 0;\n#while (I < " + times +
                         ") #declare S = " + next + " #declare I = I + 1; #end\nS");
    };
    const std::string deep = "must not be nested more than 128 deep";
    CHECK(many("200000", "object { S rotate x*90 clipped_by { plane { y, 0 } } }").find(deep) !=
          std::string::npos);
    CHECK(many("200000", "sphere { 0, 1 clipped_by { S } }").find(deep) != std::string::npos);
    CHECK(many("26", "sphere { 0, 1 clipped_by { S } clipped_by { S } }")
              .find("must not be of more than 16777216 shapes") != std::string::npos);
    CHECK(complaint("#declare P = union { sphere { 0, 1 } sphere { x, 1 } }\n"
                    "#for (I, 1, 14) #declare P = union { object { P } object { P } } #end\n"
                    "object { P clipped_by { P } }")
              .find("must not be of more than 16777216 shapes") != std::string::npos);
}
