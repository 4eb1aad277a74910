#include "core/optics/optics.hpp"
#include "tests/simd/render/field_failures.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sanitized.hpp"

/// Failures reported of other renderers: rays that hit the surface that they leave, or skip
/// surfaces close to it, as their offset suits one scale only.
using namespace field;
using ray_sets::Random;

namespace {

constexpr int pixels = tests::sanitized ? 48 : 96;

} // namespace

// Rays that left a cone or a paraboloid met it again, and its tests were switched off.
TEST_CASE("mmp/pbrt-v3 #44: reflected rays do not meet their cone or paraboloid again", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const Vec3f center{1000, 2000, -3000};
    const CappedCone cone{center, {0, 0, 1}, 1, 0};
    const Quadric paraboloid{center, 1, 1, 0, 0, 0, 0, 0, 0, 0.5F, -1, {-1, -1, 0}, {1, 1, 1}};
    const auto room = [&](const auto& shape) {
        FieldBuilder builder =
            square(pixels, perspective(center + Vec3f(1.5F, 1, 8), center + Vec3f(0, 0, 0.5F), 20));
        builder.add_shape(shape, mirror());
        return builder;
    };
    CHECK(count_not_white(in_white_room(room(cone), 1)) == 0);
    CHECK(count_not_white(in_white_room(room(paraboloid), 1)) == 0);
    CHECK(count_not_white(in_white_room(room(paraboloid), 0)) > pixels);
    CHECK(textbook_self_hits(room(cone).finish(), cone, 0.0F) > pixels);
    CHECK(textbook_self_hits(room(cone).finish(), cone, 1e-4F) > 10);
}

namespace {

/// Returns the coordinate x at which a ray through a glass ball meets the plane z = `plane`, by
/// Snell's law. At both crossings, the ray is moved across the surface by `offset`.
double reached_through_ball(const Sphere& ball, double index, double plane, Ray<double> ray,
                            double offset) {
    const Vec3d center = convert<double>(ball.center);
    const double radius = static_cast<double>(ball.radius);
    for (const bool entering : {true, false}) {
        const Vec3d f = ray.origin - center;
        const double b = dot(f, ray.direction);
        const double root = std::sqrt(std::max(0.0, b * b - squared_length(f) + radius * radius));
        const double t = entering ? -b - root : -b + root;
        const Vec3d point = ray.origin + t * ray.direction;
        const Vec3d normal = normalized(Vec3d(point - center)) * (entering ? 1.0 : -1.0);
        const double ratio = entering ? 1.0 / index : index;
        const double cos = -dot(normal, ray.direction);
        const Vec3d along = ratio * (ray.direction + cos * normal);
        ray.direction = along - std::sqrt(1.0 - squared_length(along)) * normal;
        ray.origin = point - offset * normal;
    }
    return ray.origin.x + (plane - ray.origin.z) / ray.direction.z * ray.direction.x;
}

} // namespace

// Rays into a lens were moved along its normal by an epsilon that grows with the coordinates: half
// a unit at z = -5400, and the image behind the lens shifted.
TEST_CASE("mitsuba3 #219: a lens at large coordinates bends rays where they hit it", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const Sphere ball{{278, 273, -5400}, 250};
    constexpr double plane = -7000, width = 4096;
    FieldBuilder builder = square(pixels, perspective({278, 273, -4000}, {278, 273, -5400}, 12));
    builder.add_shape(ball, glass(1.5F));
    builder.add_shape(Plane{{0, 0, plane}, {0, 0, 1}}, ruler({width, 0, 0}));
    int compared = 0;
    double worst = 0.0, worst_moved = 0.0;
    for_each_pixel(builder.finish(), [&](const Ray<double>& ray, const Color& color) {
        const double expected = reached_through_ball(ball, 1.5, plane, ray, 0.0);
        if (!(expected > 0.0 && expected < width)) return;
        ++compared;
        worst = std::max(worst, std::abs(static_cast<double>(color.x) * width - expected));
        const double moved = reached_through_ball(ball, 1.5, plane, ray, 1500 * 0x1p-24 * 5401);
        worst_moved = std::max(worst_moved, std::abs(moved - expected));
    });
    CHECK(compared > pixels * pixels / 3);
    CHECK(worst < 1e-3); // float's ulp of the colour is 2.4e-4 of this ruler
    CHECK(worst_moved > 0.1);
}

