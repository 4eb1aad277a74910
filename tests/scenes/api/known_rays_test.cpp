#include "scenes/api/cpp/internals.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/scenes/api/exam.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <vector>

/// Rays that once had wrong answers, and rays around them. Every bit of the numbers matters: with
/// one bit changed, it is another case.
using namespace raylane;
using namespace raylane::tests;
using core::Vec3d;
using core::Vec3f;
using ray_sets::rounded;

namespace {

using Ray = core::Ray<float>;
using Shapes = std::vector<tests::AnyShape>;

/// Checks all answers against the oracle, with limits at crossings, on every instruction set and on
/// one and several threads. Returns the number of hits.
long check(const Shapes& shapes, std::span<const Ray> rays, double min_hits = 0.25) {
    Tally tally;
    Exam(shapes).ask(rays, Limits::at_crossings, Ways::all, tally);
    INFO(tally.report());
    CHECK(tally.wrong() == 0);
    CHECK(static_cast<double>(tally.hits) >= min_hits * static_cast<double>(tally.rays));
    return tally.hits;
}

/// Answer to one ray. The oracle has confirmed it.
struct Answer {
    float t;
    ShapeId shape;
    bool entering;
    Vec3f normal;
    bool occluded;
};
Answer answer(const Shapes& shapes, const Ray& ray, float t_min = 0.0F, float t_max = infinity) {
    check(shapes, std::span(&ray, 1));
    Rays rays;
    rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
             {ray.direction.x, ray.direction.y, ray.direction.z});
    rays.t_min = {t_min};
    rays.t_max = {t_max};
    const Tracer tracer(scene_of(shapes));
    const Hits hits = intersect(tracer, rays);
    return {hits.t[0], hits.shape[0], hits.entering[0] != 0,
            Vec3f(hits.nx[0], hits.ny[0], hits.nz[0]), occluded(tracer, rays)[0] != 0};
}

core::Box cube(const Vec3f& corner, float size = 1.0F) {
    return {corner, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
}

} // namespace

TEST_CASE("a disc on a cylinder's cap ties with the cap from five million diameters away",
          "[known]") {
    const Shapes shapes = {core::CappedCylinder{{0, -1, 0}, {0, 1, 0}, 1},
                           core::Disc{{0, 0, 0}, {0, 1, 0}, 1}};
    const Ray ray{{0x1.72ae76p+22F, 0x1.f5ecfap+22F, 0x1.4bbabp+22F},
                  {-0x1.0c91acp-1F, -0x1.6ba8bcp-1F, -0x1.e0b1b6p-2F}};
    CHECK(answer(shapes, ray).shape == 0);
}

TEST_CASE("a ray between stacked boxes enters one before it leaves the other", "[known]") {
    const Shapes shapes = {cube({0, 0, 0}), cube({0, -1, 0})};
    const Ray ray{{0.25F, -0.75F, 0x1.000004p+0F}, {2, 5, -1}};
    const Answer first = answer(shapes, ray, 0x1p-22F);
    CHECK(first.shape == 0);
    CHECK(first.entering);
}

TEST_CASE("a triangle in a box's face ties with the face from any distance", "[known]") {
    ray_sets::Random random(11);
    const Shapes shapes = {cube({-2, -2, -4}, 4.0F),
                           core::Triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}},
                           cube({-2, -2, -4}, 4.0F)};
    std::vector<Ray> rays;
    for (const double distance : {10.0, 1e4, 1e7})
        for (int i = 0; i < 100; ++i) {
            Vec3d from = random.direction();
            from.z = std::abs(from.z);
            const Vec3d to(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0);
            const Vec3f origin = rounded(to + distance * from);
            rays.push_back({origin, rounded(to - core::convert<double>(origin))});
        }
    check(shapes, rays);
}

