#include "tests/simd/render/image.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/sanitized.hpp"

#include <cmath>
#include <random>

/// Surfaces with opacities below 1: both engines and all instruction sets render the same image.
using namespace raylane;
using raylane::tests::image;
using namespace little_scene;

namespace {

/// Returns balls of all opacities in front of a floor, some of which reflect or transmit, in fog.
Scene cloud(Projection projection, bool in_fog, int most) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> place(-2, 2), fraction(0, 1);
    Builder builder;
    builder.settings.width = builder.settings.height = tests::sanitized ? 20 : 48;
    builder.settings.grid = 2;
    builder.settings.max_depth = 3;
    builder.settings.min_weight = 0.001F;
    builder.settings.max_transparent = most;
    builder.settings.transparent_shadows = most == Settings::transparent_limit;
    builder.background = {0.2F, 0.4F, 0.8F};
    builder.camera = {.projection = projection, .from = {1, 2, 7}, .at = {0, 0, 0}, .height = 5};
    if (in_fog)
        builder.fog = {.kind = FogKind::linear, .color = {0.7F, 0.7F, 0.6F}, .start = 4, .end = 9};
    builder.add_light({.kind = LightKind::sky, .color = {0.3F, 0.3F, 0.3F}});
    builder.settings.light_samples = 2;
    for (int i = 0; i < 120; ++i) {
        Material material;
        material.pattern.colors[0] = {fraction(random), fraction(random), fraction(random)};
        material.specular = 0.2F;
        material.opacity = i % 3 == 0 ? 1.0F : i % 10 == 7 ? 0.0F : fraction(random);
        if (i % 8 == 1) material.reflectivity = 0.5F;
        if (i % 12 == 5) material.transmission = 0.5F;
        builder.add_shape(
            Sphere{{place(random), place(random), place(random)}, 0.1F + 0.4F * fraction(random)},
            material);
    }
    Solid both{Made::by_union};
    both.parts.resize(2);
    both.parts[0].shape = SphereOf<double>{{-1, 0, 2}, 0.6};
    both.parts[1].shape = SphereOf<double>{{-0.5, 0, 2.25}, 0.5};
    Material glaze;
    glaze.opacity = 0.375F;
    builder.add_solid(both, builder.add_material(glaze));
    builder.add_shape(Plane{{0, -2.5F, 0}, {0, 1, 0}}, Material{});
    return builder.finish({.position = {4, 6, 5}});
}

} // namespace

TEST_CASE("both engines and all instruction sets render the same transparent surfaces",
          "[native]") {
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
        for (const bool in_fog : {false, true})
            for (const int most : {2, Settings::transparent_limit})
                tests::check_engines_agree(cloud(projection, in_fog, most));
}

TEST_CASE("transparent surfaces and glass without shadows dim no light") {
    enum class Above { nothing, panes, opaque };
    const auto floor = [](Above above, bool shadows) {
        Builder builder;
        builder.settings.width = builder.settings.height = 24;
        builder.settings.grid = 2;
        builder.settings.transparent_shadows = shadows;
        builder.camera = {.from = {0, 0.5F, 6}, .at = {0, -1, 0}};
        builder.add_light({.kind = LightKind::sky, .color = {0.3F, 0.3F, 0.3F}});
        builder.add_shape(Plane{{0, -1, 0}, {0, 1, 0}}, Material{});
        Material pane = glass(1.5F, Reflection::dielectric), sheet;
        pane.absorption = {1, 2, 3};
        sheet.opacity = above == Above::opaque ? 1.0F : 0.5F;
        for (int i = 0; i < 12 && above != Above::nothing; ++i) // out of view
            builder.add_shape(
                Box{{-9, 4.0F + static_cast<float>(i), -9}, {18, 0, 0}, {0, 0.5F, 0}, {0, 0, 18}},
                above == Above::panes && i % 2 == 0 ? pane : sheet);
        return builder.finish({.position = {1, 30, 2}});
    };
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
        const std::vector<Color> bare = image(floor(Above::nothing, true), engine);
        CHECK(image(floor(Above::panes, false), engine) == bare);
        CHECK(image(floor(Above::panes, true), engine) != bare);
        CHECK(image(floor(Above::opaque, false), engine) ==
              image(floor(Above::opaque, true), engine));
    }
}

