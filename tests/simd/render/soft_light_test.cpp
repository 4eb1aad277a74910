#include "simd/wavefront/render.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rounds.hpp"

#include <cmath>
#include <numbers>

/// Lights with a size, and a lens, rendered by both engines.
using namespace raylane;
using namespace little_scene;
using ray_sets::Random;
using ray_sets::rounded;
using raylane::tests::shown;

namespace {

constexpr double pi = std::numbers::pi;

Material white() {
    Material material = luminous(Color(1.0F));
    material.ambient = 0.0F;
    material.diffuse = 1.0F;
    return material;
}

/// Returns a view of one pixel of a white floor, around the origin.
Builder floor_seen_from(const Vec3f& from) {
    Builder builder;
    builder.settings.width = builder.settings.height = 1;
    builder.settings.light_samples = 4096;
    builder.camera.projection = Projection::orthographic;
    builder.camera.from = from;
    builder.camera.at = {0, 0, 0};
    builder.camera.up = {0, 0, 1};
    builder.camera.height = 1e-4F;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, white());
    return builder;
}

template <class Check>
void check_both(const Scene& scene, const Check& check) {
    simd::RenderOptions options;
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
        options.engine = engine;
        check(simd::render(scene, scene.settings(), options).film);
    }
}

Light sky() {
    return {.kind = LightKind::sky};
}

Light ball_of_light(const Vec3f& middle, float radius) {
    return {.kind = LightKind::sphere, .position = middle, .radius = radius};
}

/// Returns balls on a checkered floor under lights of all kinds. One ball is a mirror, one is
/// glass.
Scene studio(float quality, float lens = 0.0F) {
    Builder builder;
    builder.settings.width = 80;
    builder.settings.height = 56;
    builder.settings.max_depth = 4;
    builder.settings.quality = quality;
    builder.settings.light_samples = 4;
    builder.background = {0.5F, 0.6F, 0.8F};
    builder.camera.from = {1, 2, 7};
    builder.camera.field_of_view = 40.0F;
    builder.camera.lens_radius = lens;
    Material floor = white();
    floor.pattern.kind = PatternKind::checker;
    floor.pattern.colors[1] = Color(0.4F);
    builder.add_shape(Plane{{0, -1.2F, 0}, {0, 1, 0}}, floor);
    Random random(5);
    for (int i = 0; i < 12; ++i) {
        Material material = white();
        material.pattern.colors[0] = rounded(Vec3d(0.5) + random.cube(0.4));
        material.diffuse = 0.7F;
        material.specular = 0.3F;
        material.exponent = 15.0F;
        if (i == 3) material.reflectivity = 0.6F;
        if (i == 5) material.transmission = 0.9F;
        builder.add_shape(Sphere{rounded(random.cube(1.6)), 0.25F + 0.04F * static_cast<float>(i)},
                          material);
    }
    Light light = sky();
    light.color = {0.3F, 0.35F, 0.5F};
    light.ground = {0.2F, 0.1F, 0.05F};
    builder.add_light(light);
    light = ball_of_light({3, 4, 3}, 0.7F);
    light.color = Color(8.0F);
    builder.add_light(light);
    light.kind = LightKind::disc;
    light.position = {-4, 3, 1};
    light.direction = {1, -0.7F, 0};
    light.color = {5, 3, 1};
    builder.add_light(light);
    light.kind = LightKind::rectangle;
    light.position = {-1, 4, -2};
    light.edge_u = {2, 0, 0};
    light.edge_v = {0, 0, 1};
    light.color = {1, 2, 3};
    builder.add_light(light);
    return builder.finish({.position = {0, 5, 4}, .color = Color(0.3F)});
}

simd::Rendering rendered(const Scene& scene, const simd::RenderOptions& options = {}) {
    return simd::render(scene, scene.settings(), options);
}

double error_of(const Film& a, const Film& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        sum += static_cast<double>(squared_length(a.pixels()[i] - b.pixels()[i])) / 3.0;
    return std::sqrt(sum / static_cast<double>(a.pixels().size()));
}

} // namespace

TEST_CASE("a ball hides its share of the sky's hemisphere", "[long]") {
    for (const Vec3f& middle : {Vec3f(0, 3, 0), Vec3f(2, 2, 1), Vec3f(-4, 1.2F, 0)}) {
        const auto scene = [&](float reach) {
            Builder builder = floor_seen_from({2, 2, -4});
            builder.add_shape(Sphere{middle, 1.0F}, black());
            Light light = sky();
            light.reach = reach;
            return builder.finish(light);
        };
        const double squared = static_cast<double>(squared_length(middle));
        const double hidden = static_cast<double>(middle.y) / std::sqrt(squared) / squared;
        // The ball's edge crosses some 150 of 64 x 64 strata, each with an error of up to one
        // sample: a standard deviation of 1.2e-3.
        check_both(scene(100.0F), [&](const Film& film) {
            CHECK(static_cast<double>(film.pixels()[0].x) == Approx(1.0 - hidden).margin(4e-3));
        });
        // Beyond the sky's reach, the ball hides nothing.
        check_both(scene(static_cast<float>(std::sqrt(squared) - 1.01)),
                   [&](const Film& film) { CHECK(film.pixels()[0].x == Approx(1.0F)); });
    }
}

