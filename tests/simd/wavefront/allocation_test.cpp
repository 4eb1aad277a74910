#include "simd/isa/isa.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "simd/wavefront/wavefront.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/replaced_heap.hpp"

#include <atomic>
#include <vector>

/// A separate program, as it counts all allocations.
namespace {

std::atomic<long> allocations = 0;

} // namespace

void raylane::tests::has_taken(void*) {
    ++allocations;
}
void raylane::tests::will_release(void*) {}

using namespace raylane;
using namespace little_scene;

TEST_CASE("nothing is allocated inside the wavefront loop") {
    Builder builder;
    builder.settings.width = builder.settings.height = 64;
    builder.settings.grid = 2;
    Material shiny = mirror(0.5F);
    shiny.diffuse = 0.5F;
    shiny.specular = 0.5F;
    for (int i = 0; i < 40; ++i) {
        const float x = static_cast<float>(i % 8) - 3.5F, y = static_cast<float>(i / 8) - 2.0F;
        builder.add_shape(Sphere{{x, y, 0}, 0.45F},
                          i % 3 == 0 ? glass(1.5F, Reflection::schlick) : shiny);
    }
    builder.add_shape(Plane{{0, -3, 0}, {0, 1, 0}}, shiny);
    // Three of them meet the plane.
    for (int i = 0; i < 3; ++i)
        builder.add_shape(Box{{static_cast<float>(i), -3, 2}, {0.5F, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          glass(1.3F));
    Material room = luminous(Color(0.2F));
    room.visible = Visible::inside;
    builder.add_shape(Sphere{{0, 0, 0}, 40}, room);
    builder.add_light({.position = {5, 9, 7}});
    const Scene scene = builder.finish();
    const simd::SceneData data(scene);
    simd::Wavefront wavefront(data, scene.settings(), {&simd::kernels_of(simd::best_isa())});
    Film film(64, 64);
    wavefront.render({0, 0, 8, 8}, film); // finds the media around the camera
    const long before = allocations;
    wavefront.render({0, 0, 64, 64}, film);
    CHECK(wavefront.counters().deferred > 0);
    CHECK(allocations == before);
    CHECK(before > 0);
}

namespace {

/// Returns balls on a lattice. Each touches its neighbours, and every third is visible only from
/// outside.
Scene touching_balls(int side) {
    SceneBuilder builder;
    builder.wants_light = false;
    Material one_sided;
    one_sided.visible = Visible::outside;
    const MaterialIndex materials[] = {builder.add_material({}), builder.add_material(one_sided)};
    for (int i = 0; i < side * side * side; ++i)
        builder.add(
            Sphere{{static_cast<float>(2 * (i % side)), static_cast<float>(2 * (i / side % side)),
                    static_cast<float>(2 * (i / side / side))},
                   1.0F},
            materials[i % 3 == 0 ? 1 : 0]);
    return std::move(builder).build();
}

/// Calls `ask` twice. Returns the number of allocations of the second call.
template <class Ask>
long allocated_by_second(const Ask& ask) {
    ask();
    const long before = allocations;
    ask();
    return allocations - before;
}

} // namespace

TEST_CASE("a repeated call of the library allocates nothing") {
    constexpr std::size_t count = 10000;
    for (const int side : {4, 21}) { // the second has tiles
        const Scene scene = touching_balls(side);
        const simd::StreamTracer tracer(scene, 1);
        const float far = static_cast<float>(side);
        // Kind 0: rays from one point, line by line. Kind 1: rays parallel to z, many of them
        // through points where balls touch. Kind 2: rays with different origins and directions.
        for (const int kind : {0, 1, 2}) {
            std::vector<float> of_rays[6];
            for (std::size_t i = 0; i < count; ++i) {
                const float x = static_cast<float>(i % 100) / 50.0F - 1.0F,
                            y = static_cast<float>(i / 100) / 50.0F - 1.0F,
                            step = static_cast<float>(i % 50);
                const float ray[3][6] = {{far, far, -2.0F * far, x, y, 2.0F},
                                         {step - 1.0F, 1.0F, -3.0F, 0, 0, 1},
                                         {step, far * y, far * x, y, x - y, 1.0F - x}};
                for (int k = 0; k < 6; ++k)
                    of_rays[k].push_back(ray[kind][k]);
            }
            std::vector<float> t(count), normals[3] = {t, t, t}, t_min(count, 0.5F),
                                         t_max(count, 2.5F * far);
            std::vector<ShapeId> shape(count), named(count, 0);
            std::vector<std::uint8_t> entering(count), face(count);
            std::vector<double> t_double(count);
            simd::RayStream<float> rays = {
                count,
                {of_rays[0].data(), of_rays[1].data(), of_rays[2].data()},
                {of_rays[3].data(), of_rays[4].data(), of_rays[5].data()}};
            const simd::HitStream hits = {
                t.data(),     {normals[0].data(), normals[1].data(), normals[2].data()},
                shape.data(), entering.data(),
                face.data(),  t_double.data()};
            CAPTURE(side, kind);
            CHECK(allocated_by_second([&] { tracer.nearest(rays, hits); }) == 0);
            CHECK(allocated_by_second([&] { tracer.occluded(rays, face.data()); }) == 0);
            rays.t_min = t_min.data();
            rays.t_max = t_max.data();
            CHECK(allocated_by_second([&] { tracer.nearest(rays, hits); }) == 0);
            CHECK(allocated_by_second([&] { tracer.occluded(rays, face.data()); }) == 0);
            std::vector<float> on_ball[3]; // the first one, around 0
            for (std::size_t i = 0; i < count; ++i) {
                const Vec3f way(of_rays[3][i], of_rays[4][i], of_rays[5][i]);
                for (int axis = 0; axis < 3; ++axis)
                    on_ball[axis].push_back(way[axis] / length(way));
            }
            for (int axis = 0; axis < 3; ++axis)
                rays.origin[axis] = on_ball[axis].data();
            rays.origin_shape = named.data();
            CHECK(allocated_by_second([&] { tracer.nearest(rays, hits); }) == 0);
            CHECK(allocated_by_second([&] { tracer.occluded(rays, face.data()); }) == 0);
        }
    }
}
