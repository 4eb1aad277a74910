#pragma once

#include "core/scene/camera_rays.hpp"
#include "core/scene/region.hpp"
#include "simd/query/look_through.hpp"

#include <limits>
#include <vector>

namespace raylane::simd {

/// What a ray from the camera hits first of what can be seen from there.
struct FirstHit {
    core::Ray<double> ray; ///< unit
    double t = std::numeric_limits<double>::infinity();
    core::Vec3d flat_normal{0.0};    ///< unit, on the side that is seen
    core::Vec3d shading_normal{0.0}; ///< the same, but for smooth triangles
    core::ShapeId shape = core::no_shape;
    core::MaterialIndex material = core::no_material;
    core::Face face = core::body;

    bool any() const { return shape != core::no_shape; }
};

/// Traces rays from the camera, all of them through the middle of a lens, and always exactly: what
/// they hit depends on scene and settings alone. To be used by one thread.
class FirstHits {
  public:
    FirstHits(const SceneData& scene, const core::Settings& settings, const Kernels& kernels);
    FirstHits(const FirstHits&) = delete; // parts of it refer to others
    FirstHits& operator=(const FirstHits&) = delete;

    /// Each pixel has per_pixel x per_pixel points, spread evenly; they are numbered through the
    /// whole picture, from 0 at its left and upper edge, and there are such beyond its edges, too.
    /// `hits` becomes those of some, row by row.
    void trace(const core::Region& points, int per_pixel, std::vector<FirstHit>& hits);

  private:
    /// Rays at a time, and points on a side of the squares that they are taken from: as many as a
    /// frustum has.
    static constexpr std::size_t chunk = 1024;
    static constexpr int square = 16;

    void take_from(Arena& arena);
    void flush(std::vector<FirstHit>& hits);
    void settle(std::size_t lane, FirstHit& hit);
    FirstHit hit_at(std::size_t lane) const;

    const SceneData& scene_;
    Tracing tracing_;
    core::CameraRays<double> camera_rays_;
    CameraView camera_;
    Coherence coherence_;
    LookThrough finder_;
    core::Searcher<double> searcher_; // for where surfaces meet
    EngineCounters counters_;
    int width_, height_;

    Arena arena_;
    Paths paths_{};
    double* across_ = nullptr;
    double* upward_ = nullptr;
    std::vector<std::size_t> places_; // in `hits`, by lane
};

} // namespace raylane::simd
