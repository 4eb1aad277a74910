#pragma once

#include "core/counters.hpp"
#include "core/film.hpp"
#include "core/scene.hpp"
#include "simd/isa.hpp"

#include <atomic>
#include <cstdint>
#include <optional>

namespace raylane::simd {

enum class Engine : std::uint8_t {
    vector,    ///< Wavefront; where a processor has none of its instruction sets, the reference
    reference, ///< core::ReferenceTracer
};

enum class Precision : std::uint8_t { single_precision, double_precision };

/// How far a rendering has come. May be read while it runs.
struct Progress {
    std::atomic<std::int64_t> pixels = 0;
    std::atomic<std::uint64_t> rays = 0;
};

struct RenderOptions {
    Engine engine = Engine::vector;
    std::optional<Isa> isa; ///< of the vector engine, an available one; default: the best
    int tile = 0;           ///< pixels on a tile's side, in [8, 64]; 0: as suits the engine
    Precision precision = Precision::double_precision; ///< of the reference
    int threads = 0;                                   ///< 0: all that the machine has
    Progress* progress = nullptr;
};

struct Rendering {
    core::Film film;
    core::Counters counters;
};

/// Renders a picture of settings.width * settings.height pixels. It depends on scene, settings,
/// engine and precision alone. Throws std::bad_alloc, and InvalidValue for settings that are none.
Rendering render(const core::Scene& scene, const core::Settings& settings,
                 const RenderOptions& options);

} // namespace raylane::simd