// The offset, 9e-5 and more, was wider than the gap between the glass and the inner sphere: rays
// began inside the inner sphere, and light leaked.
TEST_CASE("mitsuba3 #1871: a shell of 4e-5 about a sphere leaks no light", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const Sphere inner{{0, 0, 0}, 1}, outer{{0, 0, 0}, 1.0F + 4e-5F};
    FieldBuilder builder = square(pixels, perspective({0, 0, 5}, {0, 0, 0}, 26));
    Material red = luminous({1, 0, 0});
    red.visible = Visible::outside;
    builder.background = {0, 0, 1};
    builder.add_shape(inner, red);
    builder.add_shape(outer, glass(1.5F));
    int hits = 0, wrong = 0, leaks = 0;
    // Glass of 1.5 bends all rays that enter, so that they come within 1 / 1.5 of the centre.
    for_each_pixel(builder.finish(), [&](const Ray<double>& ray, const Color& color) {
        const auto seen = first_seen(std::vector{outer}, ray);
        hits += seen ? 1 : 0;
        wrong += color != (seen ? Color(1, 0, 0) : Color(0, 0, 1)) ? 1 : 0;
        if (!seen) return;
        const auto refraction = refract(ray.direction, seen->normal, 1.0, 1.5);
        const Vec3d moved = seen->point - 2.0 * 1500 * 0x1p-24 * seen->normal;
        const auto next = oracle::first_hit(inner, Ray<double>{moved, refraction.transmitted});
        leaks += next && next->entering ? 0 : 1;
    });
    CHECK(hits > pixels * pixels / 2);
    CHECK(wrong == 0);
    CHECK(leaks == hits);
}

// Some of the rays that left a sphere the size of a pea hit it again.
TEST_CASE("mitsuba3 #1236: rays that leave a small sphere do not hit it", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const Sphere sphere{{0, 0.083F, 0.4F}, 0.015F};
    FieldBuilder builder = square(pixels, perspective({0.05F, 0.1F, 0.6F}, {0, 0.083F, 0.4F}, 9));
    const Camera camera = builder.camera;
    builder.add_shape(sphere, chalk());
    // Outgoing rays in all directions, as shadow rays.
    Random random(1236);
    std::vector<Vec3f> to_suns;
    for (int i = 0; i < 64; ++i) {
        to_suns.push_back(convert<float>(random.direction()));
        Light sun = sun_along(-to_suns.back());
        sun.color = Color(1.0F / 64.0F);
        builder.add_light(sun);
    }
    int hits = 0, wrong = 0, textbook = 0;
    double worst = 0.0;
    for_each_pixel(std::move(builder).build(), [&](const Ray<double>& ray, const Color& color) {
        const auto seen = first_seen(std::vector{sphere}, ray);
        hits += seen ? 1 : 0;
        wrong += seen.has_value() != (color.x > 0.2F) ? 1 : 0;
        if (!seen) return;
        double expected = 0.25;
        const Ray<float> in_float = rounded(ray);
        const auto t = textbook_hit(sphere, in_float, 0.0F);
        for (const Vec3f& to_sun : to_suns) {
            const Vec3d unit = normalized(convert<double>(to_sun));
            const double cos = dot(seen->normal, unit);
            expected += 0.5 / 64.0 * std::max(cos, 0.0);
            if (!t || !(cos > 0.001)) continue;
            const Vec3f point = in_float.origin + *t * in_float.direction;
            textbook += textbook_hit(sphere, {point, convert<float>(unit)}, 0.0F) ? 1 : 0;
        }
        worst = std::max(worst, std::abs(static_cast<double>(color.x) - expected));
    });
    CHECK(hits > pixels * pixels / 3);
    CHECK(wrong == 0);
    CHECK(worst < invisible);
    CHECK(textbook > 100);

    FieldBuilder room = square(pixels, camera);
    room.add_shape(sphere, mirror());
    CHECK(count_not_white(in_white_room(room, 1)) == 0);
}

