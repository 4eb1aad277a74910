#pragma once

#include "core/reference/search.hpp"
#include "simd/query/query.hpp"
#include "simd/query/surface_expressions.hpp"
#include "simd/stream/few_rays.hpp"
#include "simd/stream/intake.hpp"
#include "simd/stream/rows.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/tile_order.hpp"

#include <span>
#include <vector>

namespace raylane::simd {

/// Answers streams of rays, for one thread.
class StreamWorker {
  public:
    StreamWorker(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes);

    /// Each of these returns the number of refused rays: see StreamIntake::refused.
    template <class Real>
    std::size_t nearest(const RayStream<Real>& rays, const HitStream& hits,
                        const NormalStream& normals = {});
    template <class Real>
    std::size_t occluded(const RayStream<Real>& rays, std::uint8_t* occluded);
    /// Appends the first crossing of each ray to the rows. Requires Precision::exact.
    template <class Real>
    std::size_t first_crossings(const RayStream<Real>& rays, const CrossingRequest& wanted,
                                CrossingRows& rows);

  private:
    bool is_exact() const { return tracing_.precision == core::Precision::exact; }
    const StreamKernels& kernels() const { return tracing_.kernels->stream; }
    std::size_t at_a_time() const;

    template <class Real, class AsTheyAre, class InTiles>
    void in_good_order(const RayStream<Real>& rays, const AsTheyAre& as_they_are,
                       const InTiles& in_tiles);
    template <class Real>
    bool are_better_in_tiles(const RayStream<Real>& rays, std::size_t first) const;
    template <class Real>
    std::size_t find_nearest(const RayStream<Real>& rays, const HitStream& hits);
    template <class Real>
    core::Vec3d double_normal_of(const RayStream<Real>& rays, const HitStream& hits, std::size_t i);
    template <class Real>
    void nearest_in_tiles(const RayStream<Real>& rays, const HitStream& hits);
    template <class Real>
    void nearest_of(const RayStream<Real>& rays, const HitStream& hits);
    template <class Real>
    void mark_unanswered(const RayStream<Real>& rays, bool with_normals);
    void find_surfaces(bool with_normals);
    template <class Real>
    void find_touching(const RayStream<Real>& rays, std::uint8_t* touching);
    bool touches(const LoneRay& ray, const core::Hit<double>& hit);
    void sharpen(std::span<const std::uint32_t> lanes, const HitStream& hits);
    template <class Real>
    void answer(const RayStream<Real>& rays, std::span<std::uint32_t> lanes, const HitStream& hits);
    struct Widened;
    void answer(const LoneRay& ray, const Widened& widened, std::size_t k, const HitStream& hits);
    void search(const LoneRay& ray, const HitStream& hits, std::size_t i);

    template <class Real>
    void occluded_in_tiles(const RayStream<Real>& rays, std::uint8_t* occluded);
    template <class Real>
    void occluded_of(const RayStream<Real>& rays, std::uint8_t* occluded);
    template <class Real>
    void settle(const RayStream<Real>& rays, std::size_t left, std::uint8_t* occluded);
    std::uint8_t is_occluded(const LoneRay& ray);

    core::Hit<double> hit_at(std::size_t lane) const;
    bool is_seen(std::size_t lane, bool on_solids);
    bool is_before_t_max(std::size_t lane, const LoneRay& ray) const;
    float t_at(std::size_t lane, const LoneRay& ray) const;
    Widened widen(std::span<const std::uint32_t> lanes, bool with_normals) const;
    double double_t_of(const Widened& widened, std::size_t k) const;
    core::Vec3f normal_of(const LoneRay& ray, const core::Hit<double>& hit, const Widened& widened,
                          std::size_t k) const;

    const SceneData& scene_;
    const ShapesByName& shapes_;
    Tracing tracing_;
    core::Searcher<double> searcher_;
    core::SolidSurfaces solid_surfaces_;
    Query query_;
    SurfaceExpressions expressions_;
    StreamIntake intake_;
    FewRays few_;
    TileOrder tiles_;
    TileColumns tile_columns_;
    std::uint32_t* doubtful_ = nullptr; // lanes
    std::uint32_t* unsharp_ = nullptr;
    std::uint8_t* state_ = nullptr;
    /// Columns of hits that the caller does not want.
    struct Columns {
        std::vector<double> t;
        std::vector<core::ShapeId> shape;
        std::vector<std::uint8_t> entering, face, touching;
        std::vector<float> normal[3];
        std::vector<double> normal_double[3];
        struct Taken {
            HitStream hits;
            NormalStream normals;
        };
        Taken take(std::size_t count, const CrossingRequest& wanted);
        void add_missing(HitStream& hits, std::size_t count);
    } columns_;
    std::size_t refused_ = 0;
    /// Skips frusta after some that gave up. Has no influence on answers.
    class FrustaToTry {
      public:
        /// Calls trace(coherence, counters) for some rays.
        template <class Trace>
        void trace(const Coherence* coherence, std::size_t count, const Trace& trace);

      private:
        static constexpr std::size_t max_without = 1024;
        std::size_t without_ = 0; ///< number of rays, also of other calls, that try no frusta
    };
    FrustaToTry to_hits_, to_occluders_;
    Arena arena_;
};

} // namespace raylane::simd
