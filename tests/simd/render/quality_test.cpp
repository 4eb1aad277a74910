#include "simd/wavefront/render.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sanitized.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

/// Images of a requested quality, with more samples where there is more to see.
using namespace raylane;
using namespace little_scene;
using ray_sets::Random;
using ray_sets::rounded;
using raylane::tests::shown;

namespace {

/// Returns a material of light and dark squares.
Material checkered(const Color& dark, float size = Pattern{}.size) {
    Material material = luminous(Color(0.9F));
    material.pattern.kind = PatternKind::checker;
    material.pattern.colors[1] = dark;
    material.pattern.size = size;
    return material;
}

/// Returns balls and sticks on a checkered floor, some of them mirrors, some of glass.
Scene fixture(std::pair<int, int> size = {96, 64}) {
    Builder builder;
    builder.settings.width = size.first;
    builder.settings.height = size.second;
    builder.settings.max_depth = 4;
    builder.background = {0.7F, 0.8F, 1.0F};
    builder.camera.from = {1, 2, 9};
    builder.camera.field_of_view = 40.0F;
    Material floor = checkered(Color(0.2F));
    floor.ambient = 0.2F;
    floor.diffuse = 0.7F;
    builder.add_shape(Plane{{0, -1.5F, 0}, {0, 1, 0}}, floor);
    Random random(3);
    for (int i = 0; i < 12; ++i) {
        Material material = luminous(rounded(Vec3d(0.5) + random.cube(0.4)));
        material.ambient = 0.2F;
        material.diffuse = 0.7F;
        material.specular = 0.3F;
        material.exponent = 20.0F;
        if (i % 4 == 1) material.reflectivity = 0.5F;
        if (i % 6 == 2) material.transmission = 0.8F;
        const Vec3f place = rounded(random.cube(2.0));
        builder.add_shape(Sphere{place, 0.3F + 0.05F * static_cast<float>(i)}, material);
        builder.add_shape(CappedCylinder{place, rounded(random.cube(2.0)), 0.05F}, material);
    }
    return builder.finish({.position = {3, 8, 6}});
}

simd::Rendering rendered(const Scene& scene, float quality,
                         const simd::RenderOptions& options = {}) {
    Settings settings = scene.settings();
    settings.quality = quality;
    return simd::render(scene, settings, options);
}

Film converged(const Scene& scene, int grid = 32) {
    Settings settings = scene.settings();
    settings.quality = 0.0F;
    settings.grid = grid;
    settings.samples = SamplePattern::stratified;
    return simd::render(scene, settings, {}).film;
}

/// Returns the difference of the sRGB values that two films show, in decibels.
double psnr(const Film& a, const Film& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const double off = shown(a.pixels()[i][channel]) - shown(b.pixels()[i][channel]);
            sum += off * off / 3.0;
        }
    return -10.0 * std::log10(sum / static_cast<double>(a.pixels().size()));
}

} // namespace

TEST_CASE("an image has the requested quality", "[long]") {
    // In smaller images, the survey has too few pixels.
    const Scene scene = fixture({288, 192});
    const Film truth = converged(scene, 20);
    std::uint64_t last = 0;
    for (const float quality : {30.0F, 36.0F, 42.0F}) {
        const simd::Rendering rendering = rendered(scene, quality);
        CAPTURE(quality);
        CHECK(psnr(rendering.film, truth) >= static_cast<double>(quality) - 0.5);
        CHECK(psnr(rendering.film, truth) <= static_cast<double>(quality) + 2.0);
        CHECK(rendering.counters.primary > last);
        last = rendering.counters.primary;
    }
}

TEST_CASE("an image has the requested quality with wider filters", "[long]") {
    for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::blackman_harris}) {
        Builder builder;
        builder.settings.width = builder.settings.height = 64;
        builder.settings.filter = filter;
        builder.camera.from = {0, 0, 6};
        builder.add_shape(Sphere{{0, 0, 0}, 1.5F}, luminous(Color(0.8F)));
        for (int i = 0; i < 8; ++i)
            builder.add_shape(
                CappedCylinder{{-2, -2 + 0.5F * static_cast<float>(i), 1}, {4, 0.3F, 0}, 0.01F},
                luminous(Color(0.3F)));
        const Scene scene = builder.finish();
        const simd::Rendering rendering = rendered(scene, 40.0F);
        CHECK(psnr(rendering.film, converged(scene)) > 39.5);
    }
}

