#include "core/beams/beam_tracer.hpp"
#include "core/beams/region_samples.hpp"
#include "tests/catch.hpp"
#include "tests/core/little_scene.hpp"
#include "tests/random.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/simd/rounds.hpp"

/// What beams are certain of, each of their rays is held to.
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

/// Few or many shapes, before a camera that sees them all.
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

struct Counts {
    int certain = 0, evenly_lit = 0, mixed = 0, partly_lit = 0, off = 0;
};

/// Squares of a scene whose shapes are all of matte materials, of an ambient share of 0.1.
void look(const Scene& scene, Random& random, Counts& counts) {
    const Settings& settings = scene.settings();
    BeamTracer beams(scene, settings);
    ReferenceTracer<double> tracer(scene, settings);
    const CameraRays<double> camera(scene.camera(), settings);
    for (int i = 0; i < 60; ++i) {
        const int size = 1 << random.integer(0, 4);
        const int x = random.integer(0, 64 / size - 1) * size;
        const int y = random.integer(0, 64 / size - 1) * size;
        const double dx = x, dy = y, side = size;
        const Sight sight = beams.sight_of({dx, dy, side}, std::numeric_limits<double>::infinity());
        if (sight == Sight::edge) continue;
        ++counts.certain;
        Hit<double> first;
        double darkest = 1e9, brightest = 0.0;
        for (int k = 0; k < 40; ++k) {
            // Corners and edges, too.
            const auto place = [&] {
                return random.integer(0, 4) == 0 ? random.integer(0, 1) * side
                                                 : random.uniform(0.0, side);
            };
            const Ray<double> ray = camera.ray({x, y, 0}, {place(), place()});
            const Hit<double> hit = tracer.nearest(ray, {}).hit;
            if (k == 0) first = hit;
            if (hit.shape != first.shape || hit.face != first.face) ++counts.mixed;
            if (sight == Sight::step || !hit.any()) continue;
            const double own =
                static_cast<double>(scene.material_of(hit.shape).pattern.colors[0].x);
            const double light = tracer.trace(ray).x / own - 0.1;
            darkest = std::min(darkest, light);
            brightest = std::max(brightest, light);
        }
        if (sight == Sight::step) continue;
        ++counts.evenly_lit;
        if (darkest < 1e-12 && brightest > 0.007) ++counts.partly_lit;
    }
}

} // namespace

TEST_CASE("all rays of a beam meet what it says, in the same light", "[long]") {
    Random random(tests::seed(5));
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        Counts counts;
        for (int round = 0; round < tests::rounds(10, 2, 30); ++round) {
            Builder builder;
            set_up(builder, random);
            const int count = random.integer(1, 20);
            for (int i = 0; i < count; ++i)
                builder.add_shape(ray_sets::Target<Shape>::make(random, i % 5 == 0),
                                  matte(0.2F + 0.03F * static_cast<float>(i)));
            look(std::move(builder).build(), random, counts);
        }
        CAPTURE(name_of(kind_of<Shape>), counts.certain, counts.evenly_lit);
        CHECK(counts.certain > 0);
        CHECK(counts.evenly_lit > 0);
        CHECK(counts.mixed == 0);
        CHECK(counts.partly_lit == 0);
    });
}

TEST_CASE("a beam on a mirror follows what it shows", "[long]") {
    Random random(tests::seed(6));
    int even = 0, off = 0;
    for (int round = 0; round < tests::rounds(20, 3, 40); ++round) {
        Builder builder;
        set_up(builder, random);
        builder.background = Color(0.6F);
        for (int i = 0; i < 12; ++i)
            builder.add_shape(Sphere{rounded(random.cube(6.0)), rounded(random.uniform(0.5, 3.0))},
                              i % 3 == 0 ? mirror(0.7F)
                                         : luminous(Color(0.1F * static_cast<float>(i % 9))));
        const Scene scene = std::move(builder).build();
        BeamTracer beams(scene, scene.settings());
        ReferenceTracer<double> tracer(scene, scene.settings());
        const CameraRays<double> camera(scene.camera(), scene.settings());
        for (int i = 0; i < 200; ++i) {
            const int x = random.integer(0, 63), y = random.integer(0, 63);
            const Square square{static_cast<double>(x), static_cast<double>(y), 1.0};
            if (beams.sight_of(square, std::numeric_limits<double>::infinity()) != Sight::even)
                continue;
            const double middle = tracer.trace(camera.ray({x, y, 0}, {0.5, 0.5})).x;
            double sum = 0.0;
            for (int k = 0; k < 64; ++k)
                sum +=
                    tracer.trace(camera.ray({x, y, 0}, {(k % 8 + 0.5) / 8.0, (k / 8 + 0.5) / 8.0}))
                        .x;
            ++even;
            off += std::abs(sum / 64.0 - middle) > 0.01 ? 1 : 0;
        }
    }
    CHECK(even > 100);
    CHECK(off == 0);
}

TEST_CASE("a beam knows what is hidden behind others, and what shows between them") {
    Builder builder;
    builder.settings.width = builder.settings.height = 16;
    builder.settings.quality = 40.0F;
    builder.camera.from = {0, 0, 10};
    builder.camera.field_of_view = 20.0F;
    builder.add_shape(Box{{-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, {0, 0, 0.5F}}, matte(0.5F));
    const ShapeId hidden = builder.add_shape(Sphere{{0, 0, -5}, 0.5F}, matte(0.1F));
    const ShapeId speck = builder.add_shape(Sphere{{0.05F, 0.05F, 0}, 0.001F}, matte(0.1F));
    const Scene scene = builder.finish();
    BeamTracer beams(scene, scene.settings());
    constexpr double far = std::numeric_limits<double>::infinity();
    CHECK(beams.sight_of({0, 0, 4}, far) != Sight::edge);
    REQUIRE(beams.sight_of({8, 7, 1}, far) == Sight::edge);
    std::vector<ShapeId> asked{hidden, speck};
    const std::vector<BeamCandidate> shown = beams.shown();
    beams.keep_shown({8, 7, 1}, shown, 2, 1, asked);
    CHECK(asked == std::vector<ShapeId>{speck});
    CHECK(beams.surfaces_in({7, 8, 1}, far) != Sight::edge);
}

TEST_CASE("a speck too small to matter is let go, however long a pixel's samples differ") {
    Builder builder;
    builder.settings.width = builder.settings.height = 16;
    builder.settings.quality = 50.0F;
    builder.camera.from = {0, 0, 10};
    builder.camera.field_of_view = 20.0F;
    const ShapeId wall =
        builder.add_shape(Box{{-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, {0, 0, 0.5F}}, matte(0.5F));
    builder.add_shape(Sphere{{0.05F, 0.05F, 0}, 0.001F}, matte(0.1F));
    const Scene scene = builder.finish();
    RegionSamples samples(scene, scene.settings());
    samples.begin({0, 0, 16, 16});
    const std::size_t with_speck = 7 * 16 + 8;
    do
        for (std::size_t pixel = 0; pixel < 256; ++pixel)
            for (int wanted = samples.wanted(pixel), i = 0; i < wanted; ++i)
                samples.add(pixel, {Vec3d(wanted == 1 ? 0.5 : i % 2), wall, 10.5});
    while (samples.end_round());
    CHECK(samples.taken(with_speck) <= 256);
}
