#include "simd/isa.hpp"
#include "simd/wavefront/scene_data.hpp"
#include "simd/wavefront/tracing.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

/// Rays that have nothing in common through the hierarchy of many small spheres, rays per second.

namespace {

using namespace raylane;
using core::Vec3d;

constexpr std::size_t ray_count = std::size_t{1} << 16;
constexpr std::size_t wave = 4096;

struct Setup {
    core::Scene scene;
    simd::SceneData data{scene};
    std::vector<double> of[6];
    std::vector<float> rounded[7], t_most;
    std::vector<std::uint32_t> departed;

    explicit Setup(int spheres) : scene(make(spheres)) {
        std::mt19937_64 engine(2);
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        std::normal_distribution<double> normal;
        for (std::vector<float>& values : rounded)
            values.resize(ray_count);
        departed.assign(ray_count, simd::no_slot);
        for (std::size_t i = 0; i < ray_count; ++i) {
            const Vec3d direction =
                core::normalized(Vec3d(normal(engine), normal(engine), normal(engine)));
            for (int axis = 0; axis < 3; ++axis) {
                of[axis].push_back(uniform(engine));
                of[3 + axis].push_back(direction[axis]);
            }
            t_most.push_back(static_cast<float>(0.3 * uniform(engine)));
        }
    }

    static core::Scene make(int spheres) {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        std::mt19937 engine(1);
        std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
        const float radius = 0.3F / std::cbrt(static_cast<float>(spheres));
        for (int i = 0; i < spheres; ++i)
            builder.add(core::Sphere{{uniform(engine), uniform(engine), uniform(engine)}, radius},
                        0);
        return std::move(builder).build();
    }

    simd::RoundedRays rays(std::size_t from) {
        return {{&rounded[0][from], &rounded[1][from], &rounded[2][from]},
                {&rounded[3][from], &rounded[4][from], &rounded[5][from]},
                &rounded[6][from],
                &departed[from],
                &departed[from],
                {&of[0][from], &of[1][from], &of[2][from]},
                {&of[3][from], &of[4][from], &of[5][from]}};
    }
};

Setup& setup_of(int spheres) {
    static std::map<int, Setup> all;
    return all.try_emplace(spheres, spheres).first->second;
}

void trace(benchmark::State& state, simd::Isa isa, core::Precision precision, int spheres,
           bool shadows) {
    Setup& setup = setup_of(spheres);
    const simd::Tracing tracing{&simd::kernels_of(isa), precision};
    const simd::TraceKernels& kernels = tracing.method().trace;
    tracing.kernels->rays.round_rays(ray_count, setup.rays(0));
    const std::size_t entries =
        std::size_t{simd::in_flight} * 16 * (setup.data.view().tree_depth + 1) + 16;
    std::vector<float> t(entries), first(wave), second(wave);
    std::vector<std::uint32_t> child(entries), slot(wave);
    std::vector<std::uint8_t> states(wave);
    simd::TraceCounters counters{};
    std::size_t from = 0;
    for (auto _ : state) {
        std::fill(first.begin(), first.end(), std::numeric_limits<float>::infinity());
        second = first;
        std::fill(states.begin(), states.end(), simd::open);
        if (shadows)
            kernels.occluded(setup.data.view(), 0, nullptr, wave, setup.rays(from),
                             {&setup.t_most[from], states.data()}, {t.data(), child.data()},
                             counters);
        else
            kernels.nearest(setup.data.view(), 0, nullptr, wave, setup.rays(from),
                            {first.data(), second.data(), slot.data()}, {t.data(), child.data()},
                            counters);
        from = (from + wave) % ray_count;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(wave) * state.iterations());
}

const bool registered = [] {
    for (const int spheres : {10'000, 100'000, 1'000'000})
        for (const bool shadows : {false, true})
            for (const simd::Isa isa : simd::all_isas)
                if (simd::is_available(isa))
                    benchmark::RegisterBenchmark(
                        ("trace/" + std::to_string(spheres) +
                         (shadows ? "/occluded/" : "/nearest/") + std::string(simd::name_of(isa)))
                            .c_str(),
                        [=](benchmark::State& state) {
                            trace(state, isa, core::Precision::exact, spheres, shadows);
                        });
    return true;
}();

} // namespace
