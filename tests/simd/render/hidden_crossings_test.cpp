#include "core/shapes/shape.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/support/little_scene.hpp"

#include <cmath>
#include <vector>

using namespace raylane;
using namespace little_scene;

namespace {

struct TestScene : Builder {
    TestScene() {
        settings.width = 60;
        settings.height = 40;
        camera.from = {0.3F, 0.2F, 9};
        camera.field_of_view = 45.0F;
        background = Color(0.25F);
        add_light({.position = {5, 9, 7}});
        add_light({.kind = LightKind::sky, .color = Color(0.3F)});
    }
    static Material clear(const Color& color) {
        Material material;
        material.pattern.colors[0] = color;
        material.opacity = 0.4F;
        return material;
    }
    void add_union(const std::vector<PartShape>& shapes) {
        Solid solid{Made::by_union};
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            solid.parts.push_back(of_shape(shapes[i]));
            solid.parts.back().material = add_material(
                clear({0.1F * static_cast<float>(i % 10), 0.5F, i % 2 == 0 ? 0.9F : 0.2F}));
        }
        add_solid(solid, solid.parts[0].material);
    }
};

/// Returns balls whose centres are on a lattice with this step.
std::vector<PartShape> lattice(double step, double radius) {
    std::vector<PartShape> balls;
    for (int x = -2; x <= 2; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -2; z <= 2; ++z)
                balls.push_back(SphereOf<double>{{step * x, step * y, step * z}, radius});
    return balls;
}

} // namespace

TEST_CASE("rays that skip hidden crossings of a union see the same surfaces") {
    TestScene scattered;
    std::vector<PartShape> balls;
    for (int i = 0; i < 80; ++i)
        balls.push_back(SphereOf<double>{
            {1.8 * std::sin(2.3 * i), 1.2 * std::sin(3.7 * i + 1), 1.5 * std::sin(5.1 * i + 2)},
            0.4 + 0.006 * (i * 37 % 80)});
    scattered.add_union(balls);
    tests::check_engines_agree(scattered.finish());
}

TEST_CASE("rays that skip hidden crossings stop at shapes inside of the union") {
    TestScene scene;
    scene.add_union(lattice(0.6, 0.55));
    scene.add_shape(SphereOf<double>{{0.2, 0.1, 0.3}, 0.4}, Material{});
    scene.add_shape(SphereOf<double>{{-0.8, 0, 0}, 0.5}, TestScene::clear({1, 0, 0}));
    scene.add_shape(DiscOf<double>{{0.9, 0, 0}, {0.1, 0, 1}, 0.4}, Material{});
    scene.add_shape(TriangleOf<double>{{-1, -1, 0.31}, {1, -1, 0.31}, {0, 1, 0.31}},
                    TestScene::clear({0, 1, 0}));
    tests::check_engines_agree(scene.finish());
}

TEST_CASE("rays do not skip crossings of parts that touch or coincide") {
    for (const double radius : {0.5, 0.5000000001, 0.7071067811865476}) {
        TestScene scene;
        scene.add_union(lattice(1.0, radius)); // neighbours along an axis, or a diagonal, touch
        scene.camera.from = {0, 0, 9};
        tests::check_engines_agree(scene.finish());
    }
    TestScene mixed; // capped cylinders and balls of the same radius
    std::vector<PartShape> sticks = lattice(0.9, 0.3);
    for (int y = -1; y <= 1; ++y)
        for (int z = -2; z <= 2; ++z)
            sticks.push_back(
                CylinderOf<double, Ends::capped>{{-1.8, 0.9 * y, 0.9 * z}, {3.6, 0, 0}, 0.3});
    mixed.add_union(sticks);
    tests::check_engines_agree(mixed.finish());
}

TEST_CASE("rays that leave two surfaces nearer than rounding do not meet them in turns") {
    TestScene scene;
    scene.settings.width = 8;
    scene.settings.height = 6;
    scene.settings.min_weight = 0.0F; // endless otherwise
    scene.camera.from = {-9, 0, 0};
    scene.camera.field_of_view = 1e-5F;
    std::vector<PartShape> balls;
    for (int i = 0; i < 20; ++i)
        balls.push_back(SphereOf<double>{{0.25 * (i / 2), 0, i % 2 == 0 ? -1e-11 : 0}, 0.5});
    balls.push_back(SphereOf<double>{{3.25, 0, 0}, 0.5});
    scene.add_union(balls);
    const Scene built = scene.finish();
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
        const simd::Rendering rendering =
            simd::render(built, built.settings(), {.engine = engine, .threads = 1});
        // Four surfaces a ray. A surface may be met twice: rounding moves points to its other side.
        CHECK(rendering.counters.passed <= 6 * rendering.counters.primary);
    }
}
