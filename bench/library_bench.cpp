#include "raylane/raylane.hpp"
#include "tests/scenes/api/ray_arrays.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

/// Measures the speed of the library's public calls on one thread. Each scene has a dozen shapes of
/// one kind. Each of the tests' sets of rays (ray_sets) is measured separately. intersect() returns
/// t, the normal, the shape and the side.
namespace raylane::bench {

namespace {

using tests::Random, tests::Rays, tests::Set;

constexpr std::size_t ray_count = 1 << 15;

struct Asked {
    Scene scene;
    Rays rays;
};

template <class CoreShape>
Asked make(Set set) {
    constexpr int shape_count = 12;
    Random random(static_cast<std::uint64_t>(core::kind_of<CoreShape>) + 1);
    SceneBuilder builder;
    builder.add_material({});
    std::vector<CoreShape> shapes;
    for (int i = 0; i < shape_count; ++i) {
        shapes.push_back(ray_sets::Target<CoreShape>::make(random, set == Set::lattice));
        builder.add(std::bit_cast<typename tests::InLibrary<CoreShape>::Type>(shapes.back()), 0);
    }
    Rays rays;
    while (rays.size() < ray_count) {
        const core::Ray<float> ray =
            ray_sets::make_ray(shapes[random.integer(0, shape_count - 1)], set, random);
        rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                 {ray.direction.x, ray.direction.y, ray.direction.z});
    }
    return {builder.build(), rays};
}

template <class CoreShape>
void intersect(benchmark::State& state, Set set) {
    const Asked asked = make<CoreShape>(set);
    const Tracer tracer(asked.scene, {.threads = 1});
    tests::Hits hits(ray_count);
    for (auto _ : state)
        tracer.intersect(asked.rays.span(), hits.span());
    state.SetItemsProcessed(static_cast<std::int64_t>(ray_count) * state.iterations());
}

template <class CoreShape>
void occluded(benchmark::State& state, Set set) {
    const Asked asked = make<CoreShape>(set);
    const Tracer tracer(asked.scene, {.threads = 1});
    std::vector<std::uint8_t> blocked(ray_count);
    for (auto _ : state)
        tracer.occluded(asked.rays.span(), blocked);
    state.SetItemsProcessed(static_cast<std::int64_t>(ray_count) * state.iterations());
}

const bool registered = [] {
    core::for_each_shape_type([]<class CoreShape>(std::type_identity<CoreShape>) {
        std::string kind(name_of(core::kind_of<CoreShape>));
        std::replace(kind.begin(), kind.end(), ' ', '_');
        for (const Set set : ray_sets::all_sets) {
            const std::string name =
                kind + "/" + std::string(ray_sets::set_names[static_cast<int>(set)]);
            benchmark::RegisterBenchmark(
                ("library/intersect/" + name).c_str(),
                [=](benchmark::State& state) { intersect<CoreShape>(state, set); });
            benchmark::RegisterBenchmark(
                ("library/occluded/" + name).c_str(),
                [=](benchmark::State& state) { occluded<CoreShape>(state, set); });
        }
    });
    return true;
}();

} // namespace

} // namespace raylane::bench
