#include "scenes/tool/view/pick.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/json_scenes.hpp"

using namespace raylane;

TEST_CASE("A click names the material of the object") {
    const core::Scene scene = tests::scene_of(R"({"image": {"width": 3, "height": 1},
        "camera": {"type": "orthographic", "from": [0, 0, 5], "at": [0, 0, 0], "height": 2},
        "lights": [], "materials": {"clear glass": {"transmission": 1}},
        "objects": [{"type": "sphere", "material": "clear glass", "center": [-2, 0, 0], "radius": 1},
                    {"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})");
    const auto click = [&](int x) { return scenes::what_is_at(scene, scene.settings(), x, 0); };
    CHECK(click(0) ==
          "sphere 0 of material 0 (clear glass), at -2 0 1, 4 away (rounded to nearest double)");
    CHECK(click(1).starts_with("sphere 1 of material 1, at 0 0 1, 4 away"));
    CHECK(click(2) == "background");
}