TEST_CASE("a ray hits the one of two touching spheres that is nearer by a double's last bits",
          "[known]") {
    const Shapes shapes = {core::Sphere{{0, 1.0F / 32, 0.5F}, 1.0F / 32},
                           core::Sphere{{1.0F / 16, 1.0F / 32, 0.5F}, 1.0F / 32}};
    const Ray ray{{0x1.25da72p-6F, 0x1.b880ccp-6F, 0x1.040432p-1F},
                  {0x1.a8879cp-1F, 0x1.1646cap-2F, -0x1.f43c78p-2F}};
    CHECK(answer(shapes, ray).shape == 0);
}

TEST_CASE("rays within 1e-8 of the contact of unit spheres hit the right one", "[known]") {
    ray_sets::Random random(12);
    const Shapes shapes = {core::Sphere{{-1, 0, 0}, 1}, core::Sphere{{1, 0, 0}, 1}};
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) {
        const Vec3d to = random.direction() * random.log_uniform(1e-16, 1e-8);
        Vec3d way = random.direction();
        if (i % 2 == 0) way.x *= random.log_uniform(1e-12, 1e-2);
        const Vec3f origin = rounded(to - random.uniform(0.5, 3.0) * way);
        rays.push_back({origin, rounded(to - core::convert<double>(origin))});
    }
    check(shapes, rays);
}

/// Returns the quadric x^2 + z^2 + bend y^2 + lean y = 1, which is used near y = 0.
static core::Quadric rim(float bend, float lean) {
    core::Quadric q{};
    q.xx = q.zz = 1;
    q.yy = bend;
    q.y = 0.5F * lean;
    q.one = -1;
    q.lower = Vec3f(-2);
    q.upper = Vec3f(2);
    return q;
}

TEST_CASE("a quadric and a cylinder apart by 2^-148 or its square are hit in order", "[known]") {
    const core::CappedCylinder pipe{{0, -1, 0}, {0, 2, 0}, 1};
    for (const float y : {-0x1.8p-148F, 0x1.8p-148F})
        for (const bool first : {false, true}) {
            const auto both = [&](const core::Quadric& quadric) {
                return first ? Shapes{quadric, pipe} : Shapes{pipe, quadric};
            };
            const ShapeId of_quadric = first ? 0 : 1;
            const Ray ray{{-2, y, 0}, {1, 0, 0}};
            CAPTURE(y, first);
            // Below y = 0 the quadric is the wider one, above it the narrower one.
            CHECK((answer(both(rim(0, 1)), ray).shape == of_quadric) == (y < 0));
            CHECK(answer(both(rim(1, 0)), ray).shape != of_quadric);
            CHECK(answer(both(rim(-1, 0)), ray).shape == of_quadric);
            CHECK(answer(both(rim(0, 0)), ray).shape == 0); // the same surface
        }
}

TEST_CASE("a ray with the t of its entry as t_min finds the exit of a thin cone", "[known]") {
    const Shapes shapes = {core::OpenCone{{-0x1.040d94p+2F, -0x1.c3773ap+1F, 0x1.b76b34p+2F},
                                          {-0x1.9fe7dep-5F, -0x1.4db4ep-3F, -0x1.0c6236p-4F},
                                          0x1.318d2ap-7F,
                                          0x1.ee2598p-9F}};
    const Ray ray{{0x1.8a054cp+3F, 0x1.5bfcdcp+5F, 0x1.a09972p+4F},
                  {-0x1.fd0b3p+1F, -0x1.6da78p+3F, -0x1.2a215cp+2F}};
    const Answer entry = answer(shapes, ray);
    CHECK(entry.t == 0x1.081744p+2F);
    CHECK(entry.entering);
    const Answer exit = answer(shapes, ray, entry.t);
    CHECK(exit.t == 0x1.083e98p+2F);
    CHECK(!exit.entering);
    CHECK(exit.occluded);
    const Answer none = answer(shapes, ray, exit.t);
    CHECK(none.shape == no_shape);
    CHECK(!none.occluded);
}

