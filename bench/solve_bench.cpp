#include "bench/random_shapes.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/shapes/solve.hpp"
#include "simd/isa/isa.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

/// Measures the time that each kernel takes to solve one hit in double. Either all rays of a packet
/// hit the same shape, or each ray hits a random shape of one kind. `doubtful` is the share of hits
/// that the kernel leaves to a scalar solver.

namespace {

using namespace raylane;
using namespace raylane::core;
using bench::make_shape;
using bench::Random;

constexpr std::size_t ray_count = 256; // fits the first-level cache with its hits
constexpr int shape_count = 64;

/// Rays from outside, each with a shape that it hits.
template <class Shape>
struct Setup {
    Random random;
    std::vector<Block<Shape>> blocks{shape_count / block_size};
    std::vector<double> ox, oy, oz, dx, dy, dz;
    std::vector<std::uint32_t> slots;
    std::vector<double> out[8];
    std::vector<std::uint32_t> none, origins, hit;

    explicit Setup(bool one_shape) {
        for (int i = 0; i < shape_count; ++i)
            blocks[i / block_size].set(i % block_size, make_shape<Shape>(random), ShapeId(i));
        int shape = random.integer(shape_count);
        while (slots.size() < ray_count) {
            if (!one_shape || slots.size() % 64 == 0) shape = random.integer(shape_count);
            add(shape);
        }
        none.assign(ray_count, no_shape);
        origins.assign(ray_count, 0);
        hit.assign(ray_count, 0);
        for (std::vector<double>& array : out)
            array.assign(ray_count, 0.0);
    }

    simd::SceneView scene() const {
        simd::SceneView view{};
        view.tables[static_cast<int>(kind_of<Shape>)] = {
            reinterpret_cast<const float*>(blocks.data()),
            static_cast<std::uint32_t>(blocks.size()), sizeof(Block<Shape>) / sizeof(float),
            number_count<Shape>, 0};
        return view;
    }

    simd::Found found() {
        return {ray_count,
                {ox.data(), oy.data(), oz.data()},
                {dx.data(), dy.data(), dz.data()},
                none.data(),
                none.data(),
                origins.data(),
                slots.data(),
                out[0].data(),
                out[1].data(),
                {out[2].data(), out[3].data(), out[4].data()},
                {out[5].data(), out[6].data(), out[7].data()},
                hit.data()};
    }

  private:
    void add(int shape) {
        std::uint64_t widened = 0;
        for (int attempt = 0; attempt < 100; ++attempt) {
            const Vec3d origin = 4.0 * normalized(convert<double>(random.cube(1)));
            const Vec3d direction = normalized(convert<double>(random.cube(1)) - origin);
            const auto crossings = solve(blocks[shape / block_size].get(shape % block_size),
                                         Ray<double>{origin, direction}, Start{}, widened);
            if (crossings.begin() == crossings.end() || !(crossings.begin()->t > 0.0)) continue;
            ox.push_back(origin.x);
            oy.push_back(origin.y);
            oz.push_back(origin.z);
            dx.push_back(direction.x);
            dy.push_back(direction.y);
            dz.push_back(direction.z);
            slots.push_back(static_cast<std::uint32_t>(shape));
            return;
        }
        add((shape + 1) % shape_count); // too small to be hit by chance
    }
};

template <class Shape>
void solve(benchmark::State& state, const simd::Kernels& kernels, bool one_shape) {
    Setup<Shape> setup(one_shape);
    const simd::SceneView scene = setup.scene();
    const simd::Found found = setup.found();
    for (auto _ : state) {
        kernels.methods[static_cast<std::size_t>(Precision::exact)].solve(scene, found);
        benchmark::ClobberMemory();
    }
    std::size_t doubtful = 0;
    for (const std::uint32_t hit : setup.hit)
        doubtful += (hit & simd::hit_doubtful) != 0 ? 1 : 0;
    state.counters["doubtful"] = static_cast<double>(doubtful) / ray_count;
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ray_count));
    state.counters["per_hit"] = benchmark::Counter(static_cast<double>(ray_count),
                                                   benchmark::Counter::kIsIterationInvariantRate |
                                                       benchmark::Counter::kInvert);
}

template <class Shape>
void add_kind() {
    const std::string name(name_of(kind_of<Shape>));
    for (const simd::Isa isa : simd::available_isas()) {
        const simd::Kernels& kernels = simd::kernels_of(isa);
        for (const bool one_shape : {true, false})
            benchmark::RegisterBenchmark(
                (name + (one_shape ? "/solve_one_shape/" : "/solve_shapes/") + kernels.name)
                    .c_str(),
                [&kernels, one_shape](benchmark::State& state) {
                    solve<Shape>(state, kernels, one_shape);
                });
    }
}

const bool registered = [] {
    bench::for_each_kind([]<class Shape>() { add_kind<Shape>(); });
    return true;
}();

} // namespace