TEST_CASE("the sky's colours change evenly from the nadir to the zenith") {
    Builder builder = floor_seen_from({2, 2, 2});
    Light light = sky();
    light.color = {1, 0, 0};
    light.ground = {0, 1, 0};
    check_both(builder.finish(light), [&](const Film& film) {
        CHECK(static_cast<double>(film.pixels()[0].x) == Approx(5.0 / 6.0).epsilon(1e-3));
        CHECK(static_cast<double>(film.pixels()[0].y) == Approx(1.0 / 6.0).epsilon(1e-3));
    });
}

TEST_CASE("a spherical light has the expected penumbra", "[long]") {
    constexpr double height = 4.0, radius = 1.5;
    for (const double edge : {-0.5, -0.3, -0.1, 0.0, 0.15, 0.3, 0.5}) {
        // A wall that ends at x = edge, at height 1: it hides directions of x > edge * y.
        Builder builder = floor_seen_from({-0.5F, 0.3F, 0});
        builder.add_shape(
            Box{{static_cast<float>(edge), 1, -900}, {900, 0, 0}, {0, 1e-3F, 0}, {0, 0, 1800}},
            black());
        // On the floor's unit disc of directions the light is a circle, the wall's edge an ellipse.
        const double sine = radius / height, slope = static_cast<double>(static_cast<float>(edge));
        constexpr int steps = 20000;
        double area = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double z = sine * (2.0 * (i + 0.5) / steps - 1.0);
            const double half = std::sqrt(sine * sine - z * z);
            const double end = slope * std::sqrt((1.0 - z * z) / (1.0 + slope * slope));
            area += std::clamp(end + half, 0.0, 2.0 * half) * (2.0 * sine / steps);
        }
        CAPTURE(edge);
        check_both(builder.finish(ball_of_light({0, 4, 0}, 1.5F)), [&](const Film& film) {
            CHECK(static_cast<double>(film.pixels()[0].x) == Approx(area / pi).margin(2e-4));
        });
    }
}

TEST_CASE("a lens blurs an edge by its distance from the plane of focus", "[long]") {
    for (const double distance : {3.0, 5.0, 8.0})
        for (const double beside : {-0.15, -0.05, 0.0, 0.1}) {
            Builder builder;
            builder.settings.width = builder.settings.height = 1;
            builder.settings.grid = 64;
            builder.camera.from = {static_cast<float>(-beside), 0, 0};
            builder.camera.at = {static_cast<float>(-beside), 0, -5};
            builder.camera.field_of_view = 1e-3F;
            builder.camera.lens_radius = 0.25F;
            builder.background = Color(1.0F);
            builder.add_shape(Box{{0, -900, static_cast<float>(-distance)},
                                  {900, 0, 0},
                                  {0, 1800, 0},
                                  {0, 0, -1e-4F}},
                              black());
            // The rays meet the box's plane in a disc. A segment of the disc misses the box.
            const double radius = 0.25 * std::abs(1.0 - distance / 5.0);
            const double off = static_cast<double>(static_cast<float>(beside));
            const double h =
                radius == 0.0 ? (off > 0.0 ? 1.0 : -1.0) : std::clamp(off / radius, -1.0, 1.0);
            const double white = (std::asin(h) + h * std::sqrt(1.0 - h * h)) / pi + 0.5;
            if (radius == 0.0 && off == 0.0) continue;
            CAPTURE(distance, beside);
            check_both(builder.finish(), [&](const Film& film) {
                CHECK(static_cast<double>(film.pixels()[0].x) == Approx(white).margin(4e-3));
            });
        }
}

TEST_CASE("soft light does not depend on threads or tiles or instruction sets", "[long]") {
    for (const float quality : {0.0F, 32.0F})
        for (const float lens : {0.0F, 0.1F}) {
            const Scene scene = studio(quality, lens);
            simd::RenderOptions options;
            options.threads = 1;
            const simd::Rendering expected = rendered(scene, options);
            for (const int tile : {8, 40}) {
                options.tile = tile;
                options.threads = 3;
                CHECK(rendered(scene, options).film.pixels() == expected.film.pixels());
            }
            for (const simd::Isa isa : simd::available_isas()) {
                options.isa = isa;
                CHECK(rendered(scene, options).film.pixels() == expected.film.pixels());
            }
            options = {};
            options.engine = simd::Engine::reference;
            const simd::Rendering reference = rendered(scene, options);
            // In some pixels, an ulp decides which point of the sky is hidden.
            CHECK(error_of(reference.film, expected.film) < 2e-3);
            CHECK(static_cast<double>(reference.counters.shadow) ==
                  Approx(static_cast<double>(expected.counters.shadow)).epsilon(0.01));
        }
}

