#include "core/beams/beam_tracer.hpp"
#include "core/beams/region_samples.hpp"
#include "core/reference/tracer.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rounds.hpp"

#include <cmath>

/// Checks the claims of beams about all of their rays with single rays.
using namespace raylane;
using namespace little_scene;
using ray_sets::Random;
using ray_sets::rounded;

namespace {

Material matte(float gray) {
    Material material = luminous(Color(gray));
    material.ambient = 0.1F;
    material.diffuse = 0.8F;
    return material;
}

/// Sets up a camera that sees the whole scene, and a light.
void set_up(Builder& builder, Random& random) {
    builder.settings.width = builder.settings.height = 64;
    builder.settings.quality = 40.0F;
    builder.settings.max_depth = 3;
    const Vec3d from = random.uniform(20.0, 50.0) * random.direction();
    builder.camera.from = rounded(from);
    builder.camera.up = rounded(random.direction());
    if (random.integer(0, 3) == 0) {
        builder.camera.projection = Projection::orthographic;
        builder.camera.height = 15.0F;
    } else {
        builder.camera.field_of_view = 25.0F;
    }
    Light light;
    if (random.integer(0, 1) == 0) light.kind = LightKind::directional;
    light.position = rounded(25.0 * random.direction());
    light.direction = rounded(random.direction());
    builder.add_light(light);
}

} // namespace

TEST_CASE("a beam with thin shapes lists every shape that its rays hit", "[long]") {
    Random random(tests::seed(5));
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        int thin = 0, missing = 0;
        for (int round = 0; round < tests::rounds(10, 2, 30); ++round) {
            Builder builder;
            set_up(builder, random);
            const int count = random.integer(1, 20);
            for (int i = 0; i < count; ++i)
                builder.add_shape(ray_sets::Target<Shape>::make(random, i % 5 == 0), matte(0.5F));
            builder.add_shape(
                CappedCylinder{rounded(random.cube(6.0)), rounded(random.cube(6.0)), 0.001F},
                matte(0.5F));
            const Scene scene = std::move(builder).build();
            BeamTracer beams(scene, scene.settings());
            ReferenceTracer<double> tracer(scene, scene.settings());
            const CameraRays<double> camera(scene.camera(), scene.settings());
            for (int i = 0; i < 60; ++i) {
                const int size = 1 << random.integer(0, 4);
                const int x = random.integer(0, 64 / size - 1) * size;
                const int y = random.integer(0, 64 / size - 1) * size;
                const double side = size;
                if (!beams.shows_thin({static_cast<double>(x), static_cast<double>(y), side}))
                    continue;
                ++thin;
                for (int k = 0; k < 40; ++k) {
                    // Includes corners and edges.
                    const auto place = [&] {
                        return random.integer(0, 4) == 0 ? random.integer(0, 1) * side
                                                         : random.uniform(0.0, side);
                    };
                    const auto hit =
                        tracer.nearest(camera.ray({x, y, 0}, {place(), place()}), {}).hit;
                    const auto& shown = beams.shown();
                    missing += !hit.any() || std::any_of(shown.begin(), shown.end(),
                                                         [&](const BeamCandidate& candidate) {
                                                             return candidate.id == hit.shape;
                                                         })
                                   ? 0
                                   : 1;
                }
            }
        }
        CAPTURE(name_of(kind_of<Shape>));
        CHECK(thin > 0);
        CHECK(missing == 0);
    });
}

TEST_CASE("a beam recognises hidden shapes and thin shapes") {
    Builder builder;
    builder.settings.width = builder.settings.height = 16;
    builder.settings.quality = 40.0F;
    builder.camera.from = {0, 0, 10};
    builder.camera.field_of_view = 20.0F;
    builder.add_shape(Box{{-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, {0, 0, 0.5F}}, matte(0.5F));
    const ShapeId hidden = builder.add_shape(Sphere{{0, 0, -5}, 0.01F}, matte(0.1F));
    const ShapeId speck = builder.add_shape(Sphere{{0.05F, 0.05F, 0}, 0.001F}, matte(0.1F));
    builder.add_shape(Sphere{{-0.5F, -0.5F, 0}, 0.3F}, matte(0.1F));
    const Scene scene = builder.finish();
    BeamTracer beams(scene, scene.settings());
    CHECK_FALSE(beams.shows_thin({0, 0, 4}));
    CHECK_FALSE(beams.shows_thin({7, 8, 1})); // the other ball is wide
    REQUIRE(beams.shows_thin({8, 7, 1}));
    CHECK(beams.thin() == std::vector<ShapeId>{speck});
    std::vector<ShapeId> asked{hidden, speck};
    const std::vector<BeamCandidate> shown = beams.shown();
    beams.keep_shown({8, 7, 1}, shown, 2, 1, asked);
    CHECK(asked == std::vector<ShapeId>{speck});
}

TEST_CASE("flat shapes are not thin") {
    Builder builder;
    builder.settings.width = builder.settings.height = 16;
    builder.settings.quality = 40.0F;
    builder.camera.from = {0, 0, 10};
    builder.camera.field_of_view = 20.0F;
    const MaterialIndex grey = builder.add_material(matte(0.5F));
    Solid half{Made::by_intersection};
    half.parts = {of_shape(SphereOf<double>{{0, 0, 0}, 1}),
                  of_shape(PlaneOf<double>{{0, 0, 0.5}, {0, 0, 1}})};
    builder.add_solid(half, grey);
    builder.add(Box{{-3, 1, -2}, {6, 0, 0}, {0, 2, 0}, {0, 0, 1e-4F}}, grey);
    builder.add(Ellipsoid{{0, -2, -2}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1e-4F}}, grey);
    const Scene scene = builder.finish();
    BeamTracer beams(scene, scene.settings());
    CHECK_FALSE(beams.shows_thin({0, 0, 16}));
}

