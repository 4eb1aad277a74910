#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

using namespace little_scene;

namespace {

constexpr double exactly = 1e-13;

Light point_light(const Vec3f& position) {
    return {.position = position};
}

/// Returns a material that reflects half of the light that falls on it at a right angle, and no
/// ambient light.
Material matte() {
    Material material = luminous();
    material.ambient = 0.0F;
    material.diffuse = 0.5F;
    return material;
}

/// Returns the colour at the origin of a matte floor that is lit from (0, `light_height`, 0), with
/// a shape above it.
template <class Shape>
Vec3d floor_below(const Shape& shape, const Material& material, float light_height = 10.0F) {
    Builder builder;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, matte());
    builder.add_shape(shape, material);
    const Scene scene = builder.finish(point_light({0, light_height, 0}));
    return color_along<double>(scene, {0.5, 0.5, 0}, {-0.5, -0.5, 0});
}

/// Returns a scene that is lit from both sides of the plane y = 0.
Scene between_lights(const SmoothTriangle& triangle) {
    Builder builder;
    builder.add_shape(triangle, matte());
    builder.add_light(point_light({0, -10, 0}));
    return builder.finish(point_light({0, 10, 0}));
}

} // namespace

TEST_CASE("diffuse light falls with the cosine and not with the distance") {
    Builder builder;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, matte());
    const Scene scene = builder.finish(point_light({3, 4, 0}));
    CHECK(gray_along(scene, {0, 1, 0}, {0, -1, 0}) == Approx(0.5 * 0.8).epsilon(exactly));
    CHECK(gray_along(scene, {3, 1, 0}, {0, -1, 0}) == Approx(0.5).epsilon(exactly));
    // From below, the light is behind the surface.
    CHECK(gray_along(scene, {0, -1, 0}, {0, 1, 0}) == 0.0);
}

TEST_CASE("a highlight follows Blinn's model") {
    Material shiny = black();
    shiny.specular = 0.5F;
    shiny.exponent = 8.0F;
    Builder builder;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, shiny);
    const Scene scene = builder.finish(point_light({3, 4, 0}));
    // Straight from above, halfway to (0.6, 0.8, 0): cos^2 of half the angle is (1 + 0.8) / 2.
    CHECK(gray_along(scene, {0, 1, 0}, {0, -1, 0}) ==
          Approx(0.5 * std::pow(0.9, 4.0)).epsilon(exactly));
}

TEST_CASE("lights add up and directional lights have no place") {
    Builder builder;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, matte());
    builder.add_light(point_light({0, 1, 0}));
    const Light sun{
        .kind = LightKind::directional, .direction = {-3, -4, 0}, .color = {0.25F, 0.5F, 0.75F}};
    const Scene scene = builder.finish(sun);
    const Vec3d color = color_along<double>(scene, {0, 1, 0}, {0, -1, 0});
    CHECK(color.x == Approx(0.5 * (1.0 + 0.25 * 0.8)).epsilon(exactly));
    CHECK(color.z == Approx(0.5 * (1.0 + 0.75 * 0.8)).epsilon(exactly));
}

TEST_CASE("an opaque shape in front of a light casts a shadow") {
    const Sphere sphere{{0, 5, 0}, 1};
    CHECK(floor_below(sphere, black()).x == 0.0);
    CHECK(floor_below(sphere, black(), 3.0F).x == Approx(0.5).epsilon(exactly));
    CHECK(floor_below(Sphere{{5, 5, 0}, 1}, black()).x == Approx(0.5).epsilon(exactly));
    CHECK(floor_below(Disc{{0, 5, 0}, {0, 1, 0}, 1}, black()).x == 0.0);
    CHECK(floor_below(Disc{{0, 5, 0}, {0, -1, 0}, 1}, black()).x == 0.0);
}

