#include "core/scene/auto_camera.hpp"
#include "scenes/export/export.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/export/exports.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;
using tests::image_of;

namespace {

/// Returns all numbers of a view that its projection uses. A sky light has no position.
std::vector<float> view_of(const core::Scene& scene) {
    std::vector<float> floats;
    const auto add = [&](const core::Vec3f& v) { floats.insert(floats.end(), {v.x, v.y, v.z}); };
    const core::Camera& camera = scene.camera();
    const bool perspective = camera.projection == core::Projection::perspective;
    for (const core::Vec3f& v : {camera.from, camera.at, camera.up})
        add(v);
    floats.insert(floats.end(),
                  {static_cast<float>(camera.projection),
                   perspective ? camera.field_of_view : camera.height, camera.lens_radius});
    const core::Fog& fog = scene.fog();
    add(fog.color);
    floats.insert(floats.end(), {static_cast<float>(fog.kind), fog.start, fog.end, fog.density});
    for (const core::Light& light : scene.lights()) {
        if (light.kind != core::LightKind::sky) add(light.position);
        for (const core::Vec3f& v :
             {light.direction, light.color, light.edge_u, light.edge_v, light.ground})
            add(v);
        floats.insert(floats.end(), {static_cast<float>(light.kind), light.radius, light.reach});
    }
    return floats;
}

/// Returns the scene as the tool's --view shows it.
core::Scene seen_from(core::Scene scene, const core::Vec3f& direction) {
    core::AutoCamera auto_camera = scene.auto_camera();
    if (!auto_camera.fit_camera) auto_camera.fit_camera = core::fit_camera_of(scene.camera());
    auto_camera.fit_camera->direction = direction;
    auto_camera.fit_camera->up = core::upright(direction);
    const core::View view = core::staged(scene, auto_camera, scene.settings());
    return std::move(scene).seen(auto_camera, view);
}

/// Returns the scene as seen by a camera with a fixed position.
core::Scene seen_by(core::Scene scene, const core::Camera& camera) {
    core::AutoCamera auto_camera = scene.auto_camera();
    auto_camera.fit_camera.reset();
    const core::Fog fog = scene.fog();
    scene = std::move(scene).seen(auto_camera, {camera, fog, {}});
    const core::View view = core::staged(scene, auto_camera, scene.settings());
    return std::move(scene).seen(auto_camera, view);
}

const core::Vec3f directions[] = {{0, 0, -1}, {-0.0F, -1, 0}, {-3, 1, 2}, {0.1F, 0.2F, 0.3F}};
const core::Camera aside{.from = {6, 3, 8}, .at = {1, 0, 0}, .field_of_view = 50};

std::string staged_json(const std::string& camera, const std::string& rest) {
    return R"({"camera": )" + camera + R"(, "background": [0.5, 0.75, 1], )" + rest +
           R"("image": {"width": 40, "height": 30}, "materials": {"m": {"specular": 0.3}},
           "objects": [{"type": "sphere", "center": [0, 0.1, 0], "radius": 1, "material": "m"},
                {"type": "cylinder", "base": [2, 0, -1], "axis": [1, 2, 0.3], "radius": 0.4,
                 "material": "m"},
                {"type": "difference", "material": "m", "objects": [
                    {"type": "box", "min": [-3, -1, -1], "max": [-1.5, 1, 1]},
                    {"type": "sphere", "center": [-2, 0, 1], "radius": 0.5}]}]})";
}

core::Scene water() {
    return parse_scene("atoms.xyz", "3\n\nC 0 0 0\nO 2 1 -3\nN 0 3 1\n", {});
}

} // namespace

