#include "tests/simd/render/image.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sanitized.hpp"

#include <algorithm>
#include <cmath>

/// Images of solids of solids: both engines and all instruction sets render the same.
using namespace raylane;
using raylane::tests::image;
using namespace raylane::core;

namespace {

Solid of_shape(const PartShape& shape, MaterialIndex material) {
    Solid solid;
    solid.shape = shape;
    solid.material = material;
    return solid;
}

Solid made(Made by, std::vector<Solid> parts) {
    Solid solid{by};
    solid.parts = std::move(parts);
    return solid;
}

Material of_red() {
    Material red;
    red.pattern.colors[0] = {1, 0, 0};
    return red;
}

/// Returns a material that transmits all light that it does not reflect.
Material clear() {
    Material glass;
    glass.ambient = glass.diffuse = 0;
    glass.reflection = Reflection::dielectric;
    glass.transmission = 1;
    return glass;
}

/// Returns rounded, bored and cut blocks of clay and glass on a floor. Some cuts are flush.
Scene blocks(std::vector<double> wavelengths = {}) {
    SceneBuilder builder;
    builder.settings.width = 72;
    builder.settings.height = 54;
    builder.settings.grid = 2;
    builder.camera.from = {4, 3.5F, 6};
    builder.camera.at = {0, 0.6F, 0};
    builder.background = {0.6F, 0.7F, 0.9F};
    builder.wavelengths = std::move(wavelengths);
    builder.add_light({.position = {4, 6, 5}});
    builder.add_light({.kind = LightKind::sky, .color = {0.3F, 0.3F, 0.3F}});
    const MaterialIndex floor = builder.add_material({});
    Material of_clay;
    of_clay.specular = 0.3F;
    const MaterialIndex clay = builder.add_material(of_clay);
    const MaterialIndex red = builder.add_material(of_red());
    Material of_glass = clear();
    of_glass.glass = glass_catalogue()[8].glass;
    const MaterialIndex glass = builder.add_material(of_glass);
    builder.add(Plane{{0, 0, 0}, {0, 1, 0}}, floor);
    const auto box = [](const Vec3d& lower, const Vec3d& size) {
        return of_shape(BoxOf<double>{lower, {size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}});
    };
    builder.add_solid(
        made(Made::by_difference,
             {made(Made::by_intersection,
                   {box({-1, 0, -1}, {2, 2, 2}), of_shape(SphereOf<double>{{0, 1, 0}, 1.35}, red)}),
              of_shape(CylinderOf<double, Ends::capped>{{-2, 1, 0}, {4, 0, 0}, 0.6}),
              of_shape(CylinderOf<double, Ends::capped>{{0, 0.5, 0}, {0, 1.5, 0}, 0.5})}), // flush
        clay);
    builder.add_solid(
        made(Made::by_intersection, {of_shape(SphereOf<double>{{1.9, 0.8, 1.2}, 0.8}),
                                     of_shape(SphereOf<double>{{2.3, 0.8, 1.8}, 0.8}),
                                     of_shape(PlaneOf<double>{{2, 1, 1.5}, {0, 1, 0.2}})}),
        glass);
    std::vector<Solid> balls;
    for (int i = 0; i < 20; ++i)
        balls.push_back(of_shape(SphereOf<double>{
            {-2.5 + 0.3 * (i % 5), 0.3 + 0.25 * (i / 10), 0.8 + 0.3 * (i / 5 % 2)}, 0.28}));
    builder.add_solid(
        made(Made::by_difference, {made(Made::by_union, balls),
                                   of_shape(PlaneOf<double>{{0, 0, 1.2}, {0.1, 0, -1}}, red)}),
        clay);
    return std::move(builder).build();
}

} // namespace

TEST_CASE("both engines and all instruction sets render the same solids of solids", "[native]") {
    tests::check_engines_agree(blocks());
}

TEST_CASE("a spectrum changes only refracted light", "[native]") {
    const std::vector<Color> white = image(blocks(), simd::Engine::vector);
    const std::vector<Color> one = image(blocks({line_d}), simd::Engine::vector);
    const Scene of_many = blocks({430, 500, 560, 620});
    const std::vector<Color> many = image(of_many, simd::Engine::vector);
    const std::vector<Color> reference = image(of_many, simd::Engine::reference);
    std::size_t same = 0, colored = 0;
    for (std::size_t i = 0; i < white.size(); ++i) {
        const auto off = [](const Color& a, const Color& b) {
            return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
        };
        CHECK(off(one[i], white[i]) < 1e-5F);
        CHECK(off(reference[i], many[i]) < 1e-4F);
        same += off(many[i], white[i]) < 1e-5F ? 1 : 0;
        colored += off(many[i], white[i]) > 0.02F ? 1 : 0;
    }
    CHECK(same > 2 * white.size() / 3);
    CHECK(colored > 20);
}