TEST_CASE("a ray through an apex hits it once", "[known]") {
    const core::OpenCone open{{0, 0, 0}, {0, 0, 2}, 1, 0};
    const core::CappedCone capped{{0, 0, 0}, {0, 0, 2}, 1, 0};
    for (const Shapes& shapes : {Shapes{open}, Shapes{capped}, Shapes{open, capped}})
        for (const Vec3f& way : {Vec3f(1, 0, 0), Vec3f(3, 1, 0.25F), Vec3f(1, 0, -0.25F)}) {
            const Ray ray{Vec3f(0, 0, 2) - 4.0F * way, way};
            CHECK(answer(shapes, ray).t == 4.0F);
            CHECK(answer(shapes, ray, 4.0F).shape == no_shape);
            CHECK(!answer(shapes, ray, 4.0F).occluded);
        }
    // Along the axis the ray enters at the apex, and leaves a capped cone by its base.
    const Ray along{{0, 0, 4}, {0, 0, -1}};
    CHECK(answer({open}, along).t == 2.0F);
    CHECK(answer({open}, along, 2.0F).shape == no_shape);
    CHECK(answer({capped}, along, 2.0F).t == 4.0F);
}

TEST_CASE("subnormal spheres block a ray that ends on them", "[known]") {
    for (const float radius : {0x1p-130F, 0x1p-140F, 0x1.8p-148F, 0x1p-149F})
        for (const float scale : {1.0F, radius}) {
            const Shapes shapes = {core::Sphere{{0, 0, 0}, radius}};
            const Ray ray{{-4.0F * radius, 0, 0}, {scale, 0, 0}};
            const Answer hit = answer(shapes, ray);
            CHECK(hit.shape == 0);
            CHECK(answer(shapes, ray, 0.0F, hit.t).occluded);
            CHECK(answer(shapes, ray, 0.0F, hit.t).shape == 0);
            CHECK(!answer(shapes, ray, 0.0F, std::nextafter(hit.t, 0.0F)).occluded);
        }
}

TEST_CASE("a ray leaves a cylinder of size 1e-7 at 1e-3 at the nearest float", "[known]") {
    ray_sets::Random random(14);
    for (int i = 0; i < 200; ++i) {
        const Vec3d base = 1e-3 * random.direction();
        const Vec3d axis = 1e-7 * random.uniform(0.3, 3.0) * random.direction();
        const double radius = 1e-7 * random.uniform(0.3, 3.0);
        std::vector<Ray> rays;
        for (int j = 0; j < 10; ++j)
            rays.push_back({rounded(base + random.uniform(0.0, 1.0) * axis +
                                    random.uniform(0.0, 0.9) * radius * random.direction()),
                            rounded(random.direction())});
        check({core::CappedCylinder{rounded(base), rounded(axis), rounded(radius)}}, rays);
    }
}

TEST_CASE("an apex has the axis as normal and a corner or edge the lowest face's normal",
          "[known]") {
    const core::OpenCone up{{0, 0, 0}, {0, 0, 2}, 1, 0}, down{{0, 0, 0}, {0, 0, 2}, 0, 1};
    const Ray across{{-4, 0, 2}, {1, 0, 0}}, across_base{{-4, 0, 0}, {1, 0, 0}};
    CHECK(answer({up}, across).normal == Vec3f(0, 0, 1));
    CHECK(answer({down}, across_base).normal == Vec3f(0, 0, -1));
    core::Quadric cone{};
    cone.xx = cone.yy = 1;
    cone.zz = -1;
    cone.lower = Vec3f(-1);
    cone.upper = Vec3f(1);
    CHECK(answer({cone}, across_base).normal == Vec3f(0, 0, 1));

    const Shapes box = {cube({0, 0, 0})};
    CHECK(answer(box, {{-1, -1, -1}, {1, 1, 1}}).normal == Vec3f(-1, 0, 0));
    CHECK(answer(box, {{0.5F, -1, -1}, {0, 1, 1}}).normal == Vec3f(0, -1, 0));
    CHECK(answer(box, {{2, 2, 2}, {-1, -1, -1}}).normal == Vec3f(1, 0, 0));
    CHECK(answer(box, {{0.5F, 2, 2}, {0, -1, -1}}).normal == Vec3f(0, 1, 0));
    CHECK(answer(box, {{-1, 0.5F, -1}, {1, 0, 1}}).normal == Vec3f(-1, 0, 0));
}

