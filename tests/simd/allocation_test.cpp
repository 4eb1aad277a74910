#include "simd/isa.hpp"
#include "simd/wavefront/wavefront.hpp"
#include "tests/catch.hpp"
#include "tests/core/little_scene.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

/// In a program of its own: it counts what is asked of the heap.
namespace {

std::atomic<long> allocations = 0;

void* counted(std::size_t bytes, std::size_t alignment) {
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

} // namespace

void* operator new(std::size_t bytes) {
    return counted(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return counted(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

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
    Light light;
    light.position = {5, 9, 7};
    builder.add_light(light);
    const Scene scene = builder.finish();
    const simd::SceneData data(scene);
    simd::Wavefront wavefront(data, scene.settings(), {&simd::kernels_of(simd::best_isa())});
    Film film(64, 64);
    wavefront.render({0, 0, 8, 8}, film); // what surrounds the camera is found at first
    const long before = allocations;
    wavefront.render({0, 0, 64, 64}, film);
    CHECK(wavefront.counters().deferred > 0);
    CHECK(allocations == before);
    CHECK(before > 0);
}