TEST_CASE("only the remaining part of a cut solid casts a shadow") {
    // A ball without its upper half, and a whole ball, lit obliquely from above.
    for (const bool cut : {false, true}) {
        SceneBuilder builder;
        builder.settings.width = builder.settings.height = 33;
        builder.camera = {.projection = Projection::orthographic,
                          .from = {0, 10, 0},
                          .at = {0, 0, 0},
                          .up = {0, 0, -1},
                          .height = 8};
        builder.add_light({.kind = LightKind::directional, .direction = {1, -1, 0}});
        Material without_light;
        without_light.ambient = 0;
        const MaterialIndex material = builder.add_material(without_light);
        builder.add(Plane{{0, -1, 0}, {0, 1, 0}}, material);
        std::vector<Solid> parts = {of_shape(SphereOf<double>{{0, 0, 0}, 1})};
        if (cut) parts.push_back(of_shape(PlaneOf<double>{{0, 0, 0}, {0, -1, 0}}));
        builder.add_solid(made(Made::by_difference, parts), material);
        const Scene scene = std::move(builder).build();
        const std::vector<Color> seen = image(scene, simd::Engine::vector);
        long dark =
            std::count_if(seen.begin(), seen.end(), [](const Color& c) { return c.x == 0.0F; });
        CHECK(image(scene, simd::Engine::reference) == seen);
        // The shadow is an ellipse of half axes 1 and sqrt(2) that begins under the ball, or half
        // of it.
        CHECK(dark > (cut ? 10 : 40));
        CHECK(dark < (cut ? 45 : 90));
    }
}

TEST_CASE("walls inside of a union are not seen and cast no shadow") {
    SceneBuilder builder;
    builder.settings.width = builder.settings.height = 40;
    builder.camera.from = {0, 0, 0};
    builder.camera.at = {1, 0.2F, 0.1F};
    builder.camera.field_of_view = 100;
    builder.add_light({.position = {-0.3F, 0.2F, 0.4F}});
    const MaterialIndex material = builder.add_material(of_red());
    std::vector<Solid> balls = {of_shape(SphereOf<double>{{0, 0, 0}, 3})};
    for (int i = 0; i < 24; ++i)
        balls.push_back(of_shape(SphereOf<double>{
            {1.5 * std::cos(0.7 * i), 1.5 * std::sin(0.7 * i), 0.1 * i - 1.2}, 0.5}));
    builder.add_solid(made(Made::by_union, balls), material);
    const Scene scene = std::move(builder).build();
    const std::vector<Color> seen = image(scene, simd::Engine::vector);
    CHECK(image(scene, simd::Engine::reference) == seen);
    CHECK(std::all_of(seen.begin(), seen.end(), [](const Color& c) { return c.x > 0.3F; }));
}

