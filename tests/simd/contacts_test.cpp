#include "simd/isa.hpp"
#include "simd/render.hpp"
#include "tests/catch.hpp"
#include "tests/core/little_scene.hpp"

#include <string>
#include <vector>

/// Surfaces of one material that lie in each other are one surface, however many they are.
using namespace raylane;
using namespace little_scene;

namespace {

/// A room with a checkered floor and a light, and what is put into it.
class Room : public Builder {
  public:
    Room() {
        settings.width = 32;
        settings.height = 24;
        settings.max_depth = 6;
        camera.from = {1, 3, 7};
        camera.at = {0, 0.5F, 0};
        background = {0.5F, 0.6F, 0.8F};
        Light lamp;
        lamp.position = {3, 8, 4};
        add_light(lamp);
        Material floor = luminous();
        floor.pattern.kind = PatternKind::checker;
        floor.pattern.colors = {Color(1.0F), Color(0.1F, 0.2F, 0.4F)};
        floor.ambient = 0.25F;
        floor.diffuse = 0.75F;
        add_shape(Plane{{0, -1, 0}, {0, 1, 0}}, floor);
    }
};

struct Substance {
    std::string name;
    Material material;
};

std::vector<Substance> all_substances() {
    Material matte = luminous({0.8F, 0.3F, 0.2F});
    matte.ambient = 0.2F;
    matte.diffuse = 0.7F;
    matte.specular = 0.3F;
    Material coated = matte;
    coated.reflectivity = 0.4F;
    Material stained = glass(1.25F);
    stained.reflectivity = 0.2F;
    return {{"matte", matte},
            {"mirror", mirror(0.9F)},
            {"coated", coated},
            {"glass", glass(1.5F, Reflection::dielectric)},
            {"stained glass", stained}};
}

/// One surface, said in ways that are the same in real numbers and whose numbers differ.
template <class Shape>
Shape again(int i);

template <>
Plane again(int i) {
    const float step = 0.5F * static_cast<float>(i);
    return {{step, 1, 2.0F * step}, {0, 1.0F + step, 0}};
}
template <>
Disc again(int i) {
    return {{0, 0.5F, 0}, Vec3f(1, 2, 2) * static_cast<float>(i + 1), 2};
}
template <>
Triangle again(int i) {
    const Vec3f corners[] = {{-2, -0.5F, 1}, {2, -0.25F, 0.5F}, {0.25F, 2, -1}};
    return {corners[i % 3], corners[(i + 1) % 3], corners[(i + 2) % 3]};
}
template <>
SmoothTriangle again(int) {
    const Triangle flat = again<Triangle>(0);
    return {flat.a, flat.b, flat.c, {0, 1, 3}, {1, 0, 2}, {-1, 1, 2}};
}
template <>
Box again(int i) {
    const Vec3f corner(-1, -0.5F, -1), edges[] = {{2, 0.5F, 0}, {-0.5F, 1.5F, 0}, {0, 0.25F, 2}};
    const Vec3f u = edges[i % 3], v = edges[(i + 1) % 3], w = edges[(i + 2) % 3];
    return i % 2 == 0 ? Box{corner, u, v, w} : Box{corner + u, -u, v, w};
}
template <class Cylinder>
Cylinder cylinder_again(int i) {
    const Vec3f base(-1, -0.5F, 0), axis(1.5F, 1.5F, 0.5F);
    return i % 2 == 0 ? Cylinder{base, axis, 0.75F} : Cylinder{base + axis, -axis, 0.75F};
}
template <>
CappedCylinder again(int i) {
    return cylinder_again<CappedCylinder>(i);
}
template <>
OpenCylinder again(int i) {
    return cylinder_again<OpenCylinder>(i);
}
template <class Cone>
Cone cone_again(int i) {
    const Vec3f base(-1, -0.5F, 0), axis(1.5F, 1.5F, 0.5F);
    return i % 2 == 0 ? Cone{base, axis, 1, 0.25F} : Cone{base + axis, -axis, 0.25F, 1};
}
template <>
CappedCone again(int i) {
    return cone_again<CappedCone>(i);
}
template <>
OpenCone again(int i) {
    return cone_again<OpenCone>(i);
}
template <>
Quadric again(int i) {
    const float scale = static_cast<float>(i + 1);
    Quadric bowl{};
    bowl.xx = bowl.yy = scale;
    bowl.zz = 0.5F * scale;
    bowl.one = -2.0F * scale;
    bowl.lower = Vec3f(-1.25F);
    bowl.upper = Vec3f(1.25F);
    return bowl;
}

std::vector<Color> picture_of(Room&& room, simd::Engine engine) {
    const Scene scene = room.finish();
    simd::RenderOptions options;
    options.engine = engine;
    options.threads = 1;
    return simd::render(scene, scene.settings(), options).film.pixels();
}

constexpr int numbers[] = {2, 4, 5, 9, 33};

long count_differences(const std::vector<Color>& a, const std::vector<Color>& b) {
    long count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] == b[i] ? 0 : 1;
    return count;
}