TEST_CASE("light in a transmissive body's shadow is attenuated as light through it") {
    const Box slab{{-1, 4, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    CHECK(floor_below(slab, glass(1.5F)).x == Approx(0.5).epsilon(exactly));

    Material dim = glass(1.5F);
    dim.transmission = 0.5F;
    CHECK(floor_below(slab, dim).x == Approx(0.5 * 0.25).epsilon(exactly));

    Material tinted = glass(1.0F);
    tinted.absorption = {0.125F, 0.5F, 0.0F};
    const Vec3d color = floor_below(slab, tinted);
    CHECK(color.x == Approx(0.5 * std::exp(-0.25)).epsilon(exactly));
    CHECK(color.y == Approx(0.5 * std::exp(-1.0)).epsilon(exactly));
    CHECK(color.z == Approx(0.5).epsilon(exactly));

    for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric})
        CHECK(floor_below(slab, glass(1.5F, reflection)).x == Approx(0.5 * 0.96 * 0.96));
    // The light is inside.
    CHECK(floor_below(slab, tinted, 5.0F).y == Approx(0.5 * std::exp(-0.5)).epsilon(exactly));
}

TEST_CASE("the glass that a shadow ray crosses reflects by the angle outside of it") {
    // Light from (3, 4, 0) through a slab; its straight line has a cosine of 0.8 there.
    const double n = 1.5, cosine = 0.8, cosine_inside = std::sqrt(1.0 - 0.36 / (n * n));
    const auto square = [](double a) { return a * a; };
    const double perpendicular =
        square((cosine - n * cosine_inside) / (cosine + n * cosine_inside));
    const double parallel = square((cosine_inside - n * cosine) / (cosine_inside + n * cosine));
    const double dielectric = (perpendicular + parallel) / 2.0;
    const double schlick = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
    const auto seen = [](Reflection reflection) {
        Builder builder;
        builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, matte());
        builder.add_shape(Box{{-9, 1, -9}, {18, 0, 0}, {0, 1, 0}, {0, 0, 18}},
                          glass(1.5F, reflection));
        return gray_along(builder.finish(point_light({3, 4, 0})), {0.5, 0.5, 0}, {-0.5, -0.5, 0});
    };
    CHECK(seen(Reflection::schlick) == Approx(0.5 * 0.8 * square(1.0 - schlick)));
    CHECK(seen(Reflection::dielectric) == Approx(0.5 * 0.8 * square(1.0 - dielectric)));
}

TEST_CASE("light passes from body to touching body without a gap") {
    // Two bodies of one index are one: only its ends reflect. At their common face, t is rounded.
    const auto seen = [](bool in_two) {
        Builder builder;
        builder.add_shape(Plane{{0, 0.1F, 0}, {0, 1, 0}}, matte());
        const Material material = glass(1.5F, Reflection::dielectric);
        const auto slab = [&](float low, float height, float width) {
            builder.add_shape(Box{{-9, low, -9}, {width, 0, 0}, {0, height, 0}, {0, 0, width}},
                              material);
        };
        if (in_two) {
            slab(1.0F, 1.0F, 18.3F);
            slab(2.0F, 2.0F, 17.7F);
        } else {
            slab(1.0F, 3.0F, 18.0F);
        }
        const Scene scene = builder.finish(point_light({0.7F, 10, 0.3F}));
        std::vector<double> grays;
        for (int i = 0; i < 100; ++i)
            grays.push_back(gray_along(scene, {0.061 * i, 0.5, 0.037 * i}, {0.1, -0.5, 0.2}));
        return grays;
    };
    const std::vector<double> one = seen(false), two = seen(true);
    for (std::size_t i = 0; i < one.size(); ++i)
        REQUIRE(two[i] == Approx(one[i]).epsilon(1e-9));
}

TEST_CASE("a one-sided surface does not exist for rays to its other side") {
    Material outside_only = luminous();
    outside_only.visible = Visible::outside;
    Material inside_only = luminous();
    inside_only.visible = Visible::inside;
    const auto seen = [](const Material& material, const Vec3d& origin) {
        Builder builder;
        builder.add_shape(Sphere{{0, 0, 0}, 1}, material);
        return gray_along(builder.finish(), origin, {0, 0, -1});
    };
    CHECK(seen(outside_only, {0, 0, 5}) == 1.0);
    CHECK(seen(outside_only, {0, 0, 0}) == 0.0);
    CHECK(seen(inside_only, {0, 0, 5}) == 1.0); // the far wall
    CHECK(seen(inside_only, {0, 0, 0}) == 1.0);

    const Disc disc{{0, 5, 0}, {0, 1, 0}, 1};
    outside_only.ambient = inside_only.ambient = 0.0F;
    CHECK(floor_below(disc, outside_only).x == Approx(0.5).epsilon(exactly));
    CHECK(floor_below(disc, inside_only).x == 0.0);
}

