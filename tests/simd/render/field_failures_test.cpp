#include "tests/simd/render/field_failures.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sanitized.hpp"

#include <algorithm>

/// Failures reported of other renderers: shapes seen from far away, or along their axis.
using namespace field;
using ray_sets::Random;

namespace {

constexpr int pixels = tests::sanitized ? 48 : 96;
constexpr double visible = 0.01; // in brightness

/// Returns a scene of some shapes of chalk, under a sun.
template <class Shape>
Scene chalk_scene(FieldBuilder builder, const std::vector<Shape>& shapes, const Vec3f& sunlight,
                  float specular = 0.0F) {
    const MaterialIndex material = builder.add_material(chalk(specular));
    for (const Shape& shape : shapes)
        builder.add(shape, material);
    return builder.finish(sun_along(sunlight));
}

} // namespace

// Points on a sphere at x = 800,000 were rounded to 1/16, more than the offset that was to keep
// their shadow rays off the sphere: a dark ring inside its limb.
TEST_CASE("mmp/pbrt-v3 #265: a sphere 800000 units from the origin has no ring at its limb",
          "[long]") {
    shapes_in_double = GENERATE(false, true);
    const std::vector<Sphere> spheres = {{{800000, 0, 0}, 100}};
    const Scene scene =
        chalk_scene(square(pixels, perspective({796800, 0, 0}, {800000, 0, 0}, 4, {0, 0, 1})),
                    spheres, {1, 0, 0});
    check_right(compare(scene, spheres, {-1, 0, 0}), pixels * pixels / 2);
    CHECK(compare_textbook(scene, spheres, {-1, 0, 0}, 1e-3F).worst > visible);
}

// Intervals around a ray's origin in the sphere's own space, as wide as its rounding at 10,000
// units, made rays at the limb misses: 15 % of the sphere's edge was gone.
TEST_CASE("mmp/pbrt-v3 #44: a sphere 10000 units from the origin does not shrink", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const std::vector<Sphere> spheres = {{{10000, 10000, 10000}, 1}};
    const Scene scene =
        chalk_scene(square(pixels, perspective({10000, 10000, 10004}, {10000, 10000, 10000}, 35)),
                    spheres, {0, 0, -1});
    const Comparison ours = compare(scene, spheres, {0, 0, 1});
    check_right(ours, pixels * pixels / 3);

    int lost = 0;
    for_each_pixel(scene, [&](const Ray<double>& ray, const Color&) {
        using Interval = Bounded<double>;
        const double rounding = 3 * 0x1p-24 * 30000.0; // of the matrix product, gamma_3
        Vec3<Interval> f, d = convert<Interval>(ray.direction);
        for (int axis = 0; axis < 3; ++axis)
            f[axis] = {ray.origin[axis] - 10000.0, rounding};
        const Interval A = dot(d, d), B = dot(f, d), C = dot(f, f) - Interval(1.0);
        const Interval discriminant = B * B - A * C;
        const bool surely = discriminant.value - discriminant.error >= 0.0;
        lost += oracle::first_hit(spheres[0], ray).has_value() && !surely ? 1 : 0;
    });
    CHECK(lost > ours.hits / 20);
}

// From 1,000 units away b^2 and 4 a c agree in all but the last digits that float has, and t comes
// in steps: rings all over a unit sphere.
TEST_CASE("mitsuba3 #512: a unit sphere seen from 1000 units away has no rings", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const std::vector<Sphere> spheres = {{{0, 0, 0}, 1}};
    const Scene scene = chalk_scene(square(pixels, orthographic({0, 0, 1000}, {0, 0, 0}, 2.2F)),
                                    spheres, {0, 0, -1});
    check_right(compare(scene, spheres, {0, 0, 1}), pixels * pixels / 2);
    const Comparison textbook = compare_textbook(scene, spheres, {0, 0, 1}, 1e-3F);
    CHECK(textbook.wrong > 10);
    CHECK(textbook.worst > visible);
}

// Cones of about unit size, seen from far away: the solver lost its precision where the view was
// along their axes, in rings about the centre of projection.
TEST_CASE("NVIDIA/VisRTX #333: cones have no rings about the centre of projection", "[long]") {
    shapes_in_double = GENERATE(false, true);
    std::vector<CappedCone> cones;
    for (int i = 0; i < 9; ++i)
        cones.push_back({{static_cast<float>(i % 3) - 1.0F, static_cast<float>(i / 3) - 1.0F, 0},
                         {0, 0, 1},
                         0.45F,
                         0});
    const Scene scene =
        chalk_scene(square(pixels / 2, perspective({0.1F, 0.2F, 500}, {0.1F, 0.2F, 0}, 0.4F)),
                    cones, {0, 0, -1});
    check_right(compare(scene, cones, {0, 0, 1}), pixels * pixels / 16);
    const Comparison textbook = compare_textbook(scene, cones, {0, 0, 1}, 1e-3F);
    CHECK(textbook.wrong > 10);
    CHECK(textbook.worst > visible);
}