namespace {

/// Returns a crowd of balls and sticks, cut in one of several ways, with a ball of another material
/// in the hole. The camera is far away, in the hole, or inside of a ball.
Scene cut_crowd(int way, int place) {
    const Vec3f places[] = {{5, 4, 7}, {0.7F, 0.9F, 1.1F}, {-0.7F, -0.8F, -0.75F}};
    SceneBuilder builder;
    builder.settings.width = tests::sanitized ? 32 : 80;
    builder.settings.height = tests::sanitized ? 24 : 60;
    builder.camera.from = places[place];
    builder.camera.at = {0, 0, 0};
    builder.background = {0.6F, 0.7F, 0.9F};
    builder.add_light({.position = {4, 6, 5}});
    builder.add_light({.kind = LightKind::directional, .direction = {-0.4F, -1, -0.3F}});
    Material mirror;
    mirror.reflectivity = 0.3F;
    const MaterialIndex clay = builder.add_material(mirror);
    const MaterialIndex red = builder.add_material(of_red());
    Material of_glass = clear();
    of_glass.index = 1.1F;
    const MaterialIndex glass = builder.add_material(of_glass);
    builder.add(Plane{{0, -1.7F, 0}, {0, 1, 0.02F}}, clay);
    std::vector<Solid> parts;
    for (int i = 0; i < 125; ++i) {
        const Vec3d at = {0.8 * (i % 5 - 2) + 0.1 * (i % 3), 0.8 * (i / 5 % 5 - 2),
                          0.8 * (i / 25 - 2) + 0.07 * (i % 4)};
        parts.push_back(of_shape(SphereOf<double>{at, (way < 10 ? 0.3 : 0.2) + 0.03 * (i % 7)}));
        if (i % 4 == 0)
            parts.push_back(of_shape(CylinderOf<double, Ends::capped>{at, {0.8, 0, 0}, 0.2}));
        if (i % 9 == 0)
            parts.push_back(of_shape(
                EllipsoidOf<double>{at, {0.5, 0.1, 0}, {-0.05, 0.25, 0}, {0, 0.02, 0.35}}));
        if (i % 11 == 0)
            parts.push_back(
                of_shape(BoxOf<double>{at, {0.4, 0.1, 0}, {-0.1, 0.4, 0}, {0, 0, 0.5}}));
    }
    const auto plane = [&](const Vec3d& point, const Vec3d& normal) {
        return of_shape(PlaneOf<double>{point, normal}, red);
    };
    const Solid crowd = made(Made::by_union, parts);
    const Solid box = of_shape(BoxOf<double>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, red);
    const Solid ball = of_shape(SphereOf<double>{{1, 1, 1}, 1.5}, red);
    const Solid wedge = made(Made::by_intersection,
                             {plane({0, 0, 0}, {-1, 0.2, 0.1}), plane({0, 0, 0}, {0.1, 0.1, -1})});
    const std::vector<Solid> ways[] = {
        {crowd, plane({0, 0, 0}, {-0.5, -0.4, -1})},
        {crowd, plane({1, 0, 0}, {-1, 0, 0}), plane({0, 1, 0}, {0, -1, 0.1}),
         plane({0, 0, 0.8}, {0, 0, -1})},
        {crowd, wedge},
        {crowd, box},
        {crowd, ball, plane({0.5, 0, 0}, {-1, 0, -1})},
    };
    constexpr int count = 5;
    const Solid around =
        of_shape(BoxOf<double>{{-1.7, -1.6, -1.8}, {3.1, 0, 0}, {0, 3.2, 0}, {0, 0, 3.3}}, red);
    if (way < 2 * count)
        builder.add_solid(
            made(way < count ? Made::by_difference : Made::by_clip, ways[way % count]), clay);
    else // balls that stick out of a box
        builder.add_solid(made(Made::by_intersection, {crowd, around}),
                          way == 2 * count ? clay : glass);
    builder.add(Sphere{{0.9F, 0.9F, 0.9F}, 0.4F}, red);
    return std::move(builder).build();
}

} // namespace

TEST_CASE("both engines render the same cut crowd", "[native]") {
    const int way = GENERATE(range(0, 12));
    const int place = GENERATE(range(0, 3));
    // Tests each way and each place, or in full runs all pairs of them.
    if (place != way % 3 && !tests::is_full()) return;
    const Scene scene = cut_crowd(way, place);
    const std::vector<Color> seen = image(scene, simd::Engine::vector);
    CAPTURE(way, place);
    CHECK(image(scene, simd::Engine::reference) == seen);
    for (const simd::Isa isa : simd::available_isas())
        CHECK(image(scene, simd::Engine::vector, isa) == seen);
}

TEST_CASE("rays that see more cuts than they can store lose none") {
    SceneBuilder builder;
    builder.settings.width = builder.settings.height = 16;
    builder.camera = {.projection = Projection::orthographic,
                      .from = {0, 10, 0},
                      .at = {0, 0, 0},
                      .up = {0, 0, -1},
                      .height = 17};
    builder.add_light({.kind = LightKind::directional, .direction = {-0.4F, -1, -0.3F}});
    const MaterialIndex red = builder.add_material(of_red());
    for (int crowd = 0; crowd < 64; ++crowd) {
        const Vec3d at = {2.0 * (crowd % 8) - 7.0, 0.0, 2.0 * (crowd / 8) - 7.0};
        std::vector<Solid> balls;
        for (int i = 0; i < 20; ++i)
            balls.push_back(of_shape(SphereOf<double>{
                at + Vec3d(0.6 * std::cos(i), 0.02 * i - 0.2, 0.6 * std::sin(i)), 0.3}));
        builder.add_solid(
            made(Made::by_difference,
                 {made(Made::by_union, balls),
                  of_shape(PlaneOf<double>{at, {0.02 * (crowd % 5), -1.0, 0.01 * (crowd % 7)}})}),
            red);
    }
    const Scene scene = std::move(builder).build();
    const std::vector<Color> seen = image(scene, simd::Engine::vector);
    CHECK(image(scene, simd::Engine::reference) == seen);
    CHECK(std::count_if(seen.begin(), seen.end(), [](const Color& c) { return c.x > 2 * c.y; }) >
          100);
}
