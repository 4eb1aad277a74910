#pragma once

#include "simd/query/query.hpp"
#include "simd/stream/intake.hpp"

#include <optional>

namespace raylane::simd {

/// Answers rays one after the other. For calls of a few rays, in which the preparations of a stream
/// take longer than the rays. A ray stays undecided if its floats are in doubt after the
/// first steps, the search in float and the solver in double. So does an unusual ray: one that is
/// very far away, very short or long, or refused, or that may meet its origin surface again. Throws
/// InvalidStart as StreamTracer does.
class FewRays {
  public:
    static constexpr std::size_t most = 4;

    FewRays(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes);
    FewRays(const FewRays&) = delete; // parts refer to others
    FewRays& operator=(const FewRays&) = delete;

    /// Returns true if such rays can be answered here.
    template <class Real>
    bool can_answer(const RayStream<Real>& rays) const;

    /// Answers ray i. Returns false, and stores nothing, if it stays undecided. hits.t_double must
    /// be null.
    template <class Real>
    bool nearest(const RayStream<Real>& rays, std::size_t i, const HitStream& hits);
    /// Returns whether ray i is blocked, or nothing if that stays undecided.
    template <class Real>
    std::optional<bool> occluded(const RayStream<Real>& rays, std::size_t i);

  private:
    template <class Real>
    bool take(const RayStream<Real>& rays, std::size_t i);
    bool take_limits(float t_min, float t_max);
    void round();
    bool solve();

    static constexpr std::size_t packet = 16; // kernels read and write whole packets
    struct alignas(64) Columns {
        double origin[3][packet], direction[3][packet];
        double before[packet], t[packet], error[packet], normal[3][packet];
        float rounded_origin[3][packet], rounded_direction[3][packet], slack[packet];
        float first[packet], second[packet];
        std::uint32_t slot[packet], hit[packet];
        std::uint32_t origin_first[packet], origin_last[packet], origin_slot[packet],
            origin_bits[packet];
        std::uint8_t state[packet];
    };

    const SceneData& scene_;
    Tracing tracing_;
    const ShapesByName& shapes_;
    bool works_;
    float least_slack_;
    core::Vec3d center_{};
    double reach_;  ///< largest distance of origins from the center along each axis
    Columns ray_{}; ///< in lane 0
    Paths paths_{}; ///< the columns of the ray
    RoundedRays rounded_{};
    Found found_{};
    Workspace workspace_{};
    Arena arena_;
    double length_ = 0.0;   ///< of the direction
    double per_unit_ = 0.0; ///< the caller's t per t of the unit direction
    double t_limit_ = 0.0;  ///< of the unit direction; nothing behind it counts
};

} // namespace raylane::simd
