#include "simd/isa/isa.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/random.hpp"

#include <string>

/// Surfaces that rays meet at the same t, to the bit. A rule decides which of them is seen
/// (entering before leaving, then the lower id), not the order in which they are found.
using namespace raylane;
using namespace little_scene;

namespace {

constexpr int half_width = 4;

/// Adds shapes of many colours on the plane of this z, facing up or down. All numbers are small
/// integers or halves of them, so that floats hold every t.
void add_shapes(Builder& builder, int count, float z, ray_sets::Random& random) {
    for (int i = 0; i < count; ++i) {
        const Material material = luminous({static_cast<float>(i) / 128.0F, 0, 0});
        const auto integer_between = [&](int low, int high) {
            return static_cast<float>(random.integer(low, high));
        };
        const Vec3f corner(integer_between(-half_width, half_width - 1),
                           integer_between(-half_width, half_width - 1), z);
        const float u = integer_between(1, 4), v = integer_between(1, 4),
                    side = integer_between(0, 1) * 2.0F - 1.0F;
        switch (random.integer(0, 2)) {
        case 0:
            builder.add_shape(Box{corner, {u, 0, 0}, {0, v, 0}, {0, 0, side}}, material);
            break;
        case 1:
            builder.add_shape(Disc{corner, {0, 0, side}, u}, material);
            break;
        default:
            builder.add_shape(Triangle{corner, corner + Vec3f(u, 0, 0), corner + Vec3f(0, v, 0)},
                              material);
        }
    }
}

Builder looking_down() {
    Builder builder;
    builder.settings.width = builder.settings.height = 64;
    builder.settings.grid = 1;
    builder.camera.projection = Projection::orthographic;
    builder.camera.from = {0, 0, 8};
    builder.camera.at = {0, 0, 0};
    builder.camera.up = {0, 1, 0};
    builder.camera.height = 2 * half_width;
    return builder;
}

void check_same(const Scene& scene) {
    simd::RenderOptions options;
    options.engine = simd::Engine::reference;
    const Film expected = simd::render(scene, scene.settings(), options).film;
    options.engine = simd::Engine::vector;
    for (const Precision precision : all_precisions)
        for (const simd::Isa isa : simd::available_isas()) {
            for (const int tile : {8, 64}) {
                options.precision = precision;
                options.isa = isa;
                options.tile = tile;
                CAPTURE(std::string(name_of(precision)), std::string(simd::name_of(isa)), tile);
                const Film film = simd::render(scene, scene.settings(), options).film;
                CHECK(film.pixels() == expected.pixels());
            }
        }
}

} // namespace

TEST_CASE("all precisions and instruction sets see the same one of several surfaces at one t") {
    ray_sets::Random random(8);
    for (const int count : {20, 120}) { // brute force, then the hierarchy
        Builder seen = looking_down();
        add_shapes(seen, count, 0.0F, random);
        check_same(seen.finish());

        // Rays off a mirror are traced one by one, as they are not coherent.
        Builder reflected = looking_down();
        reflected.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, mirror());
        add_shapes(reflected, count, 16.0F, random);
        check_same(reflected.finish());
    }
}
