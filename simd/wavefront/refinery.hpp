#pragma once

#include "core/counters.hpp"
#include "simd/wavefront/hits.hpp"
#include "simd/wavefront/scene_data.hpp"
#include "simd/wavefront/tracing.hpp"

#include <span>

namespace raylane::simd {

/// Decides what rays hit that bounds in float, and the nearest of these in double, have left in
/// doubt: all that each may cross first is solved in double and, where that leaves a doubt, once
/// more with numbers that carry bounds, in double and wider. The numbers of a hit are those that
/// kernels have for that ray and that shape, whatever else was in doubt.
class Refinery {
  public:
    Refinery(const SceneData& scene, const Tracing& tracing) : scene_(scene), tracing_(tracing) {}

    void take_from(Arena& arena);

    /// Whether there is anything to be had of it.
    bool works() const { return tracing_.method().refine.finish_again != nullptr; }

    /// Removes from `lanes` those whose hits it could decide on, but does not ask for those that
    /// are `doubtful` anyway. Returns how many are left.
    std::size_t refine(const Paths& paths, const RoundedRays& rounded, const Pending& pending,
                       const std::uint8_t* doubtful, std::span<std::uint32_t> lanes,
                       const Hits& hits, core::Counters& counters);

    /// Where a ray crosses one shape, as refine() has it. Lane 0 of the result.
    const Hits& finish(const Paths& paths, std::size_t lane, std::uint32_t slot);

  private:
    /// A ray and its candidates: those from `begin` on, up to the next one's.
    struct Ray {
        std::uint32_t lane;
        std::uint32_t begin;
        float limit; ///< they are all that it may cross before
    };

    bool add(const Paths& paths, const RoundedRays& rounded, const Pending& pending,
             std::size_t lane, float limit, core::Counters& counters);
    void finish();
    bool decide(const Ray& ray, std::size_t end, const Hits& hits) const;

    static constexpr std::size_t most = 512; ///< candidates at a time

    const SceneData& scene_;
    Tracing tracing_;
    Paths paths_{}; ///< by candidate
    Hits hits_{};
    float* lower_ = nullptr;
    Ray* rays_ = nullptr;
    std::size_t count_ = 0, ray_count_ = 0;
};

} // namespace raylane::simd
