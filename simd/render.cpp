#include "simd/render.hpp"

#include "core/reference/tracer.hpp"
#include "core/validate.hpp"
#include "simd/tiles.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

namespace raylane::simd {

namespace {

template <class Real>
Rendering render_reference(const core::Scene& scene, const core::Settings& settings,
                           const RenderOptions& options) {
    using Tracer = core::ReferenceTracer<Real>;
    Rendering rendering{core::Film(settings.width, settings.height), {}};
    tbb::enumerable_thread_specific<Tracer> tracers([&] { return Tracer(scene, settings); });
    const auto is_stopped = [&] { return options.progress != nullptr && options.progress->stop; };
    for_each_tile(settings.width, settings.height, options.threads,
                  [&](const core::Region& region) {
                      if (is_stopped()) return;
                      Tracer& tracer = tracers.local();
                      const std::uint64_t rays_before = tracer.counters().rays();
                      tracer.render(region, rendering.film);
                      if (options.progress != nullptr) {
                          options.progress->rays += tracer.counters().rays() - rays_before;
                          options.progress->pixels += region.pixels();
                      }
                      // Isolated: what it waits for shall not make it draw another tile.
                      if (options.after_tile) tbb::this_task_arena::isolate(options.after_tile);
                  });
    rendering.complete = !is_stopped();
    for (const Tracer& tracer : tracers)
        rendering.counters += tracer.counters();
    return rendering;
}

} // namespace

Rendering render(const core::Scene& scene, const core::Settings& settings,
                 const RenderOptions& options) {
    core::validate(settings);
    switch (options.precision) {
    case Precision::single_precision:
        return render_reference<float>(scene, settings, options);
    case Precision::double_precision:
        break;
    }
    return render_reference<double>(scene, settings, options);
}

} // namespace raylane::simd
