#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/sanitized.hpp"

#include <cmath>
#include <pthread.h>

/// Long paths on threads with a small stack.
using namespace raylane;
using namespace little_scene;

namespace {

constexpr std::size_t stack_bytes = 512 << 10;

template <class Act>
void on_small_stack(Act act) {
    pthread_attr_t attributes;
    REQUIRE(pthread_attr_init(&attributes) == 0);
    REQUIRE(pthread_attr_setstacksize(&attributes, stack_bytes) == 0);
    pthread_t thread;
    REQUIRE(pthread_create(
                &thread, &attributes,
                [](void* to_do) -> void* {
                    (*static_cast<Act*>(to_do))();
                    return nullptr;
                },
                &act) == 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
}

/// Returns a scene of two mirrors with `count` coincident panes of glass between them.
Scene hall(int count) {
    Builder hall;
    hall.settings.width = hall.settings.height = 3;
    hall.settings.max_depth = 1000;
    hall.camera.from = {0.1F, 0.2F, 0.5F};
    hall.camera.at = {0, 0, 0};
    Material bright = luminous();
    bright.reflectivity = 0.999F;
    const MaterialIndex silver = hall.add_material(bright);
    hall.add(Plane{{0, 0, -1}, {0, 0, 1}}, silver);
    hall.add(Plane{{0, 0, 1}, {0, 0, -1}}, silver);
    for (int i = 0; i < count; ++i) {
        const Material pane = glass(1.0F + 0.001F * static_cast<float>(i));
        hall.add_shape(Box{{-5e3F, -5e3F, -0.25F}, {1e4F, 0, 0}, {0, 1e4F, 0}, {0, 0, 0.5F}}, pane);
    }
    return hall.finish();
}

} // namespace

TEST_CASE("a thousand reflections and any number of contacts fit a small stack", "[native]") {
    if (tests::sanitized) {
        WARN("skipped: a sanitizer's frames are larger");
        return;
    }
    for (const int panes : {0, 1, 40}) {
        const Scene scene = hall(panes);
        // The sum of 1000 reflections, or of fewer if panes between the mirrors take some of the
        // depth.
        const int reflections = panes == 0 ? 1000 : 332;
        const double sum = (1.0 - std::pow(0.999, reflections + 1)) / 0.001;
        for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
            Color seen(-1.0F);
            on_small_stack([&] {
                seen = simd::render(scene, scene.settings(), {.engine = engine, .threads = 1})
                           .film.pixels()[4];
            });
            CAPTURE(panes, sum, seen.x);
            CHECK(std::abs(static_cast<double>(seen.x) / sum - 1.0) < 0.01);
        }
    }
}
