#include "core/reference/tracer.hpp"
#include "simd/isa/isa.hpp"
#include "simd/wavefront/render.hpp"
#include "simd/wavefront/wavefront.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sanitized.hpp"

#include <atomic>
#include <cmath>
#include <optional>

/// Tests the queues of the wavefront loop at their limits.
using namespace raylane;
using namespace little_scene;

namespace {

simd::RenderOptions by(simd::Engine engine) {
    return {.engine = engine, .threads = 1};
}

/// Returns the number of channels of pixels that differ by more than rounding.
int differing(const Scene& scene) {
    const Film expected = simd::render(scene, scene.settings(), by(simd::Engine::reference)).film;
    const Film film = simd::render(scene, scene.settings(), by(simd::Engine::vector)).film;
    int count = 0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float a = film.pixels()[i][channel], b = expected.pixels()[i][channel];
            if (!(std::abs(a - b) <= 1e-5F * (1.0F + std::abs(b)))) ++count;
        }
    return count;
}

/// Returns panes of glass one behind the other, before a mirror. Every pane doubles the paths.
Scene panes(int depth) {
    Builder builder;
    builder.settings.width = builder.settings.height = 40;
    builder.settings.max_depth = depth;
    builder.settings.min_weight = 0.0F;
    builder.background = {0.2F, 0.4F, 0.8F};
    Material pane = glass(1.5F, Reflection::dielectric);
    for (int i = 0; i < 6; ++i) {
        const float z = -static_cast<float>(i);
        builder.add_shape(Box{{-9, -9, z}, {18, 0, 0}, {0, 18, 0}, {0, 0, 0.25F}}, pane);
    }
    Material back = mirror(0.75F);
    back.ambient = 0.25F;
    builder.add_shape(Plane{{0, 0, -7}, {0, 0.1F, 1}}, back);
    return builder.finish();
}

} // namespace

TEST_CASE("waves that outgrow their queues are divided", "[long]") {
    // Up to 2^9 paths per sample, a thousand samples in a chunk.
    const Scene scene = panes(9);
    CHECK(differing(scene) == 0);
    const auto counters = simd::render(scene, scene.settings(), by(simd::Engine::vector)).counters;
    CHECK(counters.deferred > 0);
    CHECK(counters.followed == 0);
}

TEST_CASE("a sample that outgrows a queue by itself is followed to its end", "[long]") {
    const Scene scene = panes(tests::fixed_rounds(13, 13, 15));
    Settings settings = scene.settings();
    settings.width = settings.height = 3;
    const Film expected = simd::render(scene, settings, by(simd::Engine::reference)).film;
    const simd::Rendering rendering = simd::render(scene, settings, by(simd::Engine::vector));
    for (std::size_t i = 0; i < expected.pixels().size(); ++i)
        CHECK(rendering.film.pixels()[i].z == Approx(expected.pixels()[i].z).epsilon(1e-5));
    CHECK(rendering.counters.followed > 0);
}

TEST_CASE("more samples than a chunk holds make one pixel") {
    Builder builder;
    builder.settings.width = 3;
    builder.settings.height = 2;
    builder.settings.grid = 64;
    builder.settings.samples = SamplePattern::stratified;
    builder.add_shape(Sphere{{0, 0, 0}, 1}, ruler({1, 1, 0}));
    CHECK(differing(builder.finish()) == 0);
}

TEST_CASE("more materials than a byte counts are sorted") {
    Builder builder;
    builder.settings.width = builder.settings.height = 64;
    builder.camera.from = {0, 0, 30};
    for (int i = 0; i < 700; ++i) {
        const float x = static_cast<float>(i % 28) - 13.5F, y = static_cast<float>(i / 28) - 12.0F;
        builder.add_shape(
            Sphere{{x, y, 0}, 0.5F},
            luminous(Color(static_cast<float>(i % 7) / 7.0F, static_cast<float>(i % 11) / 11.0F,
                           static_cast<float>(i) / 700.0F)));
    }
    CHECK(differing(builder.finish()) == 0);
}

TEST_CASE("an orthographic camera and parallel light trace coherent rays too") {
    Builder builder;
    builder.settings.width = builder.settings.height = 64;
    builder.camera.projection = Projection::orthographic;
    builder.camera.from = {3, 4, 5};
    builder.camera.height = 4.0F;
    builder.add_light({.kind = LightKind::directional, .direction = {-1, -2, -0.5F}});
    Material matte = luminous(Color(0.5F));
    matte.ambient = 0.1F;
    matte.diffuse = 0.9F;
    for (int i = 0; i < 60; ++i) {
        const float a = 0.37F * static_cast<float>(i);
        builder.add_shape(
            Sphere{{std::sin(a), 0.05F * static_cast<float>(i) - 1.0F, std::cos(a)}, 0.15F}, matte);
    }
    builder.add_shape(Plane{{0, -1.5F, 0}, {0, 1, 0}}, matte);
    CHECK(differing(builder.finish()) == 0);
}