TEST_CASE("an image of smooth shapes needs few samples", "[native]") {
    Builder builder;
    builder.settings.width = builder.settings.height = 256;
    builder.camera.from = {0, 0, 6};
    Material matte = luminous(Color(0.8F));
    matte.ambient = 0.2F;
    matte.diffuse = 0.8F;
    builder.add_shape(Sphere{{0, 0, 0}, 1.5F}, matte);
    builder.add_shape(CappedCylinder{{-2, -2, 0}, {4, 0.1F, 0}, 0.3F}, matte);
    const Scene scene = builder.finish();
    const simd::Rendering rendering = rendered(scene, 42.0F);
    CHECK(rendering.counters.primary < 256U * 256U * 6U);
    CHECK(psnr(rendering.film, converged(scene)) > 41.5);
}

TEST_CASE("no pixel is done because all rays to the sky around it were blocked by chance") {
    // A fifth of the rays from the bottom of a well reach the sky.
    Builder builder;
    builder.settings.width = builder.settings.height = 96;
    builder.camera.from = {0, 0, 40};
    builder.camera.field_of_view = 8.0F;
    builder.background = Color(1.0F);
    builder.add_light({.kind = LightKind::sky, .color = Color(0.9F)});
    Material matte = luminous(Color(0.8F));
    matte.ambient = 0.0F;
    matte.diffuse = 1.0F;
    builder.add_shape(Disc{{0, 0, 0}, {0, 0, 1}, 1.0F}, matte);
    builder.add_shape(OpenCylinder{{0, 0, 0}, {0, 0, 2}, 1.0F}, matte);
    const Scene scene = builder.finish();
    for (const float quality : {40.0F, 46.0F}) {
        const Film film = rendered(scene, quality).film;
        CAPTURE(quality);
        CHECK(std::count(film.pixels().begin(), film.pixels().end(), Color(0.0F)) == 0);
    }
}

TEST_CASE("an image with details everywhere is sampled without middles of pixels") {
    const auto floor_of_cells = [](float size) {
        Builder builder;
        builder.settings.width = builder.settings.height = 64;
        builder.camera.from = {0, 5, 0};
        builder.camera.up = {0, 0, 1};
        builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, checkered(Color(0.1F), size));
        return builder.finish();
    };
    const auto has_middles = [](const Scene& scene) {
        const simd::Rendering rendering = rendered(scene, 30.0F, {.aovs = true});
        const auto& samples = rendering.aovs.samples;
        // The middle of a pixel counts only if the pixel has no other sample.
        const std::uint64_t counted =
            std::accumulate(samples.begin(), samples.end(), std::uint64_t{0});
        CHECK(psnr(rendering.film, converged(scene)) > 29.5);
        return rendering.counters.primary > counted;
    };
    CHECK_FALSE(has_middles(floor_of_cells(0.02F)));
    CHECK(has_middles(floor_of_cells(1.0F)));
}

TEST_CASE("an image with details everywhere may have the same grid in each pixel") {
    Builder builder;
    constexpr int size = 96;
    constexpr double pixel = 2.0 / size; // the camera's height is 2
    builder.settings.width = builder.settings.height = size;
    builder.camera.projection = Projection::orthographic;
    builder.camera.from = {0, 5, 0};
    builder.camera.up = {0.3F, 0, 1};
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, checkered(Color(0.1F), 0.02F));
    // Pairs of thin sticks that shine: a grid may hit one of two.
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        const Vec3d place = random.cube(0.7), along = pixel * Vec3d(6, 0, random.uniform(-6, 6));
        for (const double aside : {0.0, 0.4 * pixel})
            builder.add_shape(CappedCylinder{rounded(Vec3d(place.x, 1, place.z + aside)),
                                             rounded(along), rounded(pixel / 20.0)},
                              luminous(Color(100.0F)));
    }
    const Scene scene = builder.finish();
    const simd::Rendering rendering = rendered(scene, 25.0F, {.aovs = true});
    const Film truth = converged(scene);
    CHECK(psnr(rendering.film, truth) >= 24.5);
    const auto& samples = rendering.aovs.samples;
    CHECK(std::count(samples.begin(), samples.end(), 9U) > size * size * 9 / 10);
    // Pixels in which the grid misses a stick continue.
    CHECK(*std::min_element(samples.begin(), samples.end()) == 9);
    int visible = 0, lost = 0;
    for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
        if (truth.pixels()[i].x < 6.0F) continue;
        ++visible;
        lost += rendering.film.pixels()[i].x > 0.9F ? 0 : 1;
    }
    CHECK(visible > 100);
    CHECK(lost == 0);
}