TEST_CASE("normals next to an apex and to corners point outwards", "[known]") {
    ray_sets::Random random(15);
    const Shapes shapes = {core::CappedCone{{0, 0, -2}, {0, 0, 2}, 1, 0}, cube({0, 0, 0})};
    std::vector<Ray> rays;
    for (int i = 0; i < 200; ++i) {
        const Vec3d to = random.direction() * random.log_uniform(1e-20, 1e-12);
        const Vec3d way = random.direction();
        rays.push_back({rounded(to - 2.0 * way), rounded(way)});
        rays.push_back({rounded(to), rounded(way)});
    }
    check(shapes, rays, 0.1);
}

TEST_CASE("the side that a ray comes from is right at grazing planes", "[known]") {
    ray_sets::Random random(16);
    long hits = 0;
    for (int i = 0; i < 100; ++i) {
        const Vec3f point = rounded(random.cube(3.0)), normal = rounded(random.direction());
        std::vector<Ray> rays;
        for (int j = 0; j < 10; ++j) {
            Vec3d along = ray_sets::across(core::convert<double>(normal), random);
            along += random.log_uniform(1e-18, 1e-6) * random.direction();
            rays.push_back({rounded(random.cube(5.0)), rounded(along)});
        }
        hits += check({core::Plane{point, normal}}, rays, 0.0);
        check({core::Disc{point, normal, 1e9F}}, rays, 0.0);
    }
    CHECK(hits > 400);
}

TEST_CASE("shapes that are far away are hit in order and with their normals", "[known]") {
    ray_sets::Random random(17);
    const core::Sphere one{{0, 0, 0}, 1}, other{{0, 0, 1}, 1};
    CHECK(answer({one, other}, {{0.01F, 0.02F, 1e17F}, {0, 0, -1}}).shape == 1);
    const Answer hit = answer({one}, {{0.01F, 0.02F, 1e16F}, {0, 0, -1}});
    CHECK(hit.normal.x == Approx(0.01));
    CHECK(hit.normal.z > 0.9F);
    CHECK(answer({core::Sphere{{0, 0, 0}, 1e-20F}}, {{0, 0, 1}, {0, 0, -1}}).normal ==
          Vec3f(0, 0, 1));

    const Shapes setup = {one,
                          other,
                          core::CappedCylinder{{0, 0, -3}, {0.25F, 0, 4.5F}, 0.5F},
                          core::OpenCylinder{{0, 0, -3}, {0, 0, 4.25F}, 0.75F},
                          core::Disc{{0, 0, 1.5F}, {0.5F, 0, 1}, 0.5F},
                          cube({-0.5F, -0.5F, 0.625F}),
                          core::CappedCone{{0, 0, 0}, {0, 0, 3}, 0.5F, 0.125F}};
    for (const double distance : {1e10, 1e16, 1e17, 1e25})
        for (std::size_t first = 0; first < setup.size(); ++first) {
            std::vector<Ray> rays;
            for (int i = 0; i < 20; ++i) {
                Vec3d from = random.cube(0.75);
                from.z = distance;
                rays.push_back({rounded(from), {0, 0, -1}});
            }
            check({setup.begin() + static_cast<std::ptrdiff_t>(first), setup.end()}, rays, 0.1);
        }
}

TEST_CASE("a light 2^-61 above a tilted plane lights it with finite numbers", "[known]") {
    SceneBuilder builder;
    builder.add(Plane{{0, 0, 0}, {1, 2, 2}}, builder.add_material({}));
    builder.add_light({.position = {0, 0x1p-61F, 0}});
    builder.camera.from = {2, 3, 4};
    builder.camera.at = {0, 0, 0};
    builder.settings.width = builder.settings.height = 33; // odd: one pixel is under the light
    const Scene scene = builder.build();
    const core::Scene& inside = library::Internals::of(scene);
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
        const core::Film film = simd::render(inside, inside.settings(), {.engine = engine}).film;
        for (const core::Color& pixel : film.pixels())
            for (int axis = 0; axis < 3; ++axis)
                CHECK(std::isfinite(pixel[axis]));
    }
}

