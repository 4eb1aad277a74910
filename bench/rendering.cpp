#include "bench/rendering.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>

namespace raylane::bench {

namespace {

using Clock = std::chrono::steady_clock;

void draw(benchmark::State& state, const core::Scene& scene, const simd::RenderOptions& options) {
    simd::EngineCounters counters;
    double seconds = 0.0;
    for (auto _ : state) {
        const Clock::time_point start = Clock::now();
        counters += simd::render(scene, scene.settings(), options).counters;
        seconds += std::chrono::duration<double>(Clock::now() - start).count();
    }
    using benchmark::Counter;
    const auto images = static_cast<double>(state.iterations());
    const auto per_image = [&](std::uint64_t count) {
        return Counter(static_cast<double>(count) / images);
    };
    state.counters["seconds"] = seconds / images;
    // Rates use the thread's processor time, which other work on the machine disturbs less.
    state.counters["rays/s"] = Counter(static_cast<double>(counters.rays()), Counter::kIsRate);
    state.counters["per_primary"] =
        Counter(static_cast<double>(counters.primary), Counter::kIsRate | Counter::kInvert);
    state.counters["primary"] = per_image(counters.primary);
    state.counters["reflected"] = per_image(counters.reflected);
    state.counters["refracted"] = per_image(counters.refracted);
    state.counters["passed"] = per_image(counters.passed);
    state.counters["shadow"] = per_image(counters.shadow);
}

void add(const std::string& name, const MakeScene& make_scene, simd::RenderOptions options) {
    options.threads = 1;
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        draw(state, *make_scene(), options);
    })->Unit(benchmark::kMillisecond);
}

} // namespace

void add_renderings(const std::string& name, const MakeScene& make_scene) {
    simd::RenderOptions options;
    for (const simd::Isa isa : simd::available_isas()) {
        options.isa = isa;
        add(name + "/" + simd::kernels_of(isa).name, make_scene, options);
    }
    options.engine = simd::Engine::reference;
    options.precision = core::Precision::robust;
    add(name + "/reference_float", make_scene, options);
    options.precision = core::Precision::exact;
    add(name + "/reference_double", make_scene, options);
}

} // namespace raylane::bench
