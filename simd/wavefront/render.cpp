#include "simd/wavefront/render.hpp"

#include "core/optics/spectrum.hpp"
#include "core/reference/tracer.hpp"
#include "core/scene/validate.hpp"
#include "simd/first_hits/first_hits.hpp"
#include "simd/first_hits/outlines.hpp"
#include "simd/threads/default_rounding.hpp"
#include "simd/threads/per_thread.hpp"
#include "simd/threads/threads.hpp"
#include "simd/wavefront/wavefront.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace raylane::simd {

namespace {

core::Region whole_of(const core::Settings& settings) {
    return {0, 0, settings.width, settings.height};
}

/// Computes everything that needs first hits, tile by tile: AOVs beside the colours, and outlines
/// over them. To be used by one thread.
class FirstHitPasses {
  public:
    FirstHitPasses(const SceneData& scene, const core::Settings& settings, const Kernels& kernels)
        : tracer_(std::make_unique<FirstHits>(scene, settings, kernels)),
          outlines_(*tracer_, settings.outline), draws_(settings.outline.any()) {}

    static bool are_wanted(const core::Settings& settings, const RenderOptions& options) {
        return options.aovs || settings.outline.any();
    }

    void run(const core::Region& tile, const core::Region& crop, Rendering& rendering) {
        if (draws_) outlines_.draw(tile, rendering.film);
        const core::Region part = tile.within(crop);
        if (rendering.aovs.width != 0 && part.x0 < part.x1 && part.y0 < part.y1)
            fill_aovs(*tracer_, part, crop, rendering.aovs);
    }

