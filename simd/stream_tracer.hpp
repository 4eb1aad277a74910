#pragma once

#include "core/scene/scene.hpp"
#include "simd/isa.hpp"
#include "simd/tracing.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace raylane::simd {

class SceneData;

/// `count` rays, structure of arrays: the points origin + t direction with t_min < t <= t_max.
/// Component a of ray i is origin[a][i]. Directions may have any length but zero. Doubles are 0 or
/// of magnitude 2^-149 to 2^128, as floats are, but for components of a direction, which may be as
/// small as 2^-276 of its largest.
template <class Real>
struct RayStream {
    std::size_t count = 0;
    const Real* origin[3] = {};
    const Real* direction[3] = {};
    const Real* t_min = nullptr; ///< null: 0; what is negative is 0
    const Real* t_max = nullptr; ///< null: infinity
    /// Shapes that rays leave, or no_shape. Such a ray starts exactly on that surface, on the face
    /// of it that HitStream::face said, and goes to its inside (the back) if origin_inward is 1, or
    /// else to its outside. Null: none leaves any; the face is the body; all go to the outside.
    const core::ShapeId* origin_shape = nullptr;
    const std::uint8_t* origin_face = nullptr;
    const std::uint8_t* origin_inward = nullptr;
};

/// Hits of rays, by ray, as far as they are wanted. Null: not wanted.
struct HitStream {
    float* t = nullptr;               ///< infinity: nothing
    float* normal[3] = {};            ///< unit, on the outside (the front); 0: nothing
    core::ShapeId* shape = nullptr;   ///< no_shape: nothing
    std::uint8_t* entering = nullptr; ///< 1: from outside (the front); 0: from inside, or nothing
    std::uint8_t* face = nullptr;     ///< for RayStream::origin_face
    double* t_double = nullptr;       ///< t, nearest to the true one; infinity: nothing
};

/// Answers streams of rays about one scene, which must outlive it. May be called by any number of
/// threads at a time. The answer to a ray depends on the scene and that ray alone.
///
/// Of rays in float a crossing counts by its t as it is answered: the nearest float, but never 0 or
/// infinity; of rays in double by its true t. What its material's `visible` says cannot be seen
/// from there does not count. A ray with a component that is not in the range of RayStream, a
/// direction of 0 or a limit that is NaN hits nothing.
class StreamTracer {
  public:
    /// `threads`: 0 is default_threads(). `isa`: an available one; default: the best.
    explicit StreamTracer(const core::Scene& scene, int threads = 0, Isa isa = best_isa(),
                          core::Precision precision = core::Precision::exact);
    ~StreamTracer();

    /// The nearest crossing. Of several at the same t, one that is entered comes before one that is
    /// left, then the lower id.
    template <class Real>
    void nearest(const RayStream<Real>& rays, const HitStream& hits) const;

    /// 1 where there is any crossing, 0 elsewhere.
    template <class Real>
    void occluded(const RayStream<Real>& rays, std::uint8_t* occluded) const;

  private:
    class Worker;
    class Lease;

    template <class Answer>
    void answer(std::size_t count, const Answer& answer) const;

    static constexpr std::size_t fewest = 1024; ///< rays that are worth a thread
    std::size_t at_a_time() const;              ///< rays that look for what is nearest
    std::span<const std::uint32_t> slots_by_id() const;

    const core::Scene& scene_;
    int threads_;
    std::unique_ptr<const SceneData> data_;
    Tracing tracing_;

    // By id, once a ray has named a shape.
    mutable std::once_flag has_slots_;
    mutable std::vector<std::uint32_t> slots_;

    // Workers that nobody uses now: their memory is made once.
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<Worker>> idle_;
};

} // namespace raylane::simd
