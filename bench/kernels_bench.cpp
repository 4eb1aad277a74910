#include "bench/random_shapes.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/shapes/solve.hpp"
#include "simd/isa/isa.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

/// Measures the float bounds that all traversals use, in tests of one ray against one shape, per
/// second. Each ray is tested against 16 shapes of a kind one by one, as in a scene without a
/// hierarchy. Also measures the scalar certified solver in the same run.

namespace {

using namespace raylane;
using namespace raylane::core;
using bench::make_shape;
using bench::Random;

constexpr std::size_t ray_count = 256; // fits the first-level cache with its candidates

/// Rays from all around towards the middle: about as many hit as miss.
struct Rays {
    /// Whole cache lines, as in the wavefront's arena.
    template <class Value>
    struct alignas(64) Array : std::array<Value, ray_count> {};
    Array<double> meant[6];
    Array<float> rounded[7], first, second;
    Array<std::uint32_t> none, slot;
    std::vector<Ray<double>> scalar;

    explicit Rays(Random& r) {
        for (std::size_t i = 0; i < ray_count; ++i) {
            const Vec3d origin = convert<double>(4.0F * normalized(r.cube(1)));
            const Vec3d direction = normalized(convert<double>(r.cube(1)) - origin);
            scalar.push_back({origin, direction});
            for (int axis = 0; axis < 3; ++axis) {
                meant[axis][i] = origin[axis];
                meant[3 + axis][i] = direction[axis];
            }
        }
        none.fill(no_shape);
    }

    simd::RoundedRays view() {
        return {{rounded[0].data(), rounded[1].data(), rounded[2].data()},
                {rounded[3].data(), rounded[4].data(), rounded[5].data()},
                rounded[6].data(),
                none.data(),
                none.data(),
                {meant[0].data(), meant[1].data(), meant[2].data()},
                {meant[3].data(), meant[4].data(), meant[5].data()}};
    }
    simd::Candidates candidates() {
        first.fill(std::numeric_limits<float>::infinity());
        second.fill(std::numeric_limits<float>::infinity());
        slot.fill(simd::no_slot);
        return {first.data(), second.data(), slot.data()};
    }
};

template <class Shape>
struct Setup {
    Random random;
    Block<Shape> block;
    Rays rays{random};

    Setup() {
        for (int lane = 0; lane < block_size; ++lane)
            block.set(lane, make_shape<Shape>(random), static_cast<ShapeId>(lane));
    }

    simd::SceneView scene() const {
        simd::SceneView view{};
        view.tables[static_cast<int>(kind_of<Shape>)] = {
            block.values[0], 1, sizeof(block) / sizeof(float), number_count<Shape>, 0};
        return view;
    }
};

void count_items(benchmark::State& state) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ray_count) * block_size);
}

template <class Shape>
void scalar(benchmark::State& state) {
    Setup<Shape> setup;
    std::uint64_t widened = 0;
    for (auto _ : state)
        for (const Ray<double>& ray : setup.rays.scalar)
            for (int lane = 0; lane < block_size; ++lane)
                benchmark::DoNotOptimize(solve(setup.block.get(lane), ray, Start{}, widened));
    count_items(state);
}

template <class Shape>
void bounds(benchmark::State& state, const simd::Kernels& kernels) {
    Setup<Shape> setup;
    const simd::SceneView scene = setup.scene();
    const simd::RoundedRays rays = setup.rays.view();
    kernels.rays.round_rays(ray_count, rays, 0.0F);
    const auto exact = static_cast<std::size_t>(Precision::exact);
    simd::TraceCounters counters{};
    for (auto _ : state) {
        kernels.methods[exact].trace.nearest(scene, 1U << static_cast<int>(kind_of<Shape>), nullptr,
                                             ray_count, rays, setup.rays.candidates(), {},
                                             counters);
        benchmark::ClobberMemory();
    }
    count_items(state);
}

template <class Shape>
void add_kind() {
    const std::string name(name_of(kind_of<Shape>));
    benchmark::RegisterBenchmark((name + "/scalar").c_str(), scalar<Shape>);
    for (const simd::Isa isa : simd::available_isas()) {
        const simd::Kernels& kernels = simd::kernels_of(isa);
        benchmark::RegisterBenchmark(
            (name + "/bounds/" + kernels.name).c_str(),
            [&kernels](benchmark::State& state) { bounds<Shape>(state, kernels); });
    }
}

const bool registered = [] {
    bench::for_each_kind([]<class Shape>() { add_kind<Shape>(); });
    return true;
}();

} // namespace
