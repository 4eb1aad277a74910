#include "simd/wavefront/render.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// Any number of coincident surfaces of one material are one surface.
using namespace raylane;
using namespace little_scene;

namespace {

/// A room with a checkered floor and a light, to which a test adds shapes.
class Room : public Builder {
  public:
    Room() {
        settings.width = 32;
        settings.height = 24;
        settings.max_depth = 6;
        camera.from = {1, 3, 7};
        camera.at = {0, 0.5F, 0};
        background = {0.5F, 0.6F, 0.8F};
        add_light({.position = {3, 8, 4}});
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

std::vector<Color> image_of(Room&& room, simd::Engine engine) {
    const Scene scene = room.finish();
    return simd::render(scene, scene.settings(), {.engine = engine, .threads = 1}).film.pixels();
}

constexpr int numbers[] = {2, 4, 5, 9, 33};

long count_differences(const std::vector<Color>& a, const std::vector<Color>& b) {
    long count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] == b[i] ? 0 : 1;
    return count;
}

/// Checks that several shapes give the same image as one, to the bit, with both engines.
template <class Add>
void check_are_one(const Add& add, bool opaque_only = false) {
    for (const Substance& substance : all_substances()) {
        if (opaque_only && substance.material.transmits()) continue;
        const auto image = [&](int count, simd::Engine engine) {
            Room room;
            const MaterialIndex material = room.add_material(substance.material);
            for (int i = 0; i < count; ++i)
                add(room, i, material);
            return image_of(std::move(room), engine);
        };
        const std::vector<Color> one = image(1, simd::Engine::reference);
        for (const int count : numbers) {
            CAPTURE(substance.name, count);
            CHECK(count_differences(image(count, simd::Engine::reference), one) == 0);
            CHECK(count_differences(image(count, simd::Engine::vector), one) == 0);
        }
    }
}

} // namespace

TEMPLATE_TEST_CASE("any number of coincident shapes are one shape", "[native]",
                   RAYLANE_ALL_SHAPES) {
    check_are_one([](Room& room, int i, MaterialIndex material) {
        room.add(tests::Restated<TestType>::make(i), material);
    });
}

TEST_CASE("a sphere and coincident quadrics are one shape", "[native]") {
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

/// An atom with five bonds has five balls in some models, and one in others.
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

/// The union of the overlapping fronts is the largest front.
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

/// Because of symmetry, a ray that leaves the ball obliquely may fall as far as it goes aside: onto
/// an edge of the floor's cells.
TEST_CASE("both engines see one cell where symmetric paths meet edges of a pattern's cells") {
    for (const Substance& substance : all_substances()) {
        CAPTURE(substance.name);
        const auto image = [&](simd::Engine engine) {
            Room room;
            room.settings.width = 96;
            room.settings.height = 64;
            room.camera.from = {0, 0, 5};
            room.camera.at = {0, 0, 0};
            room.add_shape(Sphere{{0, 0, 0}, 1}, substance.material);
            return image_of(std::move(room), engine);
        };
        const std::vector<Color> vector = image(simd::Engine::vector),
                                 reference = image(simd::Engine::reference);
        float most = 0.0F;
        for (std::size_t i = 0; i < vector.size(); ++i)
            for (int channel = 0; channel < 3; ++channel)
                most = std::max(most, std::abs(vector[i][channel] - reference[i][channel]));
        CHECK(most < 0x1p-18F);
    }
}
