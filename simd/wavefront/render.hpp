#pragma once

#include "core/scene/aovs.hpp"
#include "core/scene/film.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/precision.hpp"
#include "simd/isa/isa.hpp"
#include "simd/query/engine_counters.hpp"
#include "simd/wavefront/tiles.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

namespace raylane::simd {

class SceneData;
struct Tracing;

enum class Engine : std::uint8_t {
    vector,    ///< Wavefront
    reference, ///< core::ReferenceTracer
};

/// Progress of a rendering. Any thread may read it while the rendering runs, and may end the
/// rendering.
struct Progress {
    std::atomic<std::int64_t> pixels = 0;
    std::atomic<std::int64_t> recalled = 0; ///< of these, filled by RenderOptions::recall
    /// Time at which the first tile began, after the survey.
    std::atomic<std::chrono::steady_clock::time_point> first_tile =
        std::chrono::steady_clock::now();
    std::atomic<std::uint64_t> rays = 0;
    std::atomic<bool> stop = false;    ///< once true, no more tiles are begun
    std::atomic<bool> abandon = false; ///< once true, tiles in progress are left unfinished, too
};

/// A part of an image that has been rendered, or is to be filled. `film` and `aovs` belong to the
/// image; nothing outside of the part may be touched. AOVs cover the crop, and are empty if they
/// were not requested.
struct FinishedTile {
    const core::Region& region;
    const core::Film& film;
    const core::Aovs& aovs;
    const EngineCounters& counters; ///< of the tile
};
struct TileToFill {
    const core::Region& region;
    core::Film& film;
    core::Aovs& aovs;
    EngineCounters& counters; ///< of the tile; initially 0
};

struct RenderOptions {
    Engine engine = Engine::vector;
    Isa isa = best_isa(); ///< of the vector engine; must be available
    /// Side of a tile in pixels, in [8, 64]. 0: the engine's default. With a quality, rounded up to
    /// a multiple of 16.
    int tile = 0;
    core::Precision precision = core::Precision::exact;
    int threads = 0; ///< 0: default_threads()
    /// The part of the image to render, not empty. Its pixels have the same bits as in the whole
    /// image.
    std::optional<core::Region> crop{};
    bool aovs = false; ///< true: render AOVs, too
    /// True: the vector engine makes the survey also for the reference engine, for which it takes
    /// longer than a few tiles. Scenes with wavelengths ignore it.
    bool surveys_by_vector = false;
    Progress* progress = nullptr;
    /// Called before each tile by the thread that is to render it, so by several threads at a time.
    /// If it returns true, it has filled the tile, and nothing is rendered.
    std::function<bool(const TileToFill&)> recall{};
    /// Called after each tile that has been rendered, likewise. With a quality, the film has pixels
    /// around a crop that does not consist of whole squares.
    std::function<void(const FinishedTile&)> after_tile{};
    /// The tiles of grid_of(settings, options) that are rendered here. Null: all.
    TileSource* tiles = nullptr;
};

struct Rendering {
    core::Film film;         ///< of the crop, which begins at (0, 0)
    EngineCounters counters; ///< of its tiles, without the survey that a quality needs
    core::Aovs aovs;         ///< of the crop; empty if they were not asked for
    bool complete = true;    ///< false if it was stopped: tiles may be black
};

/// Returns the part of an image that is rendered: the crop or, with a quality, the whole squares
/// that contain it.
core::Region drawn_part(const core::Settings& settings, const std::optional<core::Region>& crop);

/// Returns the side of an image's tiles in pixels.
int tile_of(const core::Settings& settings, const RenderOptions& options);
/// Returns the grid of these tiles.
TileGrid grid_of(const core::Settings& settings, const RenderOptions& options);

/// Renders an image of settings.width * settings.height pixels, or a part of it, with its outlines.
/// AOVs and outlines show the camera's first hits. They are exact with every precision and
/// engine, and do not count in the counters.
///
/// With core::Precision::exact, the image depends on scene, settings and engine alone. So it does
/// with the other precisions as long as rounding moves no hit out of its shape's bounds, or by more
/// than 2^-10 of t before them. Whether bounds keep a ray from such a hit depends on the
/// instruction set and on the rays that are traced together. Scenes with solids that are made of
/// others are always rendered exactly.
///
/// Throws std::bad_alloc, and InvalidValue if settings or crop are invalid. Exceptions of
/// `after_tile` propagate.
Rendering render(const core::Scene& scene, const core::Settings& settings,
                 const RenderOptions& options);

/// Runs the vector engine alone, with the caller's choice of kernels.
Rendering render_vector(const SceneData& scene, const core::Settings& settings,
                        const RenderOptions& options, const Tracing& tracing);

} // namespace raylane::simd
