#include "simd/render.hpp"

#include "core/reference/tracer.hpp"
#include "core/scene/validate.hpp"
#include "simd/tiles.hpp"
#include "simd/wavefront/wavefront.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>

namespace raylane::simd {

namespace {

template <class Tracer>
Rendering render_by(const std::function<Tracer()>& make_tracer, int tile,
                    const core::Settings& settings, const RenderOptions& options) {
    Rendering rendering{core::Film(settings.width, settings.height), {}};
    tbb::enumerable_thread_specific<Tracer> tracers(make_tracer);
    const auto is_stopped = [&] { return options.progress != nullptr && options.progress->stop; };
    for_each_tile(
        settings.width, settings.height, tile, options.threads, [&](const core::Region& region) {
            if (is_stopped()) return;
            Tracer& tracer = tracers.local();
            const std::uint64_t rays_before = tracer.counters().rays();
            tracer.render(region, rendering.film);
            if (options.progress != nullptr) {
                options.progress->rays += tracer.counters().rays() - rays_before;
                options.progress->pixels += region.pixels();
            }
            // Isolated: what it waits for shall not make it draw another tile.
            if (options.after_tile)
                tbb::this_task_arena::isolate([&] { options.after_tile(region, rendering.film); });
        });
    rendering.complete = !is_stopped();
    for (const Tracer& tracer : tracers)
        rendering.counters += tracer.counters();
    return rendering;
}

/// With a quality, tiles consist of whole squares.
int fitting(int tile, const core::Settings& settings) {
    if (settings.quality == 0.0F) return tile;
    constexpr int square = core::RegionSamples::square_size;
    return (tile + square - 1) / square * square;
}

template <class Real>
Rendering render_reference(const core::Scene& scene, const core::Settings& settings,
                           const RenderOptions& options) {
    using Tracer = core::ReferenceTracer<Real>;
    const int tile = options.tile != 0 ? options.tile : 16;
    return render_by<Tracer>(
        [&] { return Tracer(scene, settings, core::Search::hierarchy, options.precision); },
        fitting(tile, settings), settings, options);
}

} // namespace

Rendering render_vector(const SceneData& scene, const core::Settings& settings,
                        const RenderOptions& options, const Tracing& tracing) {
    const int tile = options.tile != 0          ? std::clamp(options.tile, 1, Wavefront::max_region)
                     : settings.quality != 0.0F ? Wavefront::max_region
                                                : 32;
    return render_by<Wavefront>([&] { return Wavefront(scene, settings, tracing); },
                                fitting(tile, settings), settings, options);
}

Rendering render(const core::Scene& scene, const core::Settings& settings,
                 const RenderOptions& options) {
    core::validate(settings);
    if (options.engine == Engine::vector)
        return render_vector(SceneData(scene), settings, options,
                             {&kernels_of(options.isa), options.precision});
    return core::is_single(options.precision) ? render_reference<float>(scene, settings, options)
                                              : render_reference<double>(scene, settings, options);
}

} // namespace raylane::simd
