#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <functional>
#include <pthread.h>

/// Tests of calls on threads with little stack.
using namespace raylane;
using namespace raylane::tests;

namespace {

/// Calls `body` on a thread with this many bytes of stack.
void on_thread(std::size_t bytes, std::function<void()> body) {
    pthread_attr_t attributes;
    REQUIRE(::pthread_attr_init(&attributes) == 0);
    REQUIRE(::pthread_attr_setstacksize(&attributes, bytes) == 0);
    pthread_t thread{};
    REQUIRE(::pthread_create(
                &thread, &attributes,
                [](void* given) -> void* {
                    (*static_cast<std::function<void()>*>(given))();
                    return nullptr;
                },
                &body) == 0);
    REQUIRE(::pthread_join(thread, nullptr) == 0);
    ::pthread_attr_destroy(&attributes);
}

raylane::Solid deepest() {
    raylane::Solid solid = SphereOf<double>{{0, 0, 0}, 1};
    for (int i = 1; i < 1024; ++i) {
        const raylane::Solid other = SphereOf<double>{{0.001 * i, 0, 0.5}, 0.75};
        solid = i % 3 == 0   ? intersection_of({solid, SphereOf<double>{{0, 0, 0}, 2}})
                : i % 3 == 1 ? union_of({solid, other})
                             : difference_of(solid, {SphereOf<double>{{0.001 * i, 1, 0}, 0.25}});
    }
    return solid;
}

} // namespace

TEST_CASE("solids of the greatest depth need no more stack than is documented") {
    constexpr std::size_t stated = 1 << 20; // bytes
    bool found = false;
    int around = 0;
    std::size_t pixels = 0;
    on_thread(sanitized ? 8 * stated : stated, [&] {
        SceneBuilder builder;
        builder.settings.width = builder.settings.height = 8;
        builder.camera.from = {0, 0, 5};
        builder.add(deepest(), builder.add_material({.transmission = 1}));
        const Scene scene = builder.build();
        const Tracer tracer(scene, {.threads = 1});
        const Rays rays = to_ball();
        const Hits hits = intersect(tracer, rays);
        found = hits.shape[0] != no_shape && occluded(tracer, rays)[0] == 1;
        CrossingRows rows;
        tracer.crossings(rays.span(), rows);
        LengthRows lengths;
        tracer.path_lengths(rays.span(), lengths);
        SolidRows solids;
        const float x[] = {0}, y[] = {0}, z[] = {0.5F};
        tracer.contains(PointSpan{x, y, z}, solids);
        around = static_cast<int>(solids.shape_id.size());
        pixels = render(scene, {.threads = 1}).rgb.size();
    });
    CHECK(found);
    CHECK(around == 1);
    CHECK(pixels == 3 * 8 * 8);
}
