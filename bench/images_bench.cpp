#include "core/shapes/precision.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/wavefront/render.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

/// Measures the cost of an image, and its distance from a converged one: of 1,024 samples per pixel
/// at other places, with long paths and in double precision. The benchmarks vary precision and
/// samples; quality; the depth of reflections; and the throughput below which paths end.
///
/// picture/SCENE/WHAT/PRECISION/VALUE: WHAT is `samples` (per pixel), `quality` (decibels), `depth`
/// or `weight` (per mille), with counters `seconds` of wall time on one thread and `rmse` of linear
/// light. All use the widest instruction set. Beside AVX-512, `samples-avx2` and `quality-avx2`
/// measure AVX2 as well.

namespace {

using namespace raylane;
using Clock = std::chrono::steady_clock;

constexpr int converged_grid = 32, best_grid = 8, usual_grid = 2;

/// A scene and its converged image, made at the first request.
struct Subject {
    core::Scene scene;
    core::Settings settings; ///< small enough to measure many
    core::Film converged;

    explicit Subject(core::Scene loaded)
        : scene(std::move(loaded)), settings(small(scene.settings())),
          converged(render(to_converge(), core::Precision::plain_double).film) {}

    static const Subject& of(const std::string& name) {
        static std::map<std::string, std::unique_ptr<Subject>> subjects;
        std::unique_ptr<Subject>& subject = subjects[name];
        if (subject == nullptr)
            subject = std::make_unique<Subject>(scenes::load_scene(
                std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes" / (name + ".json")));
        return *subject;
    }

    core::Settings with_grid(int grid) const {
        core::Settings changed = settings;
        changed.grid = grid;
        return changed;
    }

    simd::Rendering render(const core::Settings& with, core::Precision precision,
                           simd::Isa isa = simd::best_isa()) const {
        return simd::render(scene, with, {.isa = isa, .precision = precision, .threads = 1});
    }

  private:
    /// Returns settings whose samples are at other places than those of the images compared with
    /// it.
    core::Settings to_converge() const {
        core::Settings changed = with_grid(converged_grid);
        changed.samples = core::SamplePattern::stratified;
        return changed;
    }

    static core::Settings small(core::Settings settings) {
        settings.height = 400 * settings.height / settings.width;
        settings.width = 400;
        settings.quality = 0.0F;
        settings.max_depth = 16;
        settings.min_weight = 0.0002F;
        return settings;
    }
};

/// Returns the root mean square difference of all components.
double rmse(const core::Film& a, const core::Film& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        squares += core::squared_length(core::convert<double>(a.pixels()[i]) -
                                        core::convert<double>(b.pixels()[i]));
    return std::sqrt(squares / (3.0 * static_cast<double>(a.pixels().size())));
}

using Change = void (*)(core::Settings&, int value);

void draw(benchmark::State& state, const std::string& name, core::Precision precision,
          simd::Isa isa, Change change, int value) {
    const Subject& subject = Subject::of(name);
    core::Settings settings = subject.with_grid(usual_grid);
    change(settings, value);
    double seconds = 0.0;
    core::Film film(1, 1);
    for (auto _ : state) {
        const Clock::time_point start = Clock::now();
        film = subject.render(settings, precision, isa).film;
        seconds += std::chrono::duration<double>(Clock::now() - start).count();
    }
    state.counters["seconds"] = seconds / static_cast<double>(state.iterations());
    state.counters["rmse"] = rmse(film, subject.converged);
}

void add(const std::string& scene, const std::string& what, core::Precision precision,
         Change change, int value, simd::Isa isa = simd::best_isa()) {
    std::string name = "picture/" + scene + "/" + what;
    if (isa != simd::best_isa()) name.append("-").append(name_of(isa));
    name.append("/").append(name_of(precision)).append("/").append(std::to_string(value));
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        draw(state, scene, precision, isa, change, value);
    })->Unit(benchmark::kMillisecond);
}

/// Returns the widest instruction set, and AVX2 if that is AVX-512.
std::vector<simd::Isa> isas_to_compare() {
    std::vector<simd::Isa> isas = {simd::best_isa()};
    if (isas[0] == simd::Isa::avx512 && simd::is_available(simd::Isa::avx2))
        isas.push_back(simd::Isa::avx2);
    return isas;
}

void add_samples(const std::string& scene, core::Precision precision, simd::Isa isa) {
    for (const int grid : {1, 2, 3, 4, 6, best_grid})
        add(
            scene, "samples", precision,
            [](core::Settings& settings, int samples) {
                settings.grid = static_cast<int>(std::lround(std::sqrt(samples)));
            },
            grid * grid, isa);
}

void add_quality(const std::string& scene, simd::Isa isa) {
    for (const int decibels : {30, 34, 38, 42, 46, 50})
        add(
            scene, "quality", core::Precision::exact,
            [](core::Settings& settings, int value) {
                settings.quality = static_cast<float>(value);
            },
            decibels, isa);
}

const bool registered = [] {
    for (const char* scene :
         {"birthday", "sphereflake", "lattice", "mirrors", "glass-block", "quadric"}) {
        for (const core::Precision precision : core::all_precisions)
            if (precision != core::Precision::exact)
                add_samples(scene, precision, simd::best_isa());
        for (const simd::Isa isa : isas_to_compare()) {
            add_samples(scene, core::Precision::exact, isa);
            add_quality(scene, isa);
        }
        for (const int depth : {0, 1, 2, 3, 5, 8})
            add(
                scene, "depth", core::Precision::exact,
                [](core::Settings& settings, int value) {
                    settings.grid = best_grid;
                    settings.max_depth = value;
                },
                depth);
        for (const int per_mille : {500, 200, 50, 10, 2})
            add(
                scene, "weight", core::Precision::exact,
                [](core::Settings& settings, int value) {
                    settings.grid = best_grid;
                    settings.min_weight = static_cast<float>(value) / 1000.0F;
                },
                per_mille);
    }
    return true;
}();

} // namespace
