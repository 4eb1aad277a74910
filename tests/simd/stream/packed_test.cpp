#include "simd/stream/row_worker.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/simd/stream/stream_columns.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/sanitized.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

/// Scenes with packed spheres give the same answers and images as scenes with plain ones, to the
/// bit.
using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;
using tests::check_same;
using tests::image;
using tests::RayAnswers;
using tests::sanitized;
using tests::StreamColumns;

namespace {

/// Options of a scene of spheres.
struct Wish {
    int radii;
    bool solid = false;
    int count = 3000;
};

/// Scenes of spheres around two points, of few radii or many, some transmissive, with some
/// cylinders among them. The camera is close.
struct Pair {
    Scene plain, packed;

    static Scene make(std::size_t pack_from, const Wish& wish) {
        Random random(static_cast<std::uint64_t>(wish.radii));
        SceneBuilder builder;
        builder.pack_from = pack_from;
        Material mirror, glass;
        mirror.reflectivity = 0.3F;
        glass.transmission = 0.8F;
        builder.add_material(mirror);
        builder.add_material(glass);
        builder.add_light({.position = {30, 40, 50}});
        // One in ten is around the origin, where blocks have rows that are stored whole.
        double middle = 40.0;
        const auto place = [&] { return static_cast<float>(middle + random.uniform(-10.0, 10.0)); };
        for (int i = 0; i < wish.count; ++i) {
            middle = i % 10 == 0 ? 0.0 : 40.0;
            builder.add(Sphere{{place(), place(), place()},
                               0.2F + 0.001F * static_cast<float>(random.integer(1, wish.radii))},
                        i % 40 == 0 ? 1 : 0);
        }
        for (int i = 0; i < 100; ++i)
            builder.add(CappedCylinder{{place(), place(), place()}, {0.5F, 1, 0}, 0.1F}, 0);
        if (wish.solid) builder.add_solid(cut_balls(random), 0);
        builder.camera.at = Vec3f(wish.solid ? 0.0F : 40.0F);
        builder.camera.from = builder.camera.at + Vec3f(25, 3, 2);
        builder.settings.width = sanitized ? 24 : 96;
        builder.settings.height = sanitized ? 16 : 64;
        builder.settings.max_depth = 4;
        return std::move(builder).build();
    }

    /// Returns a union of balls minus a half-space.
    static Solid cut_balls(Random& random) {
        Solid balls, whole, half_space;
        balls.made = Made::by_union;
        for (int i = 0; i < 200; ++i) {
            Vec3d center;
            for (int axis = 0; axis < 3; ++axis)
                center[axis] = random.integer(-48, 48) / 16.0;
            Solid ball;
            ball.shape = SphereOf<double>{center, 0.75};
            balls.parts.push_back(ball);
        }
        half_space.shape = PlaneOf<double>{Vec3d(0.5, 0, 0), Vec3d(1, 0, 0)};
        whole.made = Made::by_intersection;
        whole.parts = {balls, half_space};
        return whole;
    }

    explicit Pair(const Wish& wish) : plain(make(~std::size_t{0}, wish)), packed(make(0, wish)) {
        REQUIRE(!std::get<Table<Sphere>>(plain.shapes()).is_packed());
        REQUIRE(std::get<Table<Sphere>>(packed.shapes()).is_packed());
        CHECK(packed.bytes() < plain.bytes());
        CHECK(!std::get<Table<Sphere>>(packed.shapes()).packed()->rows.empty());
    }
};

StreamColumns rays_for(const Scene& scene) {
    Random random(8);
    StreamColumns rays;
    for_each_shape(std::get<Table<Sphere>>(scene.shapes()),
                   [&](const SphereOf<double>& sphere, ShapeId id) {
                       if (sanitized && id % 16 != 0) return;
                       for (const Set set : ray_sets::all_sets) {
                           rays.add(ray_sets::make_ray(to_floats(sphere), set, random));
                           rays.leaves.push_back(set == Set::on_surface ? id : no_shape);
                       }
                   });
    return rays;
}

void check_rays(const Pair& scenes, const StreamColumns& rays, Isa isa, Precision precision) {
    CAPTURE(std::string(name_of(isa)), std::string(name_of(precision)));
    check_same(RayAnswers(StreamTracer(scenes.packed, 1, isa, precision), rays.view()),
               RayAnswers(StreamTracer(scenes.plain, 1, isa, precision), rays.view()));
}

void check_images(const Pair& scenes, Engine engine, Isa isa, Precision precision) {
    CAPTURE(std::string(name_of(isa)), std::string(name_of(precision)));
    const std::vector<Color> plain = image(scenes.plain, engine, isa, precision);
    const std::vector<Color> packed = image(scenes.packed, engine, isa, precision);
    REQUIRE(plain.size() == packed.size());
    CHECK(std::memcmp(plain.data(), packed.data(), plain.size() * sizeof(Color)) == 0);
}

} // namespace

