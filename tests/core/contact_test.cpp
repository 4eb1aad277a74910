#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/random.hpp"

#include <vector>

using namespace little_scene;
using namespace raylane;

/// Surfaces that coincide exactly, such as a block on a table or water in a glass. If rounded
/// arithmetic decides which of them comes first, the answer changes from pixel to pixel (POV-Ray
/// #125 is nearly of this kind).

namespace {

Box block(float x, float y, float z, const Vec3f& size) {
    return {{x, y, z}, {size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}};
}

/// Checks the colours of 500 rays from all over the upper half space to the middle of the floor
/// y = 0.
template <class Check>
void look_at_floor(const Scene& scene, const Check& check) {
    ray_sets::Random random(5);
    for (int i = 0; i < 500; ++i) {
        Vec3d origin = 5.0 * random.direction();
        origin.y = std::abs(origin.y) + 1.5;
        const Vec3d target{random.uniform(-0.3, 0.3), 0.0, random.uniform(-0.3, 0.3)};
        check(color_along<double>(scene, origin, target - origin));
    }
}

const Vec3d red(1, 0, 0);

} // namespace

TEST_CASE("a floor is seen through the block that stands on it") {
    const bool floor_first = GENERATE(true, false);
    Builder builder;
    builder.background = {0, 0, 1};
    const Plane floor{{0, 0, 0}, {0, 1, 0}};
    const Box glass_block = block(-2, 0, -2, {4, 1, 4});
    if (floor_first) builder.add_shape(floor, luminous({1, 0, 0}));
    builder.add_shape(glass_block, glass(1.0F));
    if (!floor_first) builder.add_shape(floor, luminous({1, 0, 0}));
    look_at_floor(builder.finish(), [](const Vec3d& color) { REQUIRE(color == red); });
}

TEST_CASE("a mirror under a block reflects back through it") {
    for (const bool mirror_first : {true, false}) {
        Builder builder;
        builder.background = {1, 0, 0};
        Material tinted = glass(1.0F);
        tinted.transmission = 0.5F;
        const Plane floor{{0, 0, 0}, {0, 1, 0}};
        if (mirror_first) builder.add_shape(floor, mirror());
        builder.add_shape(block(-9, 0, -9, {18, 1, 18}), tinted);
        if (!mirror_first) builder.add_shape(floor, mirror());
        // The ray passes the top twice, and half of the light each time. The bottom touches the
        // mirror.
        look_at_floor(builder.finish(),
                      [](const Vec3d& color) { REQUIRE(color == Vec3d(0.25, 0, 0)); });
    }
}

TEST_CASE("light reaches a floor through the block that stands on it") {
    Builder builder;
    Material matte = luminous({1, 0, 0});
    matte.ambient = 0.0F;
    matte.diffuse = 1.0F;
    builder.add_shape(block(-9, 0, -9, {18, 1, 18}), glass(1.0F));
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, matte);
    look_at_floor(builder.finish({.kind = LightKind::directional}),
                  [](const Vec3d& color) { REQUIRE(color == red); });
}

TEST_CASE("two touching blocks of one glass refract as one block") {
    const auto seen = [](int arrangement, const Vec3d& origin, const Vec3d& direction) {
        Builder builder;
        builder.background = {1, 1, 0};
        builder.settings.max_depth = 8;
        const Material material = glass(1.5F);
        const Box left = block(-1, -1, -1, {1, 2, 2}), right = block(0, -1, -1, {1, 2, 2});
        if (arrangement == 0) builder.add_shape(block(-1, -1, -1, {2, 2, 2}), material);
        if (arrangement == 1) builder.add_shape(left, material);
        if (arrangement != 0) builder.add_shape(right, material);
        if (arrangement == 2) builder.add_shape(left, material);
        builder.add_shape(Plane{{3, 0, 0}, {-1, 0, 0}}, ruler({0, 10, 0}));
        return gray_along(builder.finish(), origin, direction);
    };
    ray_sets::Random random(7);
    for (int i = 0; i < 200; ++i) {
        const Vec3d origin{-3, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
        const Vec3d direction{1, random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
        const double one = seen(0, origin, direction);
        REQUIRE(seen(1, origin, direction) == Approx(one).epsilon(1e-9));
        REQUIRE(seen(2, origin, direction) == Approx(one).epsilon(1e-9));
    }
}

TEST_CASE("a body is seen through a transparent skin of the same shape") {
    for (const bool skin_first : {true, false}) {
        Builder builder;
        const Sphere sphere{{0.1F, 0.2F, 0.3F}, 0.7F};
        if (skin_first) builder.add_shape(sphere, glass(1.0F));
        builder.add_shape(sphere, luminous({1, 0, 0}));
        if (!skin_first) builder.add_shape(sphere, glass(1.0F));
        const Scene scene = builder.finish();
        ray_sets::Random random(9);
        for (int i = 0; i < 500; ++i) {
            const Vec3d origin = 3.0 * random.direction();
            const Vec3d target = Vec3d(0.1, 0.2, 0.3) + random.cube(0.2);
            REQUIRE(color_along<double>(scene, origin, target - origin) == red);
        }
    }
}

TEST_CASE("surfaces that meet at an edge do not hide each other") {
    // The corner of a room, hit exactly in its edge and seen in a mirror floor.
    Builder builder;
    builder.background = {0, 0, 1};
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, mirror());
    builder.add_shape(Plane{{0, 0, 0}, {1, 0, 0}}, luminous({1, 0, 0}));
    const Scene scene = builder.finish();
    for (const double z : {0.0, 0.1, 1.0 / 3.0})
        CHECK(color_along<double>(scene, {1, 1, z}, {-1, -1, 0.25}) == red);
}

TEST_CASE("coincident surfaces filter light once for each material") {
    const auto seen = [](const std::vector<int>& materials) {
        Builder builder;
        Material matte = luminous({1, 0, 0});
        matte.ambient = 0.0F;
        matte.diffuse = 1.0F;
        builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, matte);
        Material tinted = glass(1.0F);
        tinted.transmission = 0.5F;
        const MaterialIndex material_index[] = {builder.add_material(tinted),
                                                builder.add_material(tinted)};
        float radius = 20;
        for (const int material : materials)
            builder.add(Disc{{0, 3, 0}, {0, 1, 0}, radius++}, material_index[material]);
        return color_along<double>(builder.finish({.kind = LightKind::directional}), {0.25, 1, 0.5},
                                   {0.1, -1, 0.2});
    };
    const Vec3d one = seen({0}), both = seen({0, 1});
    CHECK(one == Vec3d(0.5, 0, 0));
    CHECK(both == Vec3d(0.25, 0, 0));
    CHECK(seen({0, 0, 1}) == both);
    CHECK(seen({0, 1, 0}) == both);
    CHECK(seen({1, 0, 0, 1, 0, 1, 1}) == both);
}
