#pragma once

#include "core/scene/copy_walk.hpp"
#include "simd/query/approach.hpp"
#include "simd/query/engine_counters.hpp"
#include "simd/query/tracing.hpp"

#include <memory>
#include <vector>

namespace raylane::simd {

/// Finds shapes of copies that rays may meet, by bounds in float. Each ray that enters a copy
/// searches the copy's prototype, in whose space the ray is placed. The error of that place is a
/// part of the ray's slack, like the distance between a copy's shapes and exact images of the
/// prototype's, as the numbers of a copy are rounded. For use by one thread.
class CopySearch {
  public:
    CopySearch(const SceneData& scene, const Tracing& tracing);

    void take_from(Arena& arena);

    /// Searches copies after all other shapes. `rays`: rounded, of which only the exact ones are
    /// used. The t of candidates counts from `before`.
    void nearest(std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                 EngineCounters& counters);
    /// `distance`: limits of the exact rays.
    void occluded(std::size_t count, const RoundedRays& rays, const double* distance,
                  std::uint8_t* state, EngineCounters& counters);
    /// Lists the shapes that ray i may cross, as RefineKernels::list_candidates does.
    bool list(const RoundedRays& rays, std::size_t i, CandidateList& list, TraceCounters& counters);
    /// Adds the pairs of rays and shapes, as RefineKernels::list_all does.
    void list_all(std::size_t count, const RoundedRays& rays, const float* t_limit, PairList& list);

  private:
    /// A copy that rays enter.
    struct Placed {
        std::uint32_t copy = no_slot;
        std::uint32_t set = 0;
        core::ShapeId first_id = 0;
        core::Vec3d rows[3]; ///< of the map from the prototype
        core::Vec3d translate;
        double scale = 1.0;
    };
    /// The ray in the space of a copy's prototype: t of the ray is start + scale * t there.
    struct Local {
        const Placed* placed;
        double start, scale, error; ///< error: of t
        bool is_beside;             ///< the ray misses the box around the prototype
        double from_local(double t) const { return start + scale * t; }
        double to_local(double t) const { return (t - start) / scale; }
    };

    const Placed& placed_at(std::uint32_t copy);
    /// Calls visit(local) for the copies that ray i may meet before t_limit(), which counts from
    /// where the search begins, until visit returns false.
    template <class Limit, class Visit>
    void for_each_copy(const RoundedRays& rays, std::size_t i, const Limit& t_limit,
                       const Visit& visit);
    Local place(const RoundedRays& rays, std::size_t i, std::uint32_t copy);
    const SceneData& prototype_of(const Local& local) const {
        return *scene_.prototypes()[local.placed->set];
    }
    Workspace workspace_of(const SceneData& prototype) const {
        return prototype.has_tree() ? workspace_ : Workspace{};
    }
    std::uint32_t slot_of(std::uint32_t copy, std::uint32_t slot) const;
    void nearest_of(const RoundedRays& rays, std::size_t i, const Candidates& candidates,
                    TraceCounters& counters);
    std::uint8_t occluded_of(const RoundedRays& rays, std::size_t i, double distance,
                             std::uint8_t state, TraceCounters& counters);

    static constexpr std::size_t packet = 16; // kernels read and write whole packets
    struct alignas(64) Columns {
        double exact_origin[3][packet], exact_direction[3][packet];
        float origin[3][packet], direction[3][packet], slack[packet];
        float first[packet], second[packet], t_limit[packet];
        std::uint32_t slot[packet], origin_first[packet], origin_last[packet];
        std::uint8_t state[packet];
    };

    const SceneData& scene_;
    Tracing tracing_;
    core::CopyWalk walk_;
    std::vector<Placed> placed_;   // by a part of the copy's number
    std::unique_ptr<Columns> ray_; // in lane 0
    RoundedRays rounded_{};
    Workspace workspace_{};
};

} // namespace raylane::simd