TEST_CASE("a camera inside of everything sees it") {
    Builder builder;
    builder.settings.width = builder.settings.height = 48;
    builder.camera.from = {0.1F, 0.2F, 0.3F};
    builder.camera.at = {1, 0, 0};
    builder.camera.field_of_view = 150.0F;
    builder.add_shape(Sphere{{0, 0, 0}, 10}, ruler({10, 10, 10}));
    builder.add_shape(Box{{-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, glass(1.3F));
    builder.add_shape(CappedCylinder{{0, 0, -1}, {0, 0, 2}, 1.5F}, glass(1.2F));
    CHECK(differing(builder.finish()) == 0);
}

TEST_CASE("rays along the axes and almost along them lose no hit") {
    Builder builder;
    builder.settings.width = builder.settings.height = 33; // its middle ray is exactly along z
    builder.settings.grid = 1;
    builder.camera.projection = Projection::orthographic;
    builder.camera.from = {0, 0, 9};
    builder.camera.height = 4.0F;
    for (const float tilt : {0.0F, -1e-31F, 1e-31F, -0x1p-100F, -0x1p-140F}) {
        const Light sun{
            .kind = LightKind::directional, .direction = {tilt, tilt, -1}, .color = Color(0.2F)};
        builder.add_light(sun);
    }
    Material matte = mirror(0.5F);
    matte.diffuse = 0.5F;
    for (int i = 0; i < 49; ++i)
        builder.add_shape(
            Sphere{{0.5F * static_cast<float>(i % 7) - 1.5F,
                    0.5F * static_cast<float>(i / 7) - 1.5F, 0.3F * static_cast<float>(i % 3)},
                   0.25F},
            matte);
    builder.add_shape(Plane{{0, 0, -1}, {0, 0, 1}}, matte);
    CHECK(differing(builder.finish()) == 0);
}

TEST_CASE("scenes may be very large or very small") {
    for (const float scale : {0x1p-60F, 0x1p30F, 0x1p60F, 0x1p66F}) {
        Builder builder;
        builder.settings.width = builder.settings.height = 32;
        builder.camera.from = {scale, 2 * scale, 5 * scale};
        builder.add_light({.position = {3 * scale, 9 * scale, 9 * scale}});
        Material matte = mirror(0.25F);
        matte.diffuse = 0.5F;
        const auto s = [&](float x, float y, float z) { return scale * Vec3f(x, y, z); };
        builder.add_shape(Sphere{s(-1, 0, 0), 0.75F * scale}, matte);
        builder.add_shape(CappedCylinder{s(1, -1, 0), s(0, 1, 0), 0.5F * scale}, matte);
        builder.add_shape(CappedCone{s(0, 0, -2), s(0, 1, 0), 0.5F * scale, 0.0F}, matte);
        builder.add_shape(Box{s(0, -1, 1), s(0.5F, 0, 0), s(0, 0.5F, 0), s(0, 0, 0.5F)}, matte);
        builder.add_shape(Disc{s(0, -1, 0), s(0, 1, 0), 9 * scale}, matte);
        CAPTURE(scale);
        CHECK(differing(builder.finish()) == 0);
    }
}

TEST_CASE("the vector engine renders by default", "[native]") {
    const Scene scene = panes(9);
    Settings settings = scene.settings();
    if (tests::sanitized) settings.width = settings.height = 16;
    const auto deferred = [&](const simd::RenderOptions& options) {
        return simd::render(scene, settings, options).counters.deferred;
    };
    CHECK(deferred({}) > 0);
    CHECK(deferred(by(simd::Engine::reference)) == 0);
}

/// Abandons a region before its first pixel, and then renders it. `make` returns a tracer.
template <class Make>
void check_abandoned(float quality, simd::Engine engine, const Make& make) {
    const Scene scene = panes(3);
    Settings settings = scene.settings();
    settings.quality = quality;
    std::atomic<bool> abandon = false;
    core::Survey survey(scene, settings);
    auto tracer = make(scene, settings, survey, abandon);
    for (const auto pass : core::Survey::passes) {
        if (quality == 0.0F) break;
        for (std::size_t batch = 0; batch < survey.batches(pass); ++batch)
            tracer.survey(pass, batch);
        survey.end(pass);
    }
    abandon = true;
    const std::uint64_t surveyed = tracer.counters().rays();
    const core::Region region{0, 0, settings.width, settings.height};
    Film film(settings.width, settings.height);
    const Film untouched = film;
    tracer.render(region, film);
    CHECK(film.pixels() == untouched.pixels());
    CHECK(tracer.counters().rays() == surveyed);

    abandon = false;
    tracer.render(region, film);
    CHECK(film.pixels() == simd::render(scene, settings, by(engine)).film.pixels());
}

TEST_CASE("a region that is abandoned does not change") {
    for (const float quality : {0.0F, 30.0F}) {
        std::optional<simd::SceneData> data;
        check_abandoned(quality, simd::Engine::vector,
                        [&](const Scene& scene, const Settings& settings, core::Survey& survey,
                            const std::atomic<bool>& abandon) {
                            data.emplace(scene);
                            return simd::Wavefront(*data, settings,
                                                   {&simd::kernels_of(simd::best_isa())}, &survey,
                                                   &abandon);
                        });
        check_abandoned(quality, simd::Engine::reference,
                        [](const Scene& scene, const Settings& settings, core::Survey& survey,
                           const std::atomic<bool>& abandon) {
                            return core::ReferenceTracer<double>(
                                scene, settings, core::Search::hierarchy, core::Precision::exact,
                                settings.quality != 0.0F ? &survey : nullptr, &abandon);
                        });
    }
}
