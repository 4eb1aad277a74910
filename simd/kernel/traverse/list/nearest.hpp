#pragma once

#include "simd/kernel/traverse/list/lists.hpp"

namespace raylane::simd {

/// The nearest crossings of rays in lists.
template <class Arch, class Method>
class ListNearest : RayLists<Arch, Method, ListNearest<Arch, Method>> {
    using Base = RayLists<Arch, Method, ListNearest<Arch, Method>>;
    friend Base;
    using Base::Base, Base::records_, Base::scene_, Base::rays_;

  public:
    static void nearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                        const Candidates& candidates, const Workspace& workspace,
                        TraceCounters& counters) {
        ListNearest lists(scene, rays, workspace, counters);
        for (std::size_t i = 0; i < count; ++i)
            lists.records_[i].best = Leaf<Arch, Method>::best_of(candidates, i);
        lists.descend(count);
        for (std::size_t i = 0; i < count; ++i)
            Leaf<Arch, Method>::store(lists.records_[i].best, candidates, i);
    }

  private:
    template <class Filter>
    [[gnu::always_inline]] void take(const TableView& table, std::uint32_t number,
                                     const float* block, std::size_t i) const {
        Best& best = records_[i].best;
        LeafHits hits;
        const ClipPlanesView* cut = cut_of<Method>(scene_, table.first_slot + 16 * number);
        Leaf<Arch, Method>::template find<Filter>(PlainLanes<Arch>(table, block), cut, rays_, i,
                                                  best.second, hits);
        if (hits.lanes != 0) Leaf<Arch, Method>::take(hits, table.first_slot + 16 * number, best);
    }

    template <class Filter>
    [[gnu::always_inline]] void take(const Pairs<Arch, Method>& pairs) const {
        const PairBounds bounds = pairs.template bound<Filter>();
        for (std::uint32_t bits = bounds.possible; bits != 0; bits &= bits - 1) {
            const int k = __builtin_ctz(bits);
            Leaf<Arch, Method>::take(bounds.lower[k], pairs.slot[k], records_[pairs.whose[k]].best);
        }
    }
};

} // namespace raylane::simd