TEST_CASE("paths end at the depth limit or where their weight is small") {
    const auto between_mirrors = [](int max_depth, float min_weight) {
        Material half = mirror(0.5F);
        half.ambient = 1.0F;
        half.pattern.colors[0] = Color(1.0F);
        Builder builder;
        builder.settings.max_depth = max_depth;
        builder.settings.min_weight = min_weight;
        builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, half);
        builder.add_shape(Plane{{0, 0, 1}, {0, 0, -1}}, half);
        return gray_along(builder.finish(), {0, 0, 0.5}, {0.25, 0.5, -1});
    };
    CHECK(between_mirrors(0, 0.0F) == 1.0);
    CHECK(between_mirrors(1, 0.0F) == 1.5);
    CHECK(between_mirrors(5, 0.0F) == 1.96875);
    CHECK(between_mirrors(100, 0.125F) == 1.875); // the weight 1/8 still counts
    CHECK(between_mirrors(100, 0.126F) == 1.75);
}

TEST_CASE("fog is absent at its first plane and complete at its second") {
    const auto seen = [](float z, FogKind kind, double from_z) {
        Builder builder;
        builder.fog = {kind, {0.0F, 0.0F, 1.0F}, 4.0F, 8.0F, 0.25F};
        builder.background = {0.0F, 1.0F, 0.0F};
        builder.add_shape(Disc{{0, 0, z}, {0, 0, 1}, 1}, luminous({1.0F, 0.0F, 0.0F}));
        return color_along<double>(builder.finish(), {0, 0, from_z}, {0, 0, -1});
    };
    const auto mixed = [](double f) { return Vec3d(1.0 - f, 0.0, f); };
    // Fog by world z, wherever the ray starts.
    CHECK(seen(4.0F, FogKind::linear_z, 20.0) == mixed(0.0));
    CHECK(seen(3.0F, FogKind::linear_z, 20.0) == mixed(0.0));
    CHECK(seen(5.0F, FogKind::linear_z, 20.0) == mixed(0.25));
    CHECK(seen(8.0F, FogKind::linear_z, 9.0) == mixed(1.0));
    CHECK(seen(9.0F, FogKind::linear_z, 20.0) == mixed(1.0));
    // Fog by distance.
    CHECK(seen(0.0F, FogKind::linear, 3.0) == mixed(0.0));
    CHECK(seen(0.0F, FogKind::linear, 4.0) == mixed(0.0));
    CHECK(seen(0.0F, FogKind::linear, 6.0) == mixed(0.5));
    CHECK(seen(0.0F, FogKind::linear, 8.0) == mixed(1.0));
    CHECK(seen(0.0F, FogKind::linear, 20.0) == mixed(1.0));
    CHECK(seen(0.0F, FogKind::exponential, 4.0).z == Approx(1.0 - std::exp(-1.0)));
    // A ray that hits nothing ends infinitely far away.
    const auto missed = [&](FogKind kind, float start, float end) {
        Builder builder;
        builder.fog = {kind, {0.0F, 0.0F, 1.0F}, start, end, 0.25F};
        builder.background = {0.0F, 1.0F, 0.0F};
        return color_along<double>(builder.finish(), {0, 0, 0}, {0, 0, -1});
    };
    CHECK(missed(FogKind::linear_z, 4.0F, 8.0F) == Vec3d(0, 1, 0));
    CHECK(missed(FogKind::linear_z, -4.0F, -8.0F) == Vec3d(0, 0, 1));
    CHECK(missed(FogKind::linear, 4.0F, 8.0F) == Vec3d(0, 0, 1));
    CHECK(missed(FogKind::exponential, 4.0F, 8.0F) == Vec3d(0, 0, 1));
    CHECK(missed(FogKind::none, 4.0F, 8.0F) == Vec3d(0, 1, 0));
}