TEST_CASE("shadow rays skip a transparent union that casts no shadow") {
    const auto envelope = [](bool shadows) {
        Builder builder;
        builder.settings.width = builder.settings.height = 24;
        builder.settings.max_transparent = 1;
        builder.settings.transparent_shadows = shadows;
        builder.camera = {.from = {0, 1, 8}, .at = {0, 0, 0}};
        builder.add_light({.kind = LightKind::sky, .color = {0.3F, 0.3F, 0.3F}});
        Solid solid{Made::by_union};
        solid.parts.resize(40);
        for (std::size_t i = 0; i < solid.parts.size(); ++i)
            solid.parts[i].shape =
                SphereOf<double>{{0.1 * static_cast<double>(i) - 2.0, 0, 0}, 0.75};
        Material pale;
        pale.opacity = 0.25F;
        builder.add_solid(solid, builder.add_material(pale));
        for (int i = -2; i <= 2; ++i)
            builder.add_shape(Sphere{{static_cast<float>(i), 0, 0}, 0.375F}, Material{});
        builder.add_shape(Plane{{0, -2, 0}, {0, 1, 0}}, Material{});
        return builder.finish({.position = {4, 6, 5}});
    };
    tests::check_engines_agree(envelope(false));
    const auto walked = [&](bool shadows) {
        const Scene scene = envelope(shadows);
        return simd::render(scene, scene.settings(), {.engine = simd::Engine::vector})
            .counters.walked;
    };
    CHECK(walked(true) > 100);
    CHECK(20 * walked(false) < walked(true));
}

TEST_CASE("transparent panes that reflect and transmit do not outgrow a queue") {
    Builder builder;
    builder.settings.width = builder.settings.height = 32;
    builder.settings.max_depth = 3;
    builder.background = {0.2F, 0.4F, 0.8F};
    Material pane = glass(1.5F, Reflection::dielectric);
    pane.opacity = 0.5F;
    for (int i = 0; i < 2; ++i) {
        const float z = -static_cast<float>(i);
        builder.add_shape(Box{{-9, -9, z}, {18, 0, 0}, {0, 18, 0}, {0, 0, 0.25F}}, pane);
    }
    const Scene scene = builder.finish();
    const std::vector<Color> vector = image(scene, simd::Engine::vector);
    const std::vector<Color> reference = image(scene, simd::Engine::reference);
    for (std::size_t i = 0; i < vector.size(); ++i)
        CHECK(vector[i].x == Approx(reference[i].x).epsilon(1e-4));
}

TEST_CASE("an image of a quality shows the scene behind transparent surfaces") {
    Builder builder;
    builder.settings.width = builder.settings.height = 64;
    builder.settings.quality = 40;
    builder.camera = {
        .projection = Projection::orthographic, .from = {0, 0, 9}, .at = {0, 0, 0}, .height = 4};
    Material front = luminous(Color(0.0F));
    front.opacity = 0.25F;
    builder.add_shape(Disc{{0, 0, 2}, {0, 0, 1}, 9}, front);
    builder.add_shape(Sphere{{0.1F, 0.2F, 0}, 1.25F}, luminous());
    const Scene scene = builder.finish();
    double sum = 0.0;
    for (const Color& color : image(scene, simd::Engine::vector))
        sum += static_cast<double>(color.x) / (64 * 64);
    CHECK(sum == Approx(0.75 * 3.14159265 * 1.25 * 1.25 / 16).epsilon(0.002));
}
