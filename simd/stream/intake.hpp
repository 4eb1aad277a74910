#pragma once

#include "core/reference/rounding.hpp"
#include "simd/query/paths.hpp"
#include "simd/query/tracing.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/streams.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace raylane::simd {

/// A single ray of a stream: in double, with the shapes that it leaves, and its limits as given.
struct LoneRay {
    core::Ray<double> ray;
    core::OriginSurfaces<double> origins;
    int exponent; ///< the caller's t is this ray's t times 2^exponent
    double t_min, t_max;
    bool by_floats; ///< the limits are compared with the float nearest to t
    double t_limit; ///< no crossing counts from here on

    core::LeavingRay leaving() const { return {ray, origins}; }

    /// Return a crossing's t for the caller.
    float t_of(const core::Scene& scene, const core::Hit<double>& hit) const {
        return core::rounded_t(scene, leaving(), hit, exponent);
    }
    double double_t_of(const core::Scene& scene, const core::Hit<double>& hit) const {
        return as_answered(core::nearest_double_t(scene, leaving(), hit));
    }
    double as_answered(double t) const {
        return std::clamp(std::ldexp(t, exponent), std::numeric_limits<double>::denorm_min(),
                          std::numeric_limits<double>::max());
    }
    /// Returns true if a hit counts: it is visible and between the limits.
    bool finds(const core::Scene& scene, const core::Hit<double>& hit) const {
        return scene.material_of(hit.shape).is_seen(hit.enters()) && is_behind_t_min(scene, hit) &&
               is_before_t_max(scene, hit);
    }
    bool is_before_t_max(const core::Scene& scene, const core::Hit<double>& hit) const {
        if (t_limit == std::numeric_limits<double>::infinity()) return true;
        return by_floats ? static_cast<double>(t_of(scene, hit)) <= t_max
                         : compare_t(scene, hit, t_max) <= 0;
    }

  private:
    bool is_behind_t_min(const core::Scene& scene, const core::Hit<double>& hit) const {
        if (!(t_min > 0.0)) return true;
        return by_floats ? static_cast<double>(t_of(scene, hit)) > t_min
                         : compare_t(scene, hit, t_min) > 0;
    }
    int compare_t(const core::Scene& scene, const core::Hit<double>& hit, double limit) const {
        return core::compare_t(scene, leaving(), hit, std::ldexp(limit, -exponent));
    }
};

/// Starts a lane on the shape that ray i names, if it is a shape of the scene. `slots`: of the
/// shapes, by id.
template <class Real>
void start_on(const Paths& paths, std::size_t lane, const SceneData& scene,
              std::span<const std::uint32_t> slots, const RayStream<Real>& rays, std::size_t i);

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
    bool is_ray(std::size_t lane) const { return taken_.t_limit[lane] >= 0.0; }

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