TEST_CASE("shapes of size 1e30 and 1e-30 are hit correctly in one scene", "[known]") {
    ray_sets::Random random(18);
    Shapes shapes = {core::Sphere{{0, 0, -1e30F}, 1e30F}, core::Plane{{0, 0, -1e29F}, {0, 0, 1}}};
    for (int i = 0; i < 30; ++i) {
        shapes.push_back(core::Sphere{rounded(1e-30 * random.cube(5.0)), 1e-30F});
        shapes.push_back(core::Sphere{rounded(1e30 * random.cube(0.5)), 1e29F});
        shapes.push_back(cube(rounded(random.cube(5.0)), 1.0F));
    }
    std::vector<Ray> rays;
    for (const double size : {1e-30, 1.0, 1e30})
        for (int i = 0; i < 100; ++i)
            rays.push_back({rounded(size * random.cube(0.9)), rounded(random.direction())});
    check(shapes, rays);
}

TEST_CASE("a ray in a plane of bounds hits the shapes that touch it", "[known]") {
    for (const float size : {1.0F, 0x1p20F, 0x1p60F, 0x1p-60F}) {
        CAPTURE(size);
        Shapes row;
        for (int i = 0; i < 30; ++i)
            row.push_back(core::Sphere{Vec3f(2.0F * static_cast<float>(i), -1, 0) * size, size});
        std::vector<Ray> rays;
        for (const float x : {-3.0F, 0.0F, 0.5F, 1e6F})
            for (const Vec3f& way : {Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(1, 0, 0.125F)})
                rays.push_back({Vec3f(x, 0, 0) * size, way});
        check(row, rays, 0.1);
        CHECK(answer(row, {Vec3f(-3, 0, 0) * size, {1, 0, 0}}).shape == 0);
        CHECK(answer(row, {Vec3f(100, 0, 0) * size, {-1, 0, 0}}).shape == 29);
    }
}

TEST_CASE("t_max limits rays from afar exactly", "[known]") {
    Shapes row;
    for (int i = 0; i < 30; ++i)
        row.push_back(core::Sphere{{3.0F * static_cast<float>(i), 0, 0}, 1});
    std::vector<Ray> rays;
    ray_sets::Random random(19);
    for (const double distance : {1e3, 1e5, 1e7, 1e10})
        for (int i = 0; i < 30; ++i) {
            const Vec3d to(3.0 * i, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const Vec3f origin = rounded(to + distance * random.direction());
            rays.push_back({origin, rounded(to - core::convert<double>(origin))});
        }
    check(row, rays);
}

TEST_CASE("spheres within 1e-6 are hit in order", "[known]") {
    ray_sets::Random random(20);
    Shapes shapes;
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i)
        shapes.push_back(core::Sphere{rounded(1e-6 * random.cube(1.0)), 2e-8F});
    for (int i = 0; i < 200; ++i) {
        const Vec3d from = (i % 2 == 0 ? 5.0 : 1e-6) * random.direction();
        rays.push_back({rounded(from), rounded(1e-6 * random.cube(1.0) - from)});
    }
    check(shapes, rays);
}

TEST_CASE("rays 1e-7 above a floor of triangles are answered correctly", "[known]") {
    ray_sets::Random random(21);
    Shapes shapes;
    constexpr int across = 32;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            const auto corner = [](int x, int z) {
                return Vec3f(static_cast<float>(x), 0, static_cast<float>(z));
            };
            shapes.push_back(core::Triangle{corner(i, j), corner(i, j + 1), corner(i + 1, j)});
            shapes.push_back(
                core::Triangle{corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)});
        }
    std::vector<Ray> rays;
    for (int i = 0; i < 60; ++i) {
        const double fall = i % 2 == 0 ? 0.0 : -random.log_uniform(1e-9, 1e-6);
        rays.push_back({rounded(Vec3d(-1.0, 1e-7, random.uniform(0.0, across))),
                        rounded(Vec3d(1.0, fall, random.uniform(-0.25, 0.25)))});
    }
    check(shapes, rays);
}