TEST_CASE("JSON keeps to the bit the camera's framing and the lights and fog that follow it") {
    const std::string camera_lights = R"("lights": [{"type": "camera"}], )";
    const std::string both = R"("lights": [{"type": "point", "position": [9, 9, 9]},
                                           {"type": "camera"}], )";
    const std::string own = R"("lights": [{"type": "point", "position": [9, 9, 9]}], )";
    const std::string fixed = R"({"from": [4, 5, 6], "at": [0, 0.1, 0], "field_of_view": 40})";
    std::vector<core::Scene> scenes;
    scenes.push_back(water());
    for (const auto& [camera, rest] : {
             std::pair<std::string, std::string>(R"("auto")", ""),
             {R"({"type": "auto", "view": "corner", "zoom": 1.5, "field_of_view": 40,
                  "depth_cue": 0.3})",
              both},
             {R"({"type": "auto", "view": [0.3, -2, 1], "up": [1, 0, 0.5], "orthographic": true})",
              own + R"("fog": {"type": "exponential", "density": 0.02}, )"},
             {R"({"type": "auto", "view": "top", "orthographic": true, "depth_cue": 0.99})",
              camera_lights},
             {R"("auto")", R"("lights": [], )"},
             {fixed, both + R"("fog": {"type": "linear", "start": 1, "end": 99}, )"},
             {R"({"type": "orthographic", "from": [4, 5, 6], "at": [0, 0, 0], "height": 7})",
              camera_lights},
         })
        scenes.push_back(tests::scene_of(staged_json(camera, rest)));

    const tests::TemporaryDirectory directory;
    const auto written = [&](const core::Scene& scene) {
        CHECK(export_scene(directory.path() / "a.json", scene).empty());
        return load_scene(directory.path() / "a.json");
    };
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        CAPTURE(i);
        const core::Scene again = written(scenes[i]);
        CHECK(view_of(again) == view_of(scenes[i]));
        CHECK(again.own_light_count() == scenes[i].own_light_count());
        CHECK(again.auto_camera().fit_camera.has_value() ==
              scenes[i].auto_camera().fit_camera.has_value());
        CHECK(again.auto_camera().lights == scenes[i].auto_camera().lights);
        CHECK(again.auto_camera().depth_cue == scenes[i].auto_camera().depth_cue);
        CHECK(image_of(again) == image_of(scenes[i]));
        CHECK(view_of(seen_by(again, aside)) == view_of(seen_by(scenes[i], aside)));
        for (const core::Vec3f& direction : directions) {
            // A change of the view and an export give the same in either order.
            const core::Scene seen = seen_from(scenes[i], direction);
            CHECK(view_of(seen_from(again, direction)) == view_of(seen));
            CHECK(view_of(written(seen)) == view_of(seen));
        }
        CHECK(image_of(seen_from(again, directions[2])) ==
              image_of(seen_from(scenes[i], directions[2])));
    }
}

TEST_CASE("JSON export reports lost camera features and keeps the image") {
    const tests::TemporaryDirectory directory;
    const core::Scene scene = water();
    const auto check = [&](const core::Scene& seen, const std::vector<std::string>& expected) {
        const std::vector<std::string> told = export_scene(directory.path() / "a.json", seen);
        CHECK(told == expected);
        core::Scene again = load_scene(directory.path() / "a.json");
        CHECK(view_of(again) == view_of(seen));
        CHECK(image_of(again) == image_of(seen));
        return again;
    };
    const std::string place = "automatic camera", fog = "automatic fog",
                      lights = "automatic lights";
    const core::Scene again = check(seen_by(scene, aside), {fog});
    CHECK(again.auto_camera().lights);
    const core::Camera another{.from = {-6, 3, 8}, .at = {1, 0, 0}};
    const auto lights_of = [](const core::Scene& lit) {
        return std::pair(lit.lights()[1].position.x, lit.lights()[1].radius);
    };
    CHECK(lights_of(seen_by(again, another)) == lights_of(seen_by(scene, another)));

    const core::View own{scene.camera(), scene.fog(), scene.lights()};
    const core::View turned = core::turned(own, {0, 1, 0}, 30.0);
    check(core::Scene(scene).seen(scene.auto_camera(), turned), {place, fog, lights});

    core::AutoCamera near = scene.auto_camera();
    near.lights = false;
    near.depth_cue = 0.0F;
    near.fit_camera->zoom = 2000.0F;
    check(core::Scene(scene).seen(near, core::staged(scene, near, scene.settings())), {place});
}