  private:
    std::unique_ptr<FirstHits> tracer_;
    Outlines outlines_;
    bool draws_;
};

template <class Tracer>
void note_samples(const Tracer& tracer, const core::Region& tile, const core::Region& crop,
                  core::Aovs& aovs) {
    const core::Region part = tile.within(crop);
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            aovs.samples[aovs.index(x - crop.x0, y - crop.y0)] = static_cast<std::uint32_t>(
                tracer.samples_of(static_cast<std::size_t>(y - tile.y0) *
                                      static_cast<unsigned>(tile.x1 - tile.x0) +
                                  static_cast<unsigned>(x - tile.x0)));
}

/// One survey for each wavelength, or a single one. Empty if the image has no quality.
using Surveys = std::vector<core::Survey>;

core::Survey* survey_of(Surveys& surveys, std::size_t image) {
    return surveys.empty() ? nullptr : &surveys[image];
}

Surveys surveys_of(std::span<const core::Scene> scenes, const core::Settings& settings) {
    Surveys surveys;
    if (settings.quality != 0.0F)
        for (const core::Scene& of_image : scenes)
            surveys.emplace_back(of_image, settings);
    return surveys;
}

bool is_stopped(const RenderOptions& options) {
    return options.progress != nullptr && (options.progress->abandon || options.progress->stop);
}

/// Takes the samples of all surveys, unless the image is stopped.
template <class Tracer>
void take_samples(Surveys& surveys, PerThread<Tracer>& tracers, const RenderOptions& options) {
    if (surveys.empty() || is_stopped(options)) return;
    for (const auto pass : core::Survey::passes) {
        // Each wavelength has a survey, whose number of batches may differ.
        std::size_t batches = 0;
        for (const core::Survey& survey : surveys)
            batches = std::max(batches, survey.batches(pass));
        on_threads(options.threads, [&] {
            parallel_for(batches, [&](std::size_t batch) {
                if (!is_stopped(options)) tracers.local().survey(pass, batch);
            });
        });
        if (is_stopped(options)) break; // the pass may be incomplete; no tile is rendered then
        for (core::Survey& survey : surveys)
            survey.end(pass);
    }
}

/// `scenes`: one for each survey. `scene`: null if nothing needs first hits. `complete_ones`:
/// surveys, or null.
template <class Tracer>
Rendering render_by(const std::function<Tracer(Surveys&)>& make_tracer,
                    std::span<const core::Scene> scenes, const core::Settings& settings,
                    const RenderOptions& options, const SceneData* scene,
                    const Surveys* complete_ones = nullptr) {
    const TileGrid grid = grid_of(settings, options);
    const core::Region part = grid.part(), crop = options.crop.value_or(part);
    Rendering rendering{core::Film(part, settings.alpha), {}, {}};
    if (options.aovs) rendering.aovs = {crop.x1 - crop.x0, crop.y1 - crop.y0};
    Surveys surveys = complete_ones != nullptr ? *complete_ones : surveys_of(scenes, settings);
    PerThread<Tracer> tracers([&] { return make_tracer(surveys); });
    PerThread<FirstHitPasses> passes(
        [&] { return FirstHitPasses(*scene, settings, kernels_of(options.isa)); });
    const auto is_abandoned = [&] {
        return options.progress != nullptr && options.progress->abandon;
    };
    PerThread<EngineCounters> recalled([] { return EngineCounters(); });
    std::atomic<bool> complete = true;
    const auto draw = [&](const core::Region& region) {
        if (is_stopped(options)) {
            complete = false;
            return;
        }
        EngineCounters of_tile;
        if (options.recall && options.recall({region, rendering.film, rendering.aovs, of_tile})) {
            recalled.local() += of_tile;
            if (options.progress != nullptr) {
                options.progress->recalled += region.pixels();
                options.progress->pixels += region.pixels();
            }
            return;
        }
        Tracer& tracer = tracers.local();
        EngineCounters before;
        before += tracer.counters();
        tracer.render(region, rendering.film);
        if (is_abandoned()) { // perhaps within the tile
            complete = false;
            return;
        }
        if (scene != nullptr) passes.local().run(region, crop, rendering);
        if (options.aovs) note_samples(tracer, region, crop, rendering.aovs);
        of_tile += tracer.counters();
        of_tile -= before;
        if (options.progress != nullptr) {
            options.progress->rays += of_tile.rays();
            options.progress->pixels += region.pixels();
        }
        // While after_tile waits, this thread must not begin another tile.
        if (options.after_tile)
            isolate([&] { options.after_tile({region, rendering.film, rendering.aovs, of_tile}); });
    };
    if (complete_ones == nullptr) take_samples(surveys, tracers, options);
    // Not counted: each process that renders a part of an image repeats the survey.
    EngineCounters surveyed;
    tracers.for_each([&](const Tracer& tracer) { surveyed += tracer.counters(); });
    if (options.progress != nullptr)
        options.progress->first_tile = std::chrono::steady_clock::now();
    for_each_tile(grid, options.threads, draw, options.tiles);
    rendering.complete = complete;
    tracers.for_each([&](const Tracer& tracer) { rendering.counters += tracer.counters(); });
    rendering.counters -= surveyed;
    recalled.for_each([&](const EngineCounters& counters) { rendering.counters += counters; });
    if (options.crop) rendering.film = rendering.film.cropped(crop);
    return rendering;
}

/// Renders an image for each wavelength and adds up their shares. Alpha is the mean.
template <class Tracer>
class SpectralTracer {
  public:
    SpectralTracer(std::vector<Tracer> tracers, const std::vector<core::Color>& shares,
                   const core::Settings& settings)
        : tracers_(std::move(tracers)), shares_(shares),
          film_(settings.width, settings.height, settings.alpha) {}

    void survey(core::Survey::Pass pass, std::size_t batch) {
        for (Tracer& tracer : tracers_)
            tracer.survey(pass, batch);
    }

    void render(const core::Region& region, core::Film& film) {
        for (std::size_t i = 0; i < tracers_.size(); ++i) {
            tracers_[i].render(region, film_);
            for (int y = region.y0; y < region.y1; ++y)
                for (int x = region.x0; x < region.x1; ++x) {
                    const core::Color share = shares_[i] * film_.at(x, y);
                    film.at(x, y) = i == 0 ? share : film.at(x, y) + share;
                    if (!film.has_alpha()) continue;
                    float& alpha = film.alpha_at(x, y);
                    alpha = i == 0 ? film_.alpha_at(x, y) : alpha + film_.alpha_at(x, y);
                    if (i + 1 == tracers_.size()) alpha /= static_cast<float>(tracers_.size());
                }
        }
    }