// Seen exactly along its axis, a cylinder was a bar and a circle: the wall's leading coefficient
// was only a rounding error.
TEST_CASE("NVIDIA/VisRTX #73: a cylinder seen along its axis is a disc", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const Vec3f base{-30.005F, -77.1061F, -16.8721F}, top{-30.005F, -27.301F, 16.8721F};
    const std::vector<CappedCylinder> cylinders = {{base, top - base, 2}};
    const Vec3f along{0, 0.827878F, 0.560908F};
    const Scene scene = chalk_scene(
        square(pixels, orthographic(base - 50.0F * along, base, 5, {1, 0, 0})), cylinders, along);
    const Vec3d to_light = -normalized(convert<double>(along));
    check_right(compare(scene, cylinders, to_light), pixels * pixels * 0.4);

    // Views along random axes. With the textbook's formulas, the axis leaves some cylinders before
    // it enters.
    Random random(73);
    int wrong = 0, lost = 0;
    constexpr int views = 40;
    for (int view = 0; view < views; ++view) {
        const Vec3f axis = convert<float>(5.0 * random.direction());
        const std::vector<CappedCylinder> turned = {{base, axis, 2}};
        const Scene seen = chalk_scene(
            square(12, orthographic(base - 10.0F * axis, base, 5, {0.1F, 1, 0.2F})), turned, axis);
        wrong += compare(seen, turned, -normalized(convert<double>(axis))).wrong;

        const float height = length(axis);
        const Vec3f a = axis / height, f = base - 10.0F * axis - base + Vec3f(0.5F, 0.25F, 0);
        const auto wall = textbook_roots(dot(a, a) - dot(a, a) * dot(a, a),
                                         2.0F * (dot(f, a) - dot(f, a) * dot(a, a)),
                                         dot(f, f) - dot(f, a) * dot(f, a) - 4.0F);
        const float enters = -dot(f, a), leaves = height - dot(f, a);
        const bool hit = wall && std::max(enters, wall->first) <= std::min(leaves, wall->second);
        lost += hit ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(lost > 1);
}

// The two halves of a bond flickered against each other as the camera moved.
TEST_CASE("NVIDIA/VisRTX #54: two halves of a cylinder are as bright as the whole", "[long]") {
    shapes_in_double = GENERATE(false, true);
    const OpenCylinder cylinder = {{-3, -1, -2}, {6, 2.5F, 4}, 0.2F};
    const std::vector<OpenCylinder> halves = {{{-3, -1, -2}, {3, 1.25F, 2}, 0.2F},
                                              {{0, 0.25F, 0}, {3, 1.25F, 2}, 0.2F}};
    double textbook = 0.0;
    for (int view = 0; view < 3; ++view) {
        const float angle = 0.3F + 0.4F * static_cast<float>(view);
        const Vec3f from{400.0F * std::sin(angle), 30.0F, 400.0F * std::cos(angle)};
        const FieldBuilder builder = square(pixels, perspective(from, {0, 0, 0}, 1));
        const Scene two = chalk_scene(builder, halves, -from);
        const Vec3d to_light = normalized(convert<double>(from));
        CAPTURE(view);
        check_right(compare(two, halves, to_light), pixels / 2);
        textbook = std::max(textbook, compare_textbook(two, halves, to_light, 1e-3F).worst);

        const Film by_halves = drawn(two);
        const Film at_once = drawn(chalk_scene(builder, std::vector{cylinder}, -from));
        int different = 0;
        for (std::size_t i = 0; i < by_halves.pixels().size(); ++i)
            different += std::abs(by_halves.pixels()[i].x - at_once.pixels()[i].x) > 1e-6F ? 1 : 0;
        CHECK(different == 0);
    }
    CHECK(textbook > visible);
}

// Curves replaced cylinders and cones and put balls on their ends. Molecules need no balls there
// and no triangles.
TEST_CASE("RenderKit/ospray #421: bonds and arrows have no balls on their ends", "[long]") {
    shapes_in_double = GENERATE(false, true);
    std::vector<OpenCylinder> bonds;
    std::vector<OpenCone> arrows;
    int beyond = 0;
    for (int i = 0; i < 6; ++i) {
        const float angle = 1.1F * static_cast<float>(i);
        const Vec3f out{std::cos(angle), std::sin(angle), 0.4F};
        bonds.push_back({0.3F * out, out, 0.12F});
        arrows.push_back({1.3F * out, 0.4F * out, 0.2F, 0});
    }
    FieldBuilder builder = square(pixels, orthographic({0, 0, 20}, {0, 0, 0}, 4));
    const MaterialIndex white = builder.add_material(luminous());
    for (int i = 0; i < 6; ++i) {
        builder.add(bonds[static_cast<std::size_t>(i)], white);
        builder.add(arrows[static_cast<std::size_t>(i)], white);
    }
    int hits = 0, wrong = 0;
    for_each_pixel(builder.finish(), [&](const Ray<double>& ray, const Color& color) {
        const auto hit_of = [&](const auto& shape) {
            return oracle::first_hit(shape, ray).has_value();
        };
        const bool hit = std::any_of(bonds.begin(), bonds.end(), hit_of) ||
                         std::any_of(arrows.begin(), arrows.end(), hit_of);
        hits += hit ? 1 : 0;
        wrong += hit != (color.x > 0.5F) ? 1 : 0;
        const bool on_ball = std::any_of(bonds.begin(), bonds.end(), [&](const auto& bond) {
            return hit_of(Sphere{bond.base, bond.radius});
        });
        beyond += on_ball && !hit ? 1 : 0;
    });
    CHECK(hits > pixels * pixels / 20);
    CHECK(wrong == 0);
    CHECK(beyond > 10); // the difference is visible
}
