#pragma once

#include "simd/query/paths.hpp"
#include "simd/stream/lone_ray.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/streams.hpp"
#include "simd/tracing.hpp"

#include <cstddef>

namespace raylane::simd {

/// Takes a caller's rays into lanes, with the shapes that they leave and their limits: as many as
/// are best answered together.
class StreamIntake {
  public:
    StreamIntake(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes,
                 std::size_t capacity)
        : scene_(scene), tracing_(tracing), shapes_(shapes), capacity_(capacity) {}

    void take_from(Arena& arena);

    /// Takes rays in from `first` on. Returns those that were taken.
    template <class Real>
    RayStream<Real> take(const RayStream<Real>& rays, std::size_t first);
    /// Keeps only these lanes, in ascending order.
    void keep(const std::uint32_t* lanes, std::size_t count);

    const Paths& paths() const { return paths_; }
    const StreamRays& taken() const { return taken_; }
    /// Returns the property that all taken rays share; null if they share none.
    const Coherence* coherence() const { return coherence_; }
    bool is_ray(std::size_t lane) const { return taken_.t_most[lane] >= 0.0; }

    /// Returns ray i of those that were taken, which is in this lane.
    template <class Real>
    LoneRay lone(const RayStream<Real>& rays, std::size_t i, std::size_t lane) const;

  private:
    const StreamKernels& kernels() const { return tracing_.kernels->stream; }
    template <class Real>
    void take(const RayStream<Real>& rays, std::size_t count, std::size_t to);
    template <class Real>
    void start_on(const RayStream<Real>& rays, std::size_t count, std::size_t to);
    void stand_in(std::size_t begin, std::size_t end);

    /// Number of rays that are checked for a shared property.
    static constexpr std::size_t together = 1024;

    const SceneData& scene_;
    Tracing tracing_;
    const ShapesByName& shapes_;
    std::size_t capacity_;
    Paths paths_{};
    StreamRays taken_{}; // the columns of paths_, and those of limits
    Coherence in_common_{};
    const Coherence* coherence_ = nullptr;
};

} // namespace raylane::simd