/// The picture of so many is that of one, to the bit, by both engines.
template <class Add>
void check_are_one(const Add& add, bool opaque_only = false) {
    for (const Substance& substance : all_substances()) {
        if (opaque_only && substance.material.transmits()) continue;
        const auto picture = [&](int count, simd::Engine engine) {
            Room room;
            const MaterialIndex material = room.add_material(substance.material);
            for (int i = 0; i < count; ++i)
                add(room, i, material);
            return picture_of(std::move(room), engine);
        };
        const std::vector<Color> one = picture(1, simd::Engine::reference);
        for (const int count : numbers) {
            CAPTURE(substance.name, count);
            CHECK(count_differences(picture(count, simd::Engine::reference), one) == 0);
            CHECK(count_differences(picture(count, simd::Engine::vector), one) == 0);
        }
    }
}

template <class Shape>
void check_is_one_shape() {
    check_are_one(
        [](Room& room, int i, MaterialIndex material) { room.add(again<Shape>(i), material); });
}

} // namespace

TEST_CASE("any number of the same sphere is one sphere", "[native]") {
    check_are_one([](Room& room, int, MaterialIndex material) {
        room.add(Sphere{{0, 0.5F, 0}, 1.25F}, material);
    });
}

TEST_CASE("any number of planes in each other are one", "[native]") {
    check_is_one_shape<Plane>();
}
TEST_CASE("any number of discs in each other are one", "[native]") {
    check_is_one_shape<Disc>();
}
TEST_CASE("any number of triangles in each other are one", "[native]") {
    check_is_one_shape<Triangle>();
}
TEST_CASE("any number of the same smooth triangle are one", "[native]") {
    check_are_one([](Room& room, int, MaterialIndex material) {
        room.add(again<SmoothTriangle>(0), material);
    });
}
TEST_CASE("any number of boxes in each other are one", "[native]") {
    check_is_one_shape<Box>();
}
TEST_CASE("any number of cylinders in each other are one", "[native]") {
    check_is_one_shape<CappedCylinder>();
    check_is_one_shape<OpenCylinder>();
}
TEST_CASE("any number of cones in each other are one", "[native]") {
    check_is_one_shape<CappedCone>();
    check_is_one_shape<OpenCone>();
}
TEST_CASE("any number of quadrics in each other are one", "[native]") {
    check_is_one_shape<Quadric>();
}
TEST_CASE("a sphere and the quadrics in it are one", "[native]") {
    check_are_one([](Room& room, int i, MaterialIndex material) {
        const float scale = static_cast<float>(i);
        Quadric ball{};
        ball.xx = ball.yy = ball.zz = scale;
        ball.one = -1.5625F * scale;
        ball.lower = Vec3f(-2);
        ball.upper = Vec3f(2);
        i == 0 ? room.add(Sphere{{0, 0, 0}, 1.25F}, material) : room.add(ball, material);
    });
}

/// An atom of five bonds has five balls where one model puts one.
TEST_CASE("balls at the ends of bonds are one ball", "[native]") {
    check_are_one([](Room& room, int i, MaterialIndex material) {
        if (i == 0)
            for (int bond = 0; bond < 5; ++bond) {
                const Vec3f ends[] = {
                    {1, 0, 0}, {-1, 0.5F, 0}, {0, 1, 0.5F}, {0, 0, 1}, {0, 0, -1}};
                room.add(CappedCylinder{{0, 0.5F, 0}, ends[bond], 0.2F}, material);
            }
        room.add(Sphere{{0, 0.5F, 0}, 0.5F}, material);
    });
}

/// Of fronts that overlap, what is in front of the others is the whole of it.
TEST_CASE("boxes whose fronts lie in one plane have one front", "[native]") {
    check_are_one(
        [](Room& room, int i, MaterialIndex material) {
            const float less = 0.015625F * static_cast<float>(i);
            room.add(Box{{-1.5F + less, -1.5F + less, -1},
                         {3.0F - 2.0F * less, 0, 0},
                         {0, 2.5F - 2.0F * less, 0},
                         {0, 0, 1}},
                     material);
        },
        /*opaque_only=*/true);
}