TEST_CASE("both engines see the same sky from cylinders along a coordinate") {
    for (int axis = 0; axis < 3; ++axis) {
        Builder builder;
        builder.settings.width = 64;
        builder.settings.height = 48;
        builder.camera.from = {2.3F, 2.1F, 3.7F};
        builder.camera.at = {0.1F, 0.2F, 0.3F};
        Vec3f along(0.0F);
        along[axis] = 1.3F;
        builder.add_shape(CappedCylinder{{0.1F, 0.2F, -0.1F}, along, 0.4F}, white());
        builder.add_shape(Sphere{{0.3F, 1.1F, 0.65F}, 0.4F}, white());
        const Scene scene = builder.finish(sky());
        simd::RenderOptions options;
        const simd::Rendering expected = rendered(scene, options);
        options.engine = simd::Engine::reference;
        CHECK((rendered(scene, options).film.pixels() == expected.film.pixels()));
    }
}

TEST_CASE("hard light comes from the middle of a lamp and from all of a sky") {
    Light disc = ball_of_light({0, 4, 0}, 1.0F);
    disc.kind = LightKind::disc;
    disc.direction = {0, -1, 0};
    Light rectangle = disc;
    rectangle.kind = LightKind::rectangle;
    rectangle.position = {-1, 4, -1};
    rectangle.edge_u = {2, 0, 0};
    rectangle.edge_v = {0, 0, 2};
    for (const Light& lamp : {ball_of_light({0, 4, 0}, 1.0F), disc, rectangle, sky()}) {
        const auto lit = [&](float ball_at, const auto& check) {
            Builder builder = floor_seen_from({0, 0.5F, 0});
            builder.settings.light_samples = Settings::hard_light;
            builder.add_shape(Sphere{{ball_at, 2, 0}, 0.3F}, white());
            check_both(builder.finish(lamp), [&](const Film& film) { check(film.at(0, 0).x); });
        };
        CAPTURE(lamp.kind);
        float open = 0.0F;
        lit(9.0F, [&](float shown) { open = shown; });
        CHECK(open > 0.05F);
        lit(0.4F, [&](float shown) { CHECK(shown == open); }); // hides a part of it, not its middle
        lit(0.2F,
            [&](float shown) { CHECK(shown == (lamp.kind == LightKind::sky ? open : 0.0F)); });
    }
}

TEST_CASE("both engines render nearly the same hard light") {
    const Scene scene = studio(0.0F);
    Settings settings = scene.settings();
    settings.light_samples = Settings::hard_light;
    simd::RenderOptions options;
    const Film expected = simd::render(scene, settings, options).film;
    options.engine = simd::Engine::reference;
    CHECK(error_of(simd::render(scene, settings, options).film, expected) < 2e-3);
}

TEST_CASE("soft light's error falls faster than that of random samples", "[long]") {
    const Scene scene = studio(0.0F);
    Settings settings = scene.settings();
    const auto drawn = [&](int samples) {
        settings.light_samples = samples;
        return simd::render(scene, settings, {}).film;
    };
    const Film truth = drawn(4096);
    const double of_4 = error_of(drawn(4), truth), of_256 = error_of(drawn(256), truth);
    CAPTURE(of_4, of_256);
    CHECK(of_256 < of_4 / 16.0); // an eighth for random samples
}

TEST_CASE("soft light and a lens have the requested quality", "[long]") {
    // A higher quality must be compared with an image of more samples.
    const bool is_full = tests::is_full();
    for (const float lens : {0.0F, 0.1F}) {
        const Scene scene = studio(0.0F, lens);
        Settings settings = scene.settings();
        settings.grid = is_full ? 32 : 16;
        settings.light_samples = 16;
        settings.samples = SamplePattern::stratified;
        const Film truth = simd::render(scene, settings, {}).film;
        for (const float quality : {28.0F, 34.0F, 40.0F}) {
            if (quality == 40.0F && !is_full) continue;
            settings = scene.settings();
            settings.quality = quality;
            const Film film = simd::render(scene, settings, {}).film;
            double sum = 0.0;
            for (std::size_t i = 0; i < film.pixels().size(); ++i)
                for (int channel = 0; channel < 3; ++channel) {
                    const double off =
                        shown(film.pixels()[i][channel]) - shown(truth.pixels()[i][channel]);
                    sum += off * off / 3.0;
                }
            CAPTURE(lens, quality);
            const double had = -10.0 * std::log10(sum / static_cast<double>(film.pixels().size()));
            CHECK(had >= static_cast<double>(quality) - 0.5);
            CHECK(had <= static_cast<double>(quality) + 2.0);
        }
    }
}
