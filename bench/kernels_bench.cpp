#include "bench/random_shapes.hpp"
#include "core/scene/shape_table.hpp"
#include "core/shapes/solve.hpp"
#include "simd/isa.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

/// Each kernel's speed, in rays tested against one shape per second, beside its error in ulps of t
/// against the certified double reference, over the same rays; and the scalar float reference in
/// the same run.

namespace {

using namespace raylane;
using namespace raylane::core;
using bench::make_shape;
using bench::Random;

constexpr std::size_t ray_count = 256; // fits the first-level cache with its hits

/// Rays from all around at the middle: about as many hit as miss.
struct Rays {
    /// Whole lines of the cache, as the wavefront's arena has them.
    struct alignas(64) Array : std::array<float, ray_count> {};
    Array ox, oy, oz, dx, dy, dz, none, zero, t, shape, face, entering;
    std::vector<Ray<float>> scalar;

    explicit Rays(Random& r) {
        for (std::size_t i = 0; i < ray_count; ++i) {
            const Vec3f origin = 4.0F * normalized(r.cube(1));
            const Vec3f direction = normalized(r.cube(1) - origin);
            scalar.push_back({origin, direction});
            ox[i] = origin.x;
            oy[i] = origin.y;
            oz[i] = origin.z;
            dx[i] = direction.x;
            dy[i] = direction.y;
            dz[i] = direction.z;
        }
        none.fill(std::bit_cast<float>(no_shape));
        zero.fill(0.0F);
        reset();
    }

    void reset() {
        t.fill(std::numeric_limits<float>::infinity());
        shape.fill(std::bit_cast<float>(no_shape));
        face.fill(0.0F);
        entering.fill(0.0F);
    }

    simd::PacketStream view() {
        return {ray_count,
                {ox.data(), oy.data(), oz.data()},
                {dx.data(), dy.data(), dz.data()},
                none.data(),
                none.data(),
                zero.data(),
                zero.data(),
                t.data(),
                shape.data(),
                face.data(),
                entering.data()};
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

    simd::ShapeBlock view() const {
        return {block.values, reinterpret_cast<const float*>(block.ids)};
    }
};

template <class Real>
Real nearest(const auto& block, const Ray<Real>& ray, Real t) {
    std::uint64_t widened = 0;
    for (int lane = 0; lane < block_size; ++lane)
        for (const core::Crossing<Real>& crossing : solve(block.get(lane), ray, Start{}, widened))
            if (crossing.t > Real(0) && crossing.t < t) t = crossing.t;
    return t;
}

/// Median and largest error of the t in `setup.rays`, in ulps, and the share of wrong decisions.
template <class Shape>
void report(benchmark::State& state, Setup<Shape>& setup) {
    std::vector<double> ulps;
    int wrong = 0;
    for (std::size_t i = 0; i < ray_count; ++i) {
        const Ray<double> ray{convert<double>(setup.rays.scalar[i].origin),
                              convert<double>(setup.rays.scalar[i].direction)};
        const double truth = nearest(setup.block, ray, std::numeric_limits<double>::infinity());
        const float t = setup.rays.t[i];
        if (std::isinf(truth) != std::isinf(t)) ++wrong;
        if (std::isinf(truth) || std::isinf(t)) continue;
        const double ulp = static_cast<double>(std::nextafter(t, 1e30F)) - static_cast<double>(t);
        ulps.push_back(std::abs(static_cast<double>(t) - truth) / ulp);
    }
    std::sort(ulps.begin(), ulps.end());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ray_count) * block_size);
    if (ulps.empty()) return;
    state.counters["ulp_median"] = ulps[ulps.size() / 2];
    state.counters["ulp_p99"] = ulps[ulps.size() * 99 / 100];
    state.counters["ulp_max"] = ulps.back();
    state.counters["wrong"] = wrong;
}

template <class Shape>
void scalar(benchmark::State& state) {
    Setup<Shape> setup;
    for (auto _ : state) {
        for (std::size_t i = 0; i < ray_count; ++i)
            setup.rays.t[i] =
                nearest(setup.block, setup.rays.scalar[i], std::numeric_limits<float>::infinity());
        benchmark::ClobberMemory();
    }
    report(state, setup);
}

template <class Shape>
void one_shape(benchmark::State& state, const simd::Kernels& kernels) {
    Setup<Shape> setup;
    simd::PacketStream view = setup.rays.view();
    for (auto _ : state) {
        for (int lane = 0; lane < block_size; ++lane)
            kernels.intersect_rays(static_cast<simd::KindNumber>(kind_of<Shape>), setup.view(),
                                   lane, view);
        benchmark::ClobberMemory();
    }
    report(state, setup);
}

template <class Shape>
void one_ray(benchmark::State& state, const simd::Kernels& kernels) {
    Setup<Shape> setup;
    simd::PacketStream view = setup.rays.view();
    for (auto _ : state) {
        for (std::size_t i = 0; i < ray_count; ++i)
            kernels.intersect_block(static_cast<simd::KindNumber>(kind_of<Shape>), setup.view(),
                                    view, i);
        benchmark::ClobberMemory();
    }
    report(state, setup);
}

template <class Shape>
void add_kind() {
    const std::string name(name_of(kind_of<Shape>));
    benchmark::RegisterBenchmark((name + "/scalar").c_str(), scalar<Shape>);
    for (const simd::Isa isa : simd::all_isas) {
        if (!simd::is_available(isa)) continue;
        const simd::Kernels& kernels = simd::kernels_of(isa);
        benchmark::RegisterBenchmark(
            (name + "/one_shape/" + kernels.name).c_str(),
            [&kernels](benchmark::State& state) { one_shape<Shape>(state, kernels); });
        benchmark::RegisterBenchmark(
            (name + "/one_ray/" + kernels.name).c_str(),
            [&kernels](benchmark::State& state) { one_ray<Shape>(state, kernels); });
    }
}

const bool registered = [] {
    bench::for_each_kind([]<class Shape>() { add_kind<Shape>(); });
    return true;
}();

} // namespace