TEST_CASE("a level ray through fog by height has the fog of its height") {
    const auto missed = [](double z) {
        Builder builder;
        builder.fog = {FogKind::linear_z, {0.0F, 0.0F, 1.0F}, 4.0F, 8.0F, 0.0F};
        builder.background = {1.0F, 0.0F, 0.0F};
        return color_along<double>(builder.finish(), {0, 0, z}, {1, 0, 0});
    };
    CHECK(missed(3.0) == Vec3d(1, 0, 0));
    CHECK(missed(5.0) == Vec3d(0.75, 0, 0.25));
    CHECK(missed(9.0) == Vec3d(0, 0, 1));
}

TEST_CASE("a path ends behind fog that takes its weight") {
    const auto seen = [](float min_weight) {
        Builder builder;
        builder.fog = {FogKind::linear, Color(0.0F), 0.0F, 8.0F, 0.0F};
        builder.settings.min_weight = min_weight;
        builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, mirror());
        builder.add_shape(Plane{{0, 0, 6}, {0, 0, -1}}, luminous());
        return gray_along(builder.finish(), {0, 0, 4}, {0, 0, -1});
    };
    CHECK(seen(0.5F) == 0.5 * 0.25);
    CHECK(seen(0.51F) == 0.0);
}

TEST_CASE("fog covers reflected rays segment by segment") {
    Builder builder;
    builder.fog = {FogKind::linear, {0.0F, 0.0F, 1.0F}, 0.0F, 8.0F, 0.0F};
    builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, mirror());
    builder.add_shape(Plane{{0, 0, 4}, {0, 0, -1}}, luminous({1.0F, 0.0F, 0.0F}));
    // Over the 2 to the mirror, fog covers a quarter; over the 4 back, half of the rest.
    CHECK(color_along<double>(builder.finish(), {0, 0, 2}, {0, 0, -1}) ==
          Vec3d(0.75 * 0.5, 0.0, 0.75 * 0.5 + 0.25));
}

TEMPLATE_TEST_CASE("a ray that leaves a surface does not meet it again", "", float, double) {
    using Real = TestType;
    // A single luminous mirror: any self-hit would add to its colour. Spheres are small or far from
    // the origin, where an epsilon fails (mitsuba3 #1236, #219).
    Material shine = mirror();
    shine.ambient = 1.0F;
    shine.pattern.colors[0] = Color(1.0F);
    for (const float scale : {1e-3F, 1.0F, 1e4F})
        for (const float offset : {0.0F, 1e3F}) {
            const Vec3f center = Vec3f(offset * scale);
            Builder builder;
            builder.add_shape(Sphere{center, scale}, shine);
            const Scene scene = builder.finish();
            ReferenceTracer<Real> tracer(scene, scene.settings());
            int hits = 0;
            for (int i = 0; i < 400; ++i) {
                const Real x = Real(scale) * (Real(i) / Real(200) - Real(1));
                const Vec3<Real> origin =
                    convert<Real>(center) + Vec3<Real>(x, 0, Real(9) * Real(scale));
                const Vec3<Real> color = tracer.trace({origin, {0, 0, -1}});
                hits += color.x > Real(0) ? 1 : 0;
                REQUIRE((color.x == Real(0) || color.x == Real(1)));
            }
            CHECK(hits > 390);
        }
}

TEST_CASE("a thin shell does not leak or darken") {
    // mitsuba3 #1871: spheres of radius 1 and 1 + 4e-5, where a ray epsilon skips the gap.
    const auto seen = [](bool with_shell, double x) {
        Builder builder;
        builder.add_shape(Sphere{{0, 0, 0}, 1}, matte());
        if (with_shell) builder.add_shape(Sphere{{0, 0, 0}, 1.00004F}, glass(1.0F));
        return gray_along(builder.finish(point_light({3, 4, 12})), {x, 0, 5}, {0, 0, -1});
    };
    for (int i = 0; i < 100; ++i)
        CHECK(seen(true, 0.00999 * i) == Approx(seen(false, 0.00999 * i)).epsilon(1e-9));
}

