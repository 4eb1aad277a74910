#include "bench/rendering.hpp"

#include <string>

/// Measures the cost of each feature to a scene that has it, which other scenes save: a plain
/// scene, and the same with one feature each. The `unseen` ones have it on a ball behind the camera
/// that no ray meets: they cost as much as the code for it.

namespace {

using namespace raylane;
using namespace raylane::core;

/// Balls on a plane before the camera.
struct Plan {
    SceneBuilder builder;
    Material floor, ball;
    Material unseen; ///< of the balls behind the camera
    int unseen_balls = 1;
    bool boxes = false;  ///< in place of every second ball
    bool smooth = false; ///< a square of smooth triangles, in place of the plane
};

constexpr int rows = 3, columns = 4;
constexpr int listed_shapes = 24; ///< scenes of more shapes have a hierarchy

void add_objects(Plan& plan) {
    SceneBuilder& builder = plan.builder;
    const MaterialIndex floor = builder.add_material(plan.floor);
    const MaterialIndex ball = builder.add_material(plan.ball);
    const MaterialIndex unseen = builder.add_material(plan.unseen);
    if (plan.smooth) {
        const Vec3f up(0, 1, 0), a(-60, 0, 60), b(60, 0, 60), c(60, 0, -60), d(-60, 0, -60);
        builder.add(SmoothTriangle{a, b, c, up, up, up}, floor);
        builder.add(SmoothTriangle{a, c, d, up, up, up}, floor);
    } else {
        builder.add(Plane{{0, 0, 0}, {0, 1, 0}}, floor);
    }
    for (int i = 0; i < rows * columns; ++i) {
        const Vec3f center(1.1F * static_cast<float>(i % columns) - 1.65F, 0.5F,
                           -1.1F * static_cast<float>(i / columns));
        const Vec3f corner = center - Vec3f(0.4F);
        if (plan.boxes && i % 2 == 1)
            builder.add(Box{corner, {0.8F, 0, 0}, {0, 0.8F, 0}, {0, 0, 0.8F}}, ball);
        else
            builder.add(Sphere{center, 0.5F}, ball);
    }
    for (int i = 0; i < plan.unseen_balls; ++i)
        builder.add(Sphere{{static_cast<float>(i), 1, 30}, 0.4F}, unseen);
}

template <class Change>
void add_feature(const std::string& name, const Change& change) {
    bench::add_renderings("feature/" + name, [change] {
        Plan plan;
        plan.builder.camera.from = {0, 2.5F, 5};
        plan.builder.camera.at = {0, 0.5F, -1};
        plan.builder.background = Color(0.5F, 0.6F, 0.8F);
        plan.builder.add_light({.position = {4, 6, 5}});
        change(plan);
        add_objects(plan);
        return std::make_shared<const Scene>(std::move(plan.builder).build());
    });
}

void make_glass(Material& material) {
    material.diffuse = 0;
    material.reflection = Reflection::dielectric;
    material.transmission = 1;
}

/// Adds a feature of a material: once on the balls, once unseen.
template <class Change>
void add_material_feature(const std::string& name, const Change& change) {
    add_feature(name, [change](Plan& plan) { change(plan.ball); });
    add_feature(name + "_unseen", [change](Plan& plan) { change(plan.unseen); });
}

const bool registered = [] {
    add_feature("none", [](Plan&) {});
    add_feature("no_shading", [](Plan& plan) { plan.floor.diffuse = plan.ball.diffuse = 0; });
    add_feature("fog", [](Plan& plan) {
        plan.builder.fog.kind = FogKind::exponential;
        plan.builder.fog.density = 0.05F;
    });
    add_feature("second_light", [](Plan& plan) {
        plan.builder.add_light({.position = {-4, 6, 5}});
    });
    add_feature("pattern", [](Plan& plan) {
        plan.floor.pattern.kind = PatternKind::checker;
        plan.floor.pattern.colors[1] = Color(0.2F);
    });
    add_material_feature("highlight", [](Material& material) { material.specular = 0.5F; });
    add_material_feature("mirror", [](Material& material) { material.reflectivity = 0.5F; });
    add_material_feature("glass", make_glass);
    add_material_feature("absorbing_glass", [](Material& material) {
        make_glass(material);
        material.absorption = Vec3f(0.1F, 0.5F, 1);
    });
    add_material_feature("one_sided",
                         [](Material& material) { material.visible = Visible::outside; });
    add_feature("smooth_triangles", [](Plan& plan) { plan.smooth = true; });
    add_feature("boxes", [](Plan& plan) { plan.boxes = true; });
    // With one more ball, the scene has a hierarchy.
    constexpr int unseen = listed_shapes - 1 - rows * columns;
    add_feature("list_of_24", [](Plan& plan) { plan.unseen_balls = unseen; });
    add_feature("hierarchy_of_25", [](Plan& plan) { plan.unseen_balls = unseen + 1; });
    return true;
}();

} // namespace
