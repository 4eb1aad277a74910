#pragma once

#include "core/scene/film.hpp"
#include "core/scene/layers.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/precision.hpp"
#include "simd/engine_counters.hpp"
#include "simd/isa.hpp"
#include "simd/tiles.hpp"

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

/// Progress of a rendering, for any thread to read while it runs; and to end it.
struct Progress {
    std::atomic<std::int64_t> pixels = 0;
    std::atomic<std::int64_t> recalled = 0; ///< of these, not drawn but there before
    /// Time at which the first tile was begun, behind the survey.
    std::atomic<std::chrono::steady_clock::time_point> first_tile =
        std::chrono::steady_clock::now();
    std::atomic<std::uint64_t> rays = 0;
    std::atomic<bool> stop = false;    ///< once true, no more tiles are begun
    std::atomic<bool> abandon = false; ///< once true, those under way are left, too
};

/// A part of a picture that has been drawn, or is to be. `film` and `layers` are the picture's, of
/// which nothing but that part is to be touched; layers are empty if they were not asked for, and
/// cover the crop.
struct FinishedTile {
    const core::Region& region;
    const core::Film& film;
    const core::Layers& layers;
    const EngineCounters& counters; ///< of the tile
};
struct TileToFill {
    const core::Region& region;
    core::Film& film;
    core::Layers& layers;
    EngineCounters& counters; ///< of the tile; 0 to begin with
};

struct RenderOptions {
    Engine engine = Engine::vector;
    Isa isa = best_isa(); ///< of the vector engine, an available one
    /// Pixels on a tile's side, in [8, 64]; 0: as suits the engine. With a quality, rounded up to a
    /// multiple of 16.
    int tile = 0;
    core::Precision precision = core::Precision::exact;
    int threads = 0; ///< 0: all that the machine has
    /// The part of the picture to be drawn, not empty; it has the bits that it has in the whole.
    std::optional<core::Region> crop;
    bool layers = false; ///< wanted, too
    Progress* progress = nullptr;
    /// Called before each tile by the thread that is to draw it, so by several at a time: if true,
    /// it has filled the tile with what this shows, and nothing is drawn.
    std::function<bool(const TileToFill&)> recall;
    /// Called behind each tile that has been drawn, likewise. The film has pixels around a crop
    /// that is not made of whole squares, if there is a quality.
    std::function<void(const FinishedTile&)> after_tile;
    /// Of grid_of this rendering: those of which the picture consists here. Null: all.
    TileSource* tiles = nullptr;
};

struct Rendering {
    core::Film film;         ///< of the crop, from (0, 0)
    EngineCounters counters; ///< of its tiles, without the survey that a quality needs
    core::Layers layers;     ///< of the crop; empty if they were not asked for
    bool complete = true;    ///< false if it was stopped: tiles may be black
};

/// The part of a picture that is drawn: the crop, or with a quality the whole squares that have it.
core::Region drawn_part(const core::Settings& settings, const std::optional<core::Region>& crop);

/// Pixels on the side of the tiles that a picture is drawn in.
int tile_of(const core::Settings& settings, const RenderOptions& options);
/// These tiles.
TileGrid grid_of(const core::Settings& settings, const RenderOptions& options);

/// Renders a picture of settings.width * settings.height pixels, or a part of it, with its outline;
/// layers and outline have what the camera sees first, exactly, whatever the precision and engine,
/// and are no part of the counters. With
/// core::Precision::exact it depends on scene, settings and engine alone. So it does with the
/// others, as long as rounding moves no hit out of its shape's bounds, nor by more than 2^-10 of t
/// before them: whether bounds keep a ray from such a hit depends on the instruction set and on the
/// rays that are traced together. Scenes with solids that are made of others are always drawn
/// exactly. Throws std::bad_alloc, InvalidValue for settings that are none,
/// and what `after_tile` throws.
Rendering render(const core::Scene& scene, const core::Settings& settings,
                 const RenderOptions& options);

/// The vector engine alone, by kernels of the caller's choice.
Rendering render_vector(const SceneData& scene, const core::Settings& settings,
                        const RenderOptions& options, const Tracing& tracing);

} // namespace raylane::simd
