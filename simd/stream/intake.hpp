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
#include <vector>

namespace raylane::simd {

/// A single ray of a stream: in double, with the shapes that it leaves, and its limits as given.
struct LoneRay {
    core::Ray<double> ray;
    core::OriginSurfaces<double> origins;
    int exponent; ///< the caller's t is this ray's t times 2^exponent
    double t_min, t_max;
    bool by_floats; ///< the limits are compared with the float nearest to t, not with the double
    double t_limit; ///< no crossing counts from here on

    core::LeavingRay leaving() const { return {ray, origins}; }

    /// Return a crossing's t for the caller.
    float t_of(const core::Scene& scene, const core::Hit<double>& hit) const {
        return core::rounded_t(scene, leaving(), hit, exponent);
    }
    double double_t_of(const core::Scene& scene, const core::Hit<double>& hit) const {
        return core::nearest_double_t(scene, leaving(), hit, exponent);
    }
    /// The same, for a t that is known in 106 bits.
    double double_t_of(const core::Scene& scene, const core::Hit<double>& hit,
                       const core::DoubleDouble& t, double error) const {
        const double nearest = std::ldexp(t.high, exponent);
        return core::rounds_surely(t, error) && std::isnormal(nearest) ? nearest
                                                                       : double_t_of(scene, hit);
    }
    /// Returns a crossing's normal for the caller, on the outside of its solid: the nearest
    /// doubles.
    core::Vec3d double_normal_of(const core::Scene& scene, const core::SharpHit& hit) const {
        const core::Vec3d normal = core::nearest_double_normal(scene, leaving(), hit);
        return hit.hit().reversed ? core::Vec3d(0.0) - normal : normal; // no -0
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
        const double largest = by_floats ? static_cast<double>(std::numeric_limits<float>::max())
                                         : std::numeric_limits<double>::max();
        if (t_max >= largest) return true; // t is never infinite
        return compare_t(scene, hit, t_max) <= 0;
    }

  private:
    bool is_behind_t_min(const core::Scene& scene, const core::Hit<double>& hit) const {
        if (!(t_min > 0.0)) return true;
        return compare_t(scene, hit, t_min) > 0;
    }
    /// Compares t as it is answered with a limit: -1 if it is less, 0 if both are equal.
    int compare_t(const core::Scene& scene, const core::Hit<double>& hit, double limit) const {
        // More than half an ulp of t, and than the rounding of both limits.
        const double near = std::ldexp(hit.t, exponent);
        const double off = std::ldexp(hit.error, exponent) * 2.0 +
                           (by_floats ? 0x1p-22 : 0x1p-51) * near + 0x1p-140;
        if (near + off < limit) return -1;
        if (near - off > limit) return 1;
        const double t =
            by_floats ? static_cast<double>(t_of(scene, hit)) : double_t_of(scene, hit);
        return t < limit ? -1 : t > limit ? 1 : 0;
    }
};

/// Takes a caller's rays into lanes, with the shapes that they leave and their limits: as many as
/// are best answered together.
class StreamIntake {
  public:
    StreamIntake(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes,
                 std::size_t capacity)
        : scene_(scene), tracing_(tracing), shapes_(shapes), capacity_(capacity) {}

    void take_from(Arena& arena);

    /// Says whether rays in double are answered with t in float alone. Their limits then compare
    /// with that float.
    void answer_floats(bool floats) { floats_ = floats; }
    bool answers_floats() const { return floats_; }
    /// Says whether limits are ignored, so that crossings behind them are found, too. Rays with a
    /// limit that is NaN are refused in any case.
    void take_whole_lines(bool are_whole) { whole_lines_ = are_whole; }
    /// Returns upper limits in float, by lane, of rays in double that are answered so.
    const float* float_t_max() const { return float_t_max_.data(); }

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
    /// Returns true for a ray whose numbers are beyond the kernels' range. Scalar code must trace
    /// it.
    bool is_apart(std::size_t lane) const { return taken_.t_limit[lane] == apart; }
    /// Returns the lanes of the taken rays for which is_apart() is true, in ascending order.
    std::span<const std::uint32_t> lanes_apart() const { return apart_; }
    /// Returns the number of taken rays that are refused: those with an infinite or NaN component,
    /// a direction of 0, or a limit that is NaN.
    std::size_t refused() const { return refused_; }

    /// Returns ray i of those that were taken, which is in this lane. For a ray apart, replaces the
    /// shapes that the lane's ray leaves.
    template <class Real>
    LoneRay lone(const RayStream<Real>& rays, std::size_t i, std::size_t lane);
    /// Returns ray i of any, which must not be refused. Replaces the shapes that this lane's ray
    /// leaves.
    template <class Real>
    LoneRay alone(const RayStream<Real>& rays, std::size_t i, std::size_t lane = 0);

  private:
    const StreamKernels& kernels() const { return tracing_.kernels->stream; }
    template <class Real>
    void take(const RayStream<Real>& rays, std::size_t count, std::size_t to);
    bool finds_coherence(std::size_t count);
    template <class Real>
    void start_on(const RayStream<Real>& rays, std::size_t count, std::size_t to);
    template <class Real>
    std::size_t refuse_limits(const RayStream<Real>& rays, std::size_t count, std::size_t to);
    template <class Real>
    LoneRay limited(const RayStream<Real>& rays, std::size_t i, std::size_t lane,
                    const core::Ray<double>& ray, int exponent);
    template <class Real>
    void sort_out(const RayStream<Real>& rays, std::size_t count, std::size_t to);
    void limit_floats(const RayStream<double>& rays, std::size_t count, std::size_t to);
    void stand_in(std::size_t begin, std::size_t end);

    /// Number of rays that are checked for a shared property.
    static constexpr std::size_t together = 1024;
    static constexpr double apart = -2.0; ///< as t_limit; other rays without lanes have -1

    const SceneData& scene_;
    Tracing tracing_;
    const ShapesByName& shapes_;
    std::size_t capacity_;
    Paths paths_{};
    StreamRays taken_{}; // the columns of paths_, and those of limits
    Coherence in_common_{};
    const Coherence* coherence_ = nullptr;
    bool floats_ = false, whole_lines_ = false;
    std::vector<float> float_t_max_;
    std::vector<std::uint32_t> apart_;
    std::size_t refused_ = 0;
};

} // namespace raylane::simd
