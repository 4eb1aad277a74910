#pragma once

#include "core/scene/aovs.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/region.hpp"
#include "simd/query/transparency_walk.hpp"

#include <limits>
#include <vector>

namespace raylane::simd {

/// First hit of a camera ray with a surface that is visible from there.
struct FirstHit {
    core::Ray<double> ray; ///< unit
    double t = std::numeric_limits<double>::infinity();
    core::Vec3d flat_normal{0.0};    ///< unit, on the visible side
    core::Vec3d shading_normal{0.0}; ///< the same, except on smooth triangles
    core::ShapeId shape = core::no_shape;
    core::MaterialIndex material = core::no_material;
    core::Face face = core::body;

    bool any() const { return shape != core::no_shape; }
};

/// Traces camera rays, all through the middle of a lens, and always exactly: hits depend on scene
/// and settings alone. To be used by one thread.
class FirstHits {
  public:
    FirstHits(const SceneData& scene, const core::Settings& settings, const Kernels& kernels);
    FirstHits(const FirstHits&) = delete; // parts refer to others
    FirstHits& operator=(const FirstHits&) = delete;

    /// Traces rays through points. Each pixel has per_pixel x per_pixel evenly spread points.
    /// Points are numbered through the whole image, from 0 at its left and upper edges, and
    /// continue beyond its edges. Replaces `hits` by those of the region `points`, row by row.
    void trace(const core::Region& points, int per_pixel, std::vector<FirstHit>& hits);

  private:
    /// Rays at a time, and points on a side of the squares from which they are taken: a frustum has
    /// as many.
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
    TransparencyWalk finder_;
    core::Searcher<double> searcher_; // where surfaces meet
    EngineCounters counters_;
    int width_, height_;

    Arena arena_;
    Paths paths_{};
    double* across_ = nullptr;
    double* upward_ = nullptr;
    std::vector<std::size_t> places_; // in `hits`, by lane
};

/// Fills in a region of an image's AOVs, except for the samples. The AOVs cover the part `of`
/// of the image.
void fill_aovs(FirstHits& tracer, const core::Region& region, const core::Region& frame,
               core::Aovs& aovs);

} // namespace raylane::simd