TEST_CASE("smooth triangles shade by their corners' normals from both sides") {
    const Scene scene =
        between_lights({{-1, 0, -1}, {-1, 0, 3}, {3, 0, -1}, {0, 1, 1}, {0, 1, 1}, {0, 1, 1}});
    const double slanted = 0.5 * std::sqrt(0.5);
    CHECK(gray_along(scene, {0, 1, 0}, {0, -1, 0}) == Approx(slanted).epsilon(exactly));
    CHECK(gray_along(scene, {0, -1, 0}, {0, 1, 0}) == Approx(slanted).epsilon(exactly));
}

TEST_CASE("a light behind a smooth triangle does not shine on it for any normals") {
    // The normals lean so far that they face a light below the flat surface.
    const SmoothTriangle triangle{{-1, 0, -1}, {-1, 0, 3}, {3, 0, -1},
                                  {3, 1, 0},   {3, 1, 0},  {3, 1, 0}};
    Builder builder;
    builder.add_shape(triangle, matte());
    const Scene scene = builder.finish(point_light({10, -1, 0}));
    CHECK(gray_along(scene, {0, 1, 0}, {0, -1, 0}) == 0.0);
}

TEST_CASE("normals that point to a smooth triangle's back are turned to its front") {
    const Scene scene = between_lights(
        {{-1, 0, -1}, {-1, 0, 3}, {3, 0, -1}, {0, -1, -1}, {0, -1, -1}, {0, -1, -1}});
    const double slanted = 0.5 * std::sqrt(0.5);
    CHECK(gray_along(scene, {0, 1, 0}, {0, -1, 0}) == Approx(slanted).epsilon(exactly));
    CHECK(gray_along(scene, {0, -1, 0}, {0, 1, 0}) == Approx(slanted).epsilon(exactly));
}

TEST_CASE("a slanted normal sends no ray to the wrong side of the surface") {
    const Vec3f slanted{-4, 1, 0};
    const SmoothTriangle triangle{{-5, 0, -5}, {-5, 0, 15}, {15, 0, -5}, slanted, slanted, slanted};
    const auto seen = [&](const Material& material, const Plane& red, const Plane& blue,
                          const Vec3d& direction) {
        Builder builder;
        builder.add_shape(triangle, material);
        builder.add_shape(red, luminous({1, 0, 0}));
        builder.add_shape(blue, luminous({0, 0, 1}));
        return color_along<double>(builder.finish(), -0.1 * direction, direction);
    };
    const Vec3d red(1, 0, 0);
    // With the slanted normal, the mirror would show the plane below it.
    CHECK(seen(mirror(), {{0, 5, 0}, {0, -1, 0}}, {{0, -5, 0}, {0, 1, 0}}, {-0.5, -1, 0}) == red);
    // With the slanted normal, the light would be bent up, to the right. With the flat one, it is
    // reflected totally, to the left.
    CHECK(seen(glass(0.25F), {{-3, 0, 0}, {1, 0, 0}}, {{3, 0, 0}, {-1, 0, 0}}, {1, -0.125, 0}) ==
          red);
}

TEST_CASE("a ray that leaves a part of a polygon does not meet another part of it") {
    // Rounded corners make the polygon a valley: the right half is in the way of rays from the left
    // half.
    const Triangle left{{0, 0, -1}, {0, 0, 1}, {-1, 0, 0}},
        right{{0, 0, -1}, {1, 1e-6F, 0}, {0, 0, 1}};
    Material shine = mirror();
    shine.ambient = 1.0F;
    shine.pattern.colors[0] = Color(1.0F);
    const auto seen = [&](bool as_polygon) {
        Builder builder;
        const MaterialIndex material = builder.add_material(shine);
        const std::array<Triangle, 2> halves = {left, right};
        if (as_polygon) {
            builder.add_polygon(std::span<const Triangle>(halves), material);
        } else {
            builder.add(left, material);
            builder.add(right, material);
        }
        return gray_along(builder.finish(), {-0.6, 0.5e-7, 0}, {1, -1e-7, 0});
    };
    CHECK(seen(true) == 1.0);
    CHECK(seen(false) == 2.0);
}