TEST_CASE("sampling stops at a speck that is too small to matter") {
    Builder builder;
    builder.settings.width = builder.settings.height = 16;
    builder.settings.quality = 50.0F;
    builder.camera.from = {0, 0, 10};
    builder.camera.field_of_view = 20.0F;
    const ShapeId wall =
        builder.add_shape(Box{{-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, {0, 0, 0.5F}}, matte(0.5F));
    builder.add_shape(Sphere{{0.05F, 0.05F, 0}, 0.001F}, matte(0.1F));
    const Scene scene = builder.finish();
    Survey survey(scene, scene.settings());
    for (const auto pass : Survey::passes) {
        for (std::size_t batch = 0; batch < survey.batches(pass); ++batch) {
            Survey::Samples samples(survey, pass, batch);
            do
                for (std::size_t pixel = 0; pixel < samples.pixels(); ++pixel)
                    for (int wanted = samples.wanted(pixel); wanted > 0; --wanted)
                        samples.add(pixel, {Vec3d(0.5), wall});
            while (samples.end_round());
        }
        survey.end(pass);
    }
    RegionSamples samples(scene, scene.settings(), survey);
    samples.begin({0, 0, 16, 16});
    do
        for (std::size_t pixel = 0; pixel < 256; ++pixel)
            for (int wanted = samples.wanted(pixel); wanted > 0; --wanted)
                samples.add(pixel, {Vec3d(0.5), wall});
    while (samples.end_round());
    CHECK(samples.taken(0) == 1);
    const std::size_t with_speck = 7 * 16 + 8;
    CHECK(samples.taken(with_speck) >= 64);
    CHECK(samples.taken(with_speck) <= 256);
}

TEST_CASE("a survey expects noise that is not stratified to fall slowly") {
    // A pixel has an edge and noise. Up to 32 samples, the error falls fast, as that of edges.
    Builder builder;
    builder.settings.width = builder.settings.height = 160;
    builder.settings.quality = 48.0F;
    builder.settings.transfer = Transfer::linear;
    builder.add_shape(Sphere{{0, 0, 0}, 1}, matte(0.5F));
    const Scene scene = builder.finish();
    const auto sampled = [](const SampleName& name) {
        const auto x = static_cast<std::uint32_t>(name.x), y = static_cast<std::uint32_t>(name.y);
        const SamplePoint line = sequence_point(sequence_key(x, y, 8), 0),
                          at = place_in_pixel(name);
        const float below = 0.3F + 0.4F * line.x; // the area below the edge
        const bool is_below = at.y < below + (line.y - 0.5F) * (at.x - 0.5F);
        const auto number = static_cast<std::uint32_t>(name.number + 2000 * name.common);
        const double noise =
            static_cast<double>(sequence_point(sequence_key(x, y, 9 + number), 0).x) - 0.5;
        return Sample{
            Vec3d(0.5 + 0.4 * ((is_below ? 1.0 : 0.0) - static_cast<double>(below)) + 0.2 * noise),
            0};
    };
    const auto take_all = [&](auto& samples, std::size_t pixels, const auto& x, const auto& y) {
        do
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                for (int wanted = samples.wanted(pixel), first = samples.next(pixel), i = 0;
                     i < wanted; ++i)
                    samples.add(pixel, sampled({x(pixel), y(pixel), first + i, samples.common()}));
        while (samples.end_round());
    };
    Survey survey(scene, scene.settings());
    for (const auto pass : Survey::passes) {
        for (std::size_t batch = 0; batch < survey.batches(pass); ++batch) {
            Survey::Samples samples(survey, pass, batch);
            take_all(
                samples, samples.pixels(), [&](std::size_t i) { return samples.x(i); },
                [&](std::size_t i) { return samples.y(i); });
        }
        survey.end(pass);
    }
    RegionSamples samples(scene, scene.settings(), survey);
    samples.begin({0, 0, 160, 160});
    take_all(
        samples, 160 * 160, [](std::size_t i) { return static_cast<int>(i % 160); },
        [](std::size_t i) { return static_cast<int>(i / 160); });
    double sum = 0.0;
    for (std::size_t i = 0; i < 160 * 160; ++i) {
        const double off = static_cast<double>(samples.mean(i).x) - 0.5;
        sum += off * off;
    }
    const double quality = -10.0 * std::log10(sum / (160.0 * 160.0));
    CHECK(quality >= 47.5);
    CHECK(quality <= 50.0);
}
