#include "core/shape_table.hpp"
#include "core/solve.hpp"
#include "simd/isa.hpp"

#include <benchmark/benchmark.h>

#include <bit>
#include <random>
#include <string>
#include <vector>

/// Each kernel's time per hit that it finishes in double: rays in packets that hit the same shape,
/// or each another shape of one kind. `doubtful` is the share that is left to a scalar solver.

namespace {

using namespace raylane;
using namespace raylane::core;

constexpr std::size_t ray_count = 256; // fits the first-level cache with its hits
constexpr int shape_count = 64;

class Random {
  public:
    float uniform(float low, float high) {
        return low + (high - low) * (static_cast<float>(engine_() >> 8) * 0x1p-24F);
    }
    Vec3f cube(float size) {
        return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }
    int integer(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

  private:
    std::mt19937 engine_{1};
};

/// A shape of a size of about 1 within 1 of the origin.
template <class Shape>
Shape make(Random& r) {
    const Vec3f a = r.cube(1), b = r.cube(1), c = r.cube(1), d = r.cube(1);
    if constexpr (kind_of<Shape> == Kind::sphere) return {a, r.uniform(0.3F, 1)};
    if constexpr (kind_of<Shape> == Kind::plane) return {a, b};
    if constexpr (kind_of<Shape> == Kind::disc) return {a, b, r.uniform(0.5F, 1.5F)};
    if constexpr (kind_of<Shape> == Kind::triangle) return {2.0F * a, 2.0F * b, 2.0F * c};
    if constexpr (kind_of<Shape> == Kind::smooth_triangle)
        return {2.0F * a, 2.0F * b, 2.0F * c, a, b, c};
    if constexpr (kind_of<Shape> == Kind::box) return {a, b, c, d};
    if constexpr (kind_of<Shape> == Kind::open_cylinder || kind_of<Shape> == Kind::capped_cylinder)
        return {a, 2.0F * b, r.uniform(0.2F, 0.8F)};
    if constexpr (kind_of<Shape> == Kind::open_cone || kind_of<Shape> == Kind::capped_cone)
        return {a, 2.0F * b, r.uniform(0.3F, 1), r.uniform(0, 0.3F)};
    if constexpr (kind_of<Shape> == Kind::quadric) {
        const auto square = [&] { return r.uniform(0.5F, 3); };
        return {a, square(), square(), square(), 0.1F,         0.2F,       0.1F,
                0, 0,        0,        -1,       Vec3f(-0.7F), Vec3f(0.7F)};
    }
}

/// Rays from outside, each with a shape that it does hit.
template <class Shape>
struct Setup {
    Random random;
    std::vector<Block<Shape>> blocks{shape_count / block_size};
    std::vector<double> ox, oy, oz, dx, dy, dz;
    std::vector<std::uint32_t> slots;
    std::vector<double> out[8];
    std::vector<std::uint32_t> none, departure, hit;

    explicit Setup(bool one_shape) {
        for (int i = 0; i < shape_count; ++i)
            blocks[i / block_size].set(i % block_size, make<Shape>(random), ShapeId(i));
        int shape = random.integer(shape_count);
        while (slots.size() < ray_count) {
            if (!one_shape || slots.size() % 64 == 0) shape = random.integer(shape_count);
            add(shape);
        }
        none.assign(ray_count, no_shape);
        departure.assign(ray_count, 0);
        hit.assign(ray_count, 0);
        for (std::vector<double>& array : out)
            array.assign(ray_count, 0.0);
    }

    simd::SceneView scene() const {
        simd::SceneView view{};
        view.tables[static_cast<int>(kind_of<Shape>)] = {
            reinterpret_cast<const float*>(blocks.data()),
            static_cast<std::uint32_t>(blocks.size()), sizeof(Block<Shape>) / sizeof(float),
            float_count<Shape>, 0};
        return view;
    }

    simd::Found found() {
        return {ray_count,
                {ox.data(), oy.data(), oz.data()},
                {dx.data(), dy.data(), dz.data()},
                none.data(),
                none.data(),
                departure.data(),
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
void finish(benchmark::State& state, const simd::Kernels& kernels, bool one_shape) {
    Setup<Shape> setup(one_shape);
    const simd::SceneView scene = setup.scene();
    const simd::Found found = setup.found();
    for (auto _ : state) {
        kernels.finish(scene, found);
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
    for (const simd::Isa isa : simd::all_isas) {
        if (!simd::is_available(isa)) continue;
        const simd::Kernels& kernels = simd::kernels_of(isa);
        for (const bool one_shape : {true, false})
            benchmark::RegisterBenchmark(
                (name + (one_shape ? "/finish_one_shape/" : "/finish_shapes/") + kernels.name)
                    .c_str(),
                [&kernels, one_shape](benchmark::State& state) {
                    finish<Shape>(state, kernels, one_shape);
                });
    }
}

const bool registered = [] {
    add_kind<Sphere>();
    add_kind<Plane>();
    add_kind<Disc>();
    add_kind<Triangle>();
    add_kind<SmoothTriangle>();
    add_kind<Box>();
    add_kind<OpenCylinder>();
    add_kind<CappedCylinder>();
    add_kind<OpenCone>();
    add_kind<CappedCone>();
    add_kind<Quadric>();
    return true;
}();

} // namespace
