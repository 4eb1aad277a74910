#pragma once

#include "core/scene/copy_walk.hpp"
#include "simd/query/approach.hpp"
#include "simd/query/engine_counters.hpp"
#include "simd/query/tracing.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace raylane::simd {

/// Finds shapes of copies that rays may meet, by bounds in float. Each ray that enters a copy is
/// transformed to the space of the copy's prototype, which it then searches. The ray's slack covers
/// the error of that transformation. It also covers the rounding of a copy's numbers, by which the
/// copy differs from an exact image of the prototype. Rays go in waves: one call searches a
/// prototype for all rays of a wave that are in copies of it, each in its own. For use by one
/// thread.
class CopySearch {
  public:
    CopySearch(const SceneData& scene, const Tracing& tracing);

    void take_from(Arena& arena);

    /// Searches copies, after the search of all other shapes. Reads only the exact rays in `rays`.
    /// The t of candidates counts from `before`.
    void nearest(std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                 EngineCounters& counters);
    /// The same for occlusion. `distance`: limits of the exact rays.
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
        std::array<core::Vec3d, 3> rows; ///< of the map from the prototype
        core::Vec3d translate;
        double scale = 1.0;
    };
    /// A ray in the space of a copy's prototype: t of the ray is start + scale * t there.
    struct Local {
        std::uint32_t copy, set;
        double start, scale, error; ///< error: of t
        bool is_beside;             ///< the ray misses the box around the prototype
        double from_local(double t) const { return start + scale * t; }
        double to_local(double t) const { return (t - start) / scale; }
    };

    /// A ray on its way through copies.
    struct Traveller {
        core::CopyWalk walk;
        std::size_t ray = 0;                                      ///< its index
        Local local{};                                            ///< where it is
        std::uint32_t found_copy = no_slot, found_slot = no_slot; ///< of its candidate in copies
    };

    const Placed& placed_at(std::uint32_t copy);
    static void start(core::CopyWalk& walk, const RoundedRays& rays, std::size_t i);
    /// Calls visit(local) for the copies that ray i may meet before t_limit(), which counts from
    /// where the search begins, until visit returns false.
    template <class Limit, class Visit>
    void for_each_copy(const RoundedRays& rays, std::size_t i, const Limit& t_limit,
                       const Visit& visit);
    /// Sends the rays through the copies that they may meet before t_limit(i), which counts from
    /// where the search begins and may change meanwhile. Rays whose limit is negative stay. Calls
    /// search(prototype, travellers) for the rays that are in copies of a prototype, one in each of
    /// the first lanes, and done(traveller) when a ray has left the last one.
    template <class Limit, class Search, class Done>
    void in_waves(std::size_t count, const RoundedRays& rays, const Limit& t_limit,
                  const Search& search, const Done& done);
    /// Calls search() for travellers in the copies where they are.
    template <class Search>
    void search_prototypes(std::span<Traveller*> travellers, const RoundedRays& rays,
                           const Search& search);
    /// Takes the candidates that a search of the traveller's copy left in its lane, within the
    /// limits that it had there.
    void take_candidates(std::size_t lane, float first_limit, float second_limit,
                         const RoundedRays& rays, const Candidates& candidates,
                         Traveller& traveller);
    Local place(const RoundedRays& rays, std::size_t i, std::uint32_t copy, std::size_t lane);
    const SceneData& prototype_of(const Local& local) const {
        return *scene_.prototypes()[local.set];
    }
    Workspace workspace_of(const SceneData& prototype) const {
        return prototype.has_tree() ? workspace_ : Workspace{};
    }
    std::uint32_t slot_of(std::uint32_t copy, std::uint32_t slot) const;

    static constexpr std::size_t wave = 256; // whole packets, which kernels read and write
    struct alignas(64) Columns {
        double exact_origin[3][wave], exact_direction[3][wave];
        float origin[3][wave], direction[3][wave], slack[wave];
        float first[wave], second[wave], t_limit[wave];
        std::uint32_t slot[wave], origin_first[wave], origin_last[wave];
        std::uint8_t state[wave];
    };

    const SceneData& scene_;
    Tracing tracing_;
    std::vector<Placed> placed_; // a cache, by the low bits of the copy's number
    std::vector<Traveller> travellers_;
    std::unique_ptr<Columns> lanes_;
    RoundedRays rounded_{};
    Workspace workspace_{};
};

} // namespace raylane::simd