    auto counters() const {
        auto totals = tracers_.front().counters();
        for (std::size_t i = 1; i < tracers_.size(); ++i)
            totals += tracers_[i].counters();
        return totals;
    }

    int samples_of(std::size_t pixel) const {
        int total = 0;
        for (const Tracer& tracer : tracers_)
            total += tracer.samples_of(pixel);
        return total;
    }

  private:
    std::vector<Tracer> tracers_;
    const std::vector<core::Color>& shares_;
    core::Film film_;
};

/// A scene in the light of each wavelength, and the colour shares of these.
struct Spectrum {
    std::vector<core::Scene> scenes;
    std::vector<core::Color> shares;

    explicit Spectrum(const core::Scene& scene) : shares(core::shares_of(scene.wavelengths())) {
        for (const double wavelength : scene.wavelengths())
            scenes.push_back(scene.in_light_of(wavelength));
    }
};

const std::atomic<bool>* abandon_of(const RenderOptions& options) {
    return options.progress != nullptr ? &options.progress->abandon : nullptr;
}

/// Returns the survey of an image by the vector engine.
Surveys surveys_by_vector(const core::Scene& scene, const core::Settings& settings,
                          const RenderOptions& options) {
    Surveys surveys = surveys_of({&scene, 1}, settings);
    if (surveys.empty()) return surveys;
    const SceneData data(scene);
    const Tracing tracing{&kernels_of(options.isa), options.precision};
    PerThread<Wavefront> tracers([&] {
        return Wavefront(data, settings, tracing, survey_of(surveys, 0), abandon_of(options));
    });
    take_samples(surveys, tracers, options);
    return surveys;
}

template <class Real>
Rendering render_reference(const core::Scene& scene, const core::Settings& settings,
                           const RenderOptions& options) {
    using Tracer = core::ReferenceTracer<Real>;
    std::optional<SceneData> data;
    if (FirstHitPasses::are_wanted(settings, options)) data.emplace(scene);
    const SceneData* const seen = data ? &*data : nullptr;
    if (!scene.wavelengths().empty()) {
        const Spectrum spectrum(scene);
        return render_by<SpectralTracer<Tracer>>(
            [&](Surveys& surveys) {
                std::vector<Tracer> tracers;
                for (const core::Scene& of_one : spectrum.scenes)
                    tracers.emplace_back(of_one, settings, core::Search::hierarchy,
                                         options.precision, survey_of(surveys, tracers.size()),
                                         abandon_of(options));
                return SpectralTracer<Tracer>(std::move(tracers), spectrum.shares, settings);
            },
            spectrum.scenes, settings, options, seen);
    }
    std::optional<Surveys> surveyed;
    if (options.surveys_by_vector) surveyed = surveys_by_vector(scene, settings, options);
    return render_by<Tracer>(
        [&](Surveys& surveys) {
            return Tracer(scene, settings, core::Search::hierarchy, options.precision,
                          survey_of(surveys, 0), abandon_of(options));
        },
        {&scene, 1}, settings, options, seen, surveyed ? &*surveyed : nullptr);
}

/// Wavefronts cannot be moved; this holder can.
struct MovableWavefront {
    std::unique_ptr<Wavefront> wavefront;

