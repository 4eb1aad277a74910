#pragma once

#include "simd/kernel/traverse/list/lists.hpp"
#include "simd/kernel/traverse/obstacles.hpp"

namespace raylane::simd {

/// Occlusion of rays in lists. A ray that is blocked enters no further node.
template <class Arch, class Method>
class ListOccluded : RayLists<Arch, Method, ListOccluded<Arch, Method>> {
    using Base = RayLists<Arch, Method, ListOccluded<Arch, Method>>;
    friend Base;
    using Base::Base, Base::records_, Base::scene_, Base::rays_;

  public:
    static void occluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Workspace& workspace,
                         TraceCounters& counters) {
        ListOccluded lists(scene, rays, workspace, counters);
        lists.occlusions_ = occlusions;
        for (std::size_t i = 0; i < count; ++i)
            lists.records_[i].best.first =
                occlusions.state[i] == blocked ? none : occlusions.t_limit[i];
        lists.descend(count);
    }

  private:
    static constexpr float none = -1.0F;

    Occlusions occlusions_{};

    void take(std::size_t i, std::uint8_t state) {
        std::uint8_t& so_far = occlusions_.state[i];
        so_far = state > so_far ? state : so_far;
        if (state == blocked) records_[i].best.first = none;
    }
    template <class Filter>
    [[gnu::always_inline]] void take(const TableView& table, std::uint32_t number,
                                     const float* block, std::size_t i) {
        if (occlusions_.state[i] == blocked) return;
        take(i, Leaf<Arch, Method>::template occluded<Filter>(scene_, table, number,
                                                              PlainLanes<Arch>(table, block), rays_,
                                                              i, occlusions_.t_limit[i]));
    }
    template <class Filter>
    [[gnu::always_inline]] void take(const Pairs<Arch, Method>& pairs) {
        for_each_obstacle<Filter>(
            scene_, pairs,
            [&](int ray) { return occlusions_.t_limit[static_cast<std::size_t>(ray)]; },
            [&](int ray, std::uint8_t state) { take(static_cast<std::size_t>(ray), state); });
    }
};

} // namespace raylane::simd