TEST_CASE("an image of a quality does not depend on threads or tiles or instruction sets",
          "[long]") {
    const Scene scene = fixture();
    simd::RenderOptions options;
    options.threads = 1;
    const simd::Rendering expected = rendered(scene, 38.0F, options);
    for (const int tile : {8, 16, 40, 64})
        for (const int threads : {1, 3}) {
            options.tile = tile;
            options.threads = threads;
            const simd::Rendering rendering = rendered(scene, 38.0F, options);
            CHECK(rendering.film.pixels() == expected.film.pixels());
            CHECK(rendering.counters.primary == expected.counters.primary);
        }
    for (const simd::Isa isa : simd::available_isas()) {
        options.isa = isa;
        CHECK(rendered(scene, 38.0F, options).film.pixels() == expected.film.pixels());
    }
}

TEST_CASE("the reference renders a quality like the vector engine", "[long]") {
    const Scene scene = fixture();
    const simd::Rendering reference = rendered(scene, 32.0F, {.engine = simd::Engine::reference});
    const simd::Rendering vector = rendered(scene, 32.0F);
    CHECK(psnr(reference.film, vector.film) > 60.0);
    CHECK(static_cast<double>(reference.counters.primary) ==
          Approx(static_cast<double>(vector.counters.primary)).epsilon(0.001));
}

TEST_CASE("both engines take the same samples where surfaces coincide") {
    Builder builder;
    builder.settings.width = 48;
    builder.settings.height = 36;
    builder.settings.quality = 32.0F;
    builder.camera.from = {0.5F, 0.25F, 7};
    const auto in = [](const Color& color) {
        Material material = luminous(color);
        material.diffuse = 0.7F;
        return material;
    };
    // A face that two boxes and a disc share, and two balls that coincide.
    builder.add_shape(Box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, in({0.2F, 0.2F, 1}));
    builder.add_shape(Box{{-0.5F, -1.5F, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}}, in({1, 0.2F, 0.2F}));
    builder.add_shape(Disc{{0, 0, 1}, {0, 0, 1}, 0.75F}, in({0.2F, 1, 0.2F}));
    builder.add_shape(Sphere{{1.5F, 1, 0}, 0.75F}, in({1, 1, 0.2F}));
    builder.add_shape(Sphere{{1.5F, 1, 0}, 0.75F}, in({0.2F, 1, 1}));
    const Scene scene = builder.finish({.position = {3, 8, 6}});
    const simd::Rendering vector = rendered(scene, 32.0F);
    const simd::Rendering reference = rendered(scene, 32.0F, {.engine = simd::Engine::reference});
    CHECK(reference.counters.primary == vector.counters.primary);
    CHECK((reference.film.pixels() == vector.film.pixels()));
}

TEST_CASE("sticks and specks far thinner than a pixel are not lost", "[long]") {
    int visible = 0, lost = 0;
    double samples = 0.0;
    constexpr int size = 64;
    constexpr double pixel = 2.0 / size; // the camera's height is 2
    for (int image = 0; image < (tests::sanitized ? 2 : 24); ++image) {
        Random random(static_cast<std::uint64_t>(image));
        Builder builder;
        builder.settings.width = builder.settings.height = size;
        builder.camera.projection = Projection::orthographic;
        builder.camera.from = {0, 0, 5};
        builder.background = Color(1.0F);
        for (int i = 0; i < 10; ++i) {
            Vec3d place = random.cube(0.9);
            const double angle = random.uniform(0.0, 6.3), length = random.log_uniform(1.0, 20.0);
            const Vec3d along = pixel * length * Vec3d(std::cos(angle), std::sin(angle), 0.1);
            builder.add_shape(
                CappedCylinder{rounded(place), rounded(along), rounded(pixel / 100.0)}, black());
            place = random.cube(0.9);
            builder.add_shape(Sphere{rounded(place), rounded(pixel * 0.08)}, black());
        }
        const Scene scene = builder.finish();
        const Film full = converged(scene);
        const simd::Rendering rendering = rendered(scene, 40.0F);
        samples += static_cast<double>(rendering.counters.primary) / (size * size) / 24.0;
        for (std::size_t i = 0; i < full.pixels().size(); ++i) {
            if (full.pixels()[i].x > 0.99F) continue;
            ++visible;
            lost += rendering.film.pixels()[i].x < 0.999999F ? 0 : 1;
        }
    }
    CAPTURE(visible, samples);
    CHECK(visible > 100);
    CHECK(lost == 0);
}