    void survey(core::Survey::Pass pass, std::size_t batch) { wavefront->survey(pass, batch); }
    void render(const core::Region& region, core::Film& film) { wavefront->render(region, film); }
    EngineCounters counters() const { return wavefront->counters(); }
    int samples_of(std::size_t pixel) const { return wavefront->samples_of(pixel); }
};

Transmissive transmissive_in(const core::Settings& settings) {
    return settings.transparent_shadows ? Transmissive::lets_through : Transmissive::is_skipped;
}

Rendering render_spectrum(const core::Scene& scene, const core::Settings& settings,
                          const RenderOptions& options, const Tracing& tracing) {
    const Spectrum spectrum(scene);
    std::vector<SceneData> data;
    data.reserve(spectrum.scenes.size());
    for (const core::Scene& of_one : spectrum.scenes)
        data.emplace_back(of_one, transmissive_in(settings));
    using Tracer = SpectralTracer<MovableWavefront>;
    return render_by<Tracer>(
        [&](Surveys& surveys) {
            std::vector<MovableWavefront> tracers;
            tracers.reserve(data.size());
            for (const SceneData& of_one : data)
                tracers.push_back({std::make_unique<Wavefront>(of_one, settings, tracing,
                                                               survey_of(surveys, tracers.size()),
                                                               abandon_of(options))});
            return Tracer(std::move(tracers), spectrum.shares, settings);
        },
        spectrum.scenes, settings, options,
        FirstHitPasses::are_wanted(settings, options) ? &data.front() : nullptr);
}

void require_part(const core::Settings& settings, const std::optional<core::Region>& crop) {
    const bool is_part = !crop || (crop->x0 < crop->x1 && crop->y0 < crop->y1 &&
                                   crop->within(whole_of(settings)) == *crop);
    if (!is_part) throw core::InvalidValue("crop", "must lie within the image");
}

} // namespace

core::Region drawn_part(const core::Settings& settings, const std::optional<core::Region>& crop) {
    const core::Region image = whole_of(settings);
    if (!crop || settings.quality == 0.0F) return crop.value_or(image);
    constexpr int square = core::RegionSamples::square_size;
    const auto up = [](int edge) { return (edge + square - 1) / square * square; };
    return core::Region{crop->x0 / square * square, crop->y0 / square * square, up(crop->x1),
                        up(crop->y1)}
        .within(image);
}

int tile_of(const core::Settings& settings, const RenderOptions& options) {
    const int tile = options.engine == Engine::reference ? (options.tile != 0 ? options.tile : 16)
                     : options.tile != 0 ? std::clamp(options.tile, 1, Wavefront::max_region)
                                         : 32;
    // With a quality, tiles consist of whole squares.
    constexpr int square = core::RegionSamples::square_size;
    return settings.quality != 0.0F ? (tile + square - 1) / square * square : tile;
}

TileGrid grid_of(const core::Settings& settings, const RenderOptions& options) {
    return {drawn_part(settings, options.crop), tile_of(settings, options)};
}

Rendering render_vector(const SceneData& scene, const core::Settings& settings,
                        const RenderOptions& options, const Tracing& tracing) {
    return render_by<Wavefront>(
        [&](Surveys& surveys) {
            return Wavefront(scene, settings, tracing, survey_of(surveys, 0), abandon_of(options));
        },
        {&scene.scene(), 1}, settings, options,
        FirstHitPasses::are_wanted(settings, options) ? &scene : nullptr);
}

Rendering render(const core::Scene& scene, const core::Settings& settings,
                 const RenderOptions& asked) {
    const DefaultRounding rounding;
    core::validate(settings);
    require_part(settings, asked.crop);
    RenderOptions options = asked;
    // Only exact decisions tell where a solid has its surface.
    if (scene.solids().any() || scene.copies() != nullptr)
        options.precision = core::Precision::exact;
    if (options.engine == Engine::vector) {
        const Tracing tracing{&kernels_of(options.isa), options.precision};
        return scene.wavelengths().empty()
                   ? render_vector(SceneData(scene, transmissive_in(settings)), settings, options,
                                   tracing)
                   : render_spectrum(scene, settings, options, tracing);
    }
    return core::is_single(options.precision) ? render_reference<float>(scene, settings, options)
                                              : render_reference<double>(scene, settings, options);
}

} // namespace raylane::simd
