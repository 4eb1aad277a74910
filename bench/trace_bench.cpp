#include "simd/isa/isa.hpp"
#include "simd/query/query.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

/// Measures incoherent rays through the hierarchy of many small shapes, in rays per second: the
/// nearest hit with everything that follows, up to the scalar reference's decision in doubtful
/// cases; and occlusion. `left` is the share of rays that are not decided in packets.

namespace {

using namespace raylane;
using core::Vec3d, core::Vec3f;

constexpr std::size_t ray_count = std::size_t{1} << 16;
constexpr std::size_t wave = 4096;

/// Shapes that a scene is made of.
enum class Mix { spheres, cylinders, cones, mixed };
constexpr const char* mix_names[] = {"spheres", "cylinders", "cones", "mixed"};

class Maker {
  public:
    core::Scene make(Mix mix, int count) {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        const float size = 0.3F / std::cbrt(static_cast<float>(count));
        for (int i = 0; i < count; ++i)
            add(builder, mix == Mix::mixed ? static_cast<Mix>(i % 3) : mix, size);
        return std::move(builder).build();
    }

  private:
    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine_);
    }
    Vec3f within(float low, float high) {
        return {uniform(low, high), uniform(low, high), uniform(low, high)};
    }

    void add(core::SceneBuilder& builder, Mix mix, float size) {
        const Vec3f place = within(0.0F, 1.0F);
        if (mix == Mix::spheres) {
            builder.add(core::Sphere{place, size}, 0);
            return;
        }
        const Vec3f axis = within(-size, size) + Vec3f(0.25F * size);
        if (mix == Mix::cylinders)
            builder.add(core::CappedCylinder{place, axis, 0.5F * size}, 0);
        else
            builder.add(core::CappedCone{place, axis, 0.7F * size, uniform(0.0F, 0.35F) * size}, 0);
    }

    std::mt19937 engine_{1};
};

struct Setup {
    core::Scene scene;
    simd::SceneData data{scene};
    std::vector<simd::Arena> arenas;
    std::vector<simd::Paths> waves;
    std::vector<double> t_limit;

    Setup(Mix mix, int count) : scene(Maker().make(mix, count)) {
        std::mt19937_64 engine(2);
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        std::normal_distribution<double> normal;
        for (std::size_t first = 0; first < ray_count; first += wave) {
            simd::Paths paths{};
            arenas.push_back(
                simd::arena_for([&](simd::Arena& a) { paths.take_from(a, wave, false); }));
            paths.count = wave;
            paths.start_nowhere(0, wave);
            for (std::size_t i = 0; i < wave; ++i) {
                const Vec3d direction =
                    core::normalized(Vec3d(normal(engine), normal(engine), normal(engine)));
                for (int axis = 0; axis < 3; ++axis) {
                    paths.origin[axis][i] = uniform(engine);
                    paths.direction[axis][i] = direction[axis];
                }
                t_limit.push_back(0.3 * static_cast<double>(uniform(engine)));
            }
            waves.push_back(paths);
        }
    }

    static Setup& of(Mix mix, int count) {
        static std::map<std::pair<Mix, int>, std::unique_ptr<Setup>> setups;
        std::unique_ptr<Setup>& setup = setups[{mix, count}];
        if (setup == nullptr) setup = std::make_unique<Setup>(mix, count);
        return *setup;
    }
};

void report(benchmark::State& state, std::uint64_t left) {
    const auto rays = static_cast<double>(wave) * static_cast<double>(state.iterations());
    state.SetItemsProcessed(static_cast<std::int64_t>(wave) * state.iterations());
    state.counters["left"] = static_cast<double>(left) / rays;
}

void nearest(benchmark::State& state, const Setup& setup, const simd::Tracing& tracing) {
    simd::Query finder(setup.data, tracing, simd::Asked::points);
    const simd::Arena arena = simd::arena_for([&](simd::Arena& a) { finder.take_from(a, wave); });
    simd::EngineCounters counters;
    std::size_t next = 0;
    for (auto _ : state)
        finder.nearest(setup.waves[next++ % setup.waves.size()], nullptr, counters);
    report(state, counters.doubtful);
}

void occluded(benchmark::State& state, const Setup& setup, const simd::Tracing& tracing) {
    simd::Query query(setup.data, tracing, simd::Asked::points);
    const simd::Arena arena = simd::arena_for([&](simd::Arena& a) { query.take_from(a, wave); });
    std::vector<std::uint8_t> states(wave);
    simd::EngineCounters counters;
    std::size_t next = 0;
    std::uint64_t left = 0;
    for (auto _ : state) {
        const std::size_t at = next++ % setup.waves.size();
        std::fill(states.begin(), states.end(), simd::unblocked);
        query.occluded(setup.waves[at].columns(), &setup.t_limit[at * wave], states.data(), nullptr,
                       counters);
        left += static_cast<std::uint64_t>(
            std::count_if(states.begin(), states.end(), [](std::uint8_t found) {
                return found != simd::unblocked && found != simd::blocked;
            }));
    }
    report(state, left);
}

const bool registered = [] {
    for (const Mix mix : {Mix::spheres, Mix::cylinders, Mix::cones, Mix::mixed})
        for (const int count : {10'000, 100'000, 1'000'000})
            for (const bool shadows : {false, true})
                for (const core::Precision precision : core::all_precisions)
                    for (const simd::Isa isa : simd::available_isas()) {
                        const std::string name =
                            "trace/" + std::string(mix_names[static_cast<int>(mix)]) + "/" +
                            std::to_string(count) + (shadows ? "/occluded/" : "/nearest/") +
                            std::string(name_of(precision)) + "/" + std::string(name_of(isa));
                        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
                            (shadows ? occluded : nearest)(state, Setup::of(mix, count),
                                                           {&simd::kernels_of(isa), precision});
                        });
                    }
    return true;
}();

} // namespace