// For radii below 1 the smallest t of a cylinder was larger than the cylinder: 1.44 at 0.5. Its
// inside could not be seen.
TEST_CASE("RenderKit/ospray #279: the inside of a thin cylinder is seen", "[long]") {
    shapes_in_double = GENERATE(false, true);
    for (const float radius : {0.5F, 1e-3F}) {
        const std::vector<OpenCylinder> pipes = {
            {{0, 0, 0}, {0, 0.6F * radius, 3 * radius}, radius}};
        FieldBuilder builder = square(pixels, perspective({0.2F * radius, 0.1F * radius, radius},
                                                          {0, 0.3F * radius, 2 * radius}, 100));
        builder.add_shape(pipes[0], chalk());
        const Scene scene = builder.finish(sun_along({1, 0, 0}));
        CAPTURE(radius);
        int hits = 0, wrong = 0, lost = 0;
        const float epsilon = -1.0F / std::log(radius < 0.1F ? 0.5F : radius); // 1.44
        for_each_pixel(scene, [&](const Ray<double>& ray, const Color& color) {
            const bool hit = oracle::first_hit(pipes[0], ray).has_value();
            hits += hit ? 1 : 0;
            wrong += hit != (color.x > 0.2F) ? 1 : 0;
            lost += hit && !textbook_hit(pipes[0], rounded(ray), epsilon) ? 1 : 0;
        });
        CHECK(hits > pixels * pixels / 3);
        CHECK(wrong == 0);
        CHECK(lost > hits / 2);
    }
}

// Surfaces behind a transparent box were lost (black) if they were nearer than the smallest t that
// counts.
TEST_CASE("POV-Ray #125: a plane 7e-7 below a transparent box is seen through it", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const float depth = -1.0000007F;
    FieldBuilder builder = square(pixels, perspective({1, 2, 3}, {0, 0, 0}, 50));
    builder.add_shape(Box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, glass(1.0F));
    builder.add_shape(Plane{{0, depth, 0}, {0, 1, 0}}, luminous());
    int through_floor = 0, wrong = 0, lost = 0;
    const Box box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    for_each_pixel(builder.finish(), [&](const Ray<double>& ray, const Color& color) {
        wrong += color != (ray.direction.y < 0.0 ? Color(1.0F) : Color(0.0F)) ? 1 : 0;
        std::uint64_t widened = 0;
        for (const Crossing<double>& crossing : solve(box, ray, Start{}, widened)) {
            if (crossing.entering || crossing.face != 2) continue;
            ++through_floor;
            const double rest = (static_cast<double>(depth) + 1.0) / ray.direction.y;
            lost += rest < 1e-6 ? 1 : 0; // POV-Ray 3.6's limit
        }
    });
    CHECK(wrong == 0);
    CHECK(through_floor > pixels);
    CHECK(lost > through_floor / 4);
}

// A layer of plastic balls had dark rings; the advice was to enlarge the epsilon, or the scene.
TEST_CASE("plotoptix #4: a layer of small plastic spheres has no dark rings", "[long]") {
    shapes_in_double = GENERATE(false, true);
    std::vector<Sphere> spheres;
    for (int i = 0; i < 16; ++i)
        spheres.push_back({{0.02F * static_cast<float>(i % 4), 0.001F * static_cast<float>(i % 3),
                            0.02F * static_cast<float>(i / 4)},
                           0.01F});
    const Vec3f at{0.03F, 0, 0.03F}, from{3.03F, 4, 5.03F};
    const FieldBuilder empty = square(pixels, orthographic(from, at, 0.1F));
    // The sun is where the viewer is, so that everything visible is lit.
    const Vec3d to_light = normalized(convert<double>(Vec3f(from - at)));
    const auto scene_of = [&](float specular) {
        FieldBuilder builder = empty;
        const MaterialIndex material = builder.add_material(chalk(specular));
        for (const Sphere& sphere : spheres)
            builder.add(sphere, material);
        return builder.finish(sun_along(at - from));
    };
    check_right(compare(scene_of(0.5F), spheres, to_light, 0.5), pixels * pixels / 4);
    CHECK(compare_textbook(scene_of(0.0F), spheres, to_light, 1e-5F).worst > 0.05);
}