TEST_CASE("rays along the side of cylinders end to end are answered correctly", "[known]") {
    ray_sets::Random random(22);
    Shapes shapes;
    for (int i = 0; i < 300; ++i)
        shapes.push_back(core::OpenCylinder{{static_cast<float>(i), 0, 0}, {1, 0, 0}, 1});
    std::vector<Ray> rays;
    for (int i = 0; i < 40; ++i) {
        const double angle = random.uniform(0.0, 6.3), tilt = random.log_uniform(1e-12, 1e-3);
        const Vec3d on(0.0, std::cos(angle), std::sin(angle));
        rays.push_back({rounded(on - Vec3d(2.0, 0.0, 0.0)),
                        rounded(Vec3d(1.0, 0.0, 0.0) + tilt * random.direction())});
    }
    rays.push_back({{-2, 1, 0}, {1, 0, 0}}); // in the surface
    check(shapes, rays, 0.1);
}

TEST_CASE("a ray hits the first of a thousand identical spheres", "[known]") {
    ray_sets::Random random(23);
    const Shapes shapes(1000, core::Sphere{{0.1F, 0.2F, 0.3F}, 1.1F});
    std::vector<Ray> rays;
    for (int i = 0; i < 3; ++i)
        rays.push_back({rounded(random.cube(3.0)), rounded(-random.direction())});
    rays.push_back({{3, 0.25F, 0.5F}, {-1, 0, 0}});
    check(shapes, rays, 0.1);
    CHECK(answer(shapes, rays.back()).shape == 0);
}

/// Double arithmetic may start such rays past the nearest shape, and more shapes may be the nearest
/// than are listed at first.
TEST_CASE("a ray from afar hits the first of many shapes that it may hit", "[known]") {
    Shapes balls, cubes;
    for (int i = 0; i < 65; ++i)
        balls.push_back(core::Sphere{{0, 0, 0}, 1.0F + static_cast<float>(i) / 64.0F});
    for (int i = 0; i < 100; ++i)
        cubes.push_back(
            cube({1.5F * static_cast<float>(i % 10), 1.5F * static_cast<float>(i / 10), 0}));
    std::vector<Ray> at_balls, at_cubes;
    for (const float distance :
         {0x1p40F, 0x1p50F, 0x1p55F, 1e17F, 0x1p57F, 0x1p58F, 1e18F, 1e20F, 1e29F})
        for (const float aside : {0.0F, 0.25F, 2.5F}) {
            at_balls.push_back({{aside, 0, distance}, {0, 0, -1}});
            at_cubes.push_back({{2.5F, aside, distance}, {0, 0, -1}});
        }
    check(balls, at_balls, 0.1);
    check(cubes, at_cubes, 0.1);
}

TEST_CASE("ellipsoids of denormal size are hit", "[known]") {
    for (const float size : {0x1p-127F, 0x1p-138F, 0x1p-149F}) {
        const Shapes shapes = {
            core::Ellipsoid{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {size, 0, -size}}};
        CHECK(answer(shapes, {{0, 0, 4 * size}, {0, 0, -1}}).shape == 0);
        CHECK(answer(shapes, {{0, 0, 0}, {0, 1, 0}}).shape == 0);
    }
}

/// In float, the square of such a cone's width overflows along the ray.
TEST_CASE("a ray hits cones whose radii differ by a factor of 2^59", "[known]") {
    const Ray ray{{-4, -0x1.000006p+3F, 32768}, {12, 0x1.000018p+1F, -0x1.ffdcp+14F}};
    const core::OpenCone open{{0, -2, 5}, {8, -4, 4}, 3, 0x1.4p+59F};
    const core::OpenCone turned{{8, -6, 9}, {-8, 4, -4}, 0x1.4p+59F, 3};
    for (const core::OpenCone& cone : {open, turned}) {
        const Answer hit = answer({cone}, ray);
        CHECK(hit.shape == 0);
        CHECK(hit.t == 0x1.00300cp+0F);
        CHECK(hit.occluded);
    }
    CHECK(answer({core::CappedCone{open.base, open.axis, 3, open.top_radius}}, ray).entering);
}