TEST_CASE("packed spheres answer rays with the bits of plain ones") {
    for (const int radii : {3, 60, 258}) {
        const Pair scenes({.radii = radii}); // 258 radii do not fit in the palette
        const StreamColumns rays = rays_for(scenes.plain);
        for (const Isa isa : available_isas())
            check_rays(scenes, rays, isa, Precision::exact);
    }
}

TEST_CASE("packed spheres answer interleaved single rays with the bits of plain ones", "[native]") {
    // Larger than a core's cache, so that prefetching runs.
    const Pair scenes({.radii = 3, .count = sanitized ? 3000 : 150'000});
    const StreamColumns rays = rays_for(scenes.plain);
    constexpr std::size_t few = 500;
    for (const Isa isa : available_isas()) {
        for (const Precision precision : {Precision::exact, Precision::robust}) {
            CAPTURE(std::string(name_of(isa)), std::string(name_of(precision)));
            for (std::size_t first = 0; first + few <= rays.leaves.size();
                 first += rays.leaves.size() / 8) {
                const RayStream<float> part = rays.view(first, few);
                check_same(RayAnswers(StreamTracer(scenes.packed, 1, isa, precision), part),
                           RayAnswers(StreamTracer(scenes.plain, 1, isa, precision), part));
            }
        }
    }
}

TEST_CASE("packed spheres have the crossings and lengths and insides of plain ones") {
    const Pair scenes({.radii = 20});
    const StreamColumns rays = rays_for(scenes.plain);
    const RayStream<float> part = rays.view(0, std::min<std::size_t>(rays.leaves.size(), 2000));
    for (const Isa isa : available_isas()) {
        CAPTURE(std::string(name_of(isa)));
        const StreamTracer plain(scenes.plain, 1, isa), packed(scenes.packed, 1, isa);
        CrossingCounters counters{};
        CrossingRows plain_rows, packed_rows;
        const CrossingRequest wanted{.normals = true, .normals_double = true};
        plain.crossings(part, wanted, plain_rows, counters);
        packed.crossings(part, wanted, packed_rows, counters);
        CHECK(plain_rows.t.size() > 1000);
        CHECK(packed_rows.t == plain_rows.t);
        CHECK(packed_rows.shape == plain_rows.shape);
        CHECK(packed_rows.entering == plain_rows.entering);
        CHECK(packed_rows.normal == plain_rows.normal);
        CHECK(packed_rows.normal_double == plain_rows.normal_double);
        for (const Bodies bodies : {Bodies::materials, Bodies::solids}) {
            LengthRows plain_lengths, packed_lengths;
            plain.path_lengths(part, bodies, plain_lengths);
            packed.path_lengths(part, bodies, packed_lengths);
            CHECK(packed_lengths.body == plain_lengths.body);
            CHECK(packed_lengths.length == plain_lengths.length);
        }
        SolidRows plain_solids, packed_solids;
        const PointStream<float> points = {part.count,
                                           {part.origin[0], part.origin[1], part.origin[2]}};
        plain.containing(points, plain_solids);
        packed.containing(points, packed_solids);
        CHECK(plain_solids.shape.size() > 100);
        CHECK(packed_solids.shape == plain_solids.shape);
    }
}

TEST_CASE("packed spheres answer rays with the bits of plain ones by every precision", "[native]") {
    const Pair scenes({.radii = 20});
    const StreamColumns rays = rays_for(scenes.plain);
    for (const Isa isa : available_isas())
        for (const Precision precision : all_precisions)
            check_rays(scenes, rays, isa, precision);
}

TEST_CASE("packed spheres are rendered with the bits of plain ones", "[native]") {
    const Pair scenes({.radii = 20});
    for (const Isa isa : available_isas())
        for (const Precision precision : all_precisions)
            check_images(scenes, Engine::vector, isa, precision);
    check_images(scenes, Engine::reference, best_isa(), Precision::exact);
}

TEST_CASE("solids of packed spheres equal those of plain ones", "[native]") {
    const Pair scenes({.radii = 5, .solid = true});
    const StreamColumns rays = rays_for(scenes.plain);
    for (const Isa isa : available_isas()) {
        check_rays(scenes, rays, isa, Precision::exact);
        check_images(scenes, Engine::vector, isa, Precision::exact);
    }
}
