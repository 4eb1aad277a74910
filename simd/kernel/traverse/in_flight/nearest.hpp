#pragma once

#include "simd/kernel/traverse/in_flight/in_flight.hpp"
#include "simd/kernel/traverse/traversal_queue.hpp"

namespace raylane::simd {

/// The nearest hits of many interleaved rays.
template <class Arch, class Method>
class InFlightNearest : InFlight<Arch, Method> {
    using S = Streams<Arch>;
    using Base = InFlight<Arch, Method>;

    struct Flight : Base::Traveller {
        TraversalQueue<Arch> queue;
        Best best;
        LeafHits hits;
    };

    const SceneView& scene_;
    const RoundedRays& rays_;
    const Candidates& candidates_;
    const std::size_t count_;
    Flight flights_[in_flight];
    std::size_t next_ = 0;
    BoxRays<Arch> box_rays_{};

    InFlightNearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                    const Candidates& candidates, const Pending& pending)
        : scene_(scene), rays_(rays), candidates_(candidates), count_(count) {
        for (int which = 0; which < in_flight; ++which)
            flights_[which].queue.place(pending, which, scene.tree_depth);
    }

  public:
    static void nearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                        const Candidates& candidates, const Pending& pending,
                        TraceCounters& counters) {
        InFlightNearest walk(scene, count, rays, candidates, pending);
        Base::go(scene, walk.flights_, walk, counters);
    }

    bool start(Flight& flight) {
        if (next_ == count_) return false;
        if (next_ % 16 == 0) box_rays_.load(scene_, rays_, next_);
        flight.set_out(box_rays_, next_);
        flight.queue.size = 0;
        flight.best = Leaf<Arch, Method>::best_of(candidates_, next_);
        ++next_;
        return true;
    }

    std::uint32_t next(Flight& flight) { return flight.queue.pop(flight.best.first); }

    void at_node(Flight& flight, const NodeView& node) {
        flight.queue.enter(node, flight.box, flight.rows, flight.best.first);
    }

    void at_blocks(const int* which, int count) {
        for (int k = 0; k < count; ++k)
            flights_[which[k]].hits.lanes = 0;
        Base::for_each_at_block(scene_, rays_, which, count, flights_, *this);
        int hit[in_flight], hit_count = 0;
        for (int k = 0; k < count; ++k) {
            hit[hit_count] = which[k];
            hit_count += static_cast<int>(flights_[which[k]].hits.lanes != 0);
        }
        for (int k = 0; k < hit_count; ++k) {
            Flight& flight = flights_[hit[k]];
            const TableView& table = S::table_of(scene_, S::kind_of(flight.child));
            Leaf<Arch, Method>::take(
                flight.hits, table.first_slot + 16 * (flight.child & child_index), flight.best);
        }
    }

    /// Finds the shapes that may be crossed in the block that a ray is at.
    template <class Filter>
    [[gnu::always_inline]] void all(Flight& flight, const TableView& table) const {
        const std::uint32_t number = flight.child & child_index;
        const ClipPlanesView* cut = cut_of<Method>(scene_, table.first_slot + 16 * number);
        S::template with_lanes<Filter>(table, number, [&](const auto& block) {
            Leaf<Arch, Method>::template find<Filter>(block, cut, rays_, flight.i,
                                                      flight.best.second, flight.hits);
        });
    }
    /// Updates the candidates with the pairs that may be crossed.
    template <class Filter>
    [[gnu::always_inline]] void some(const Pairs<Arch, Method>& pairs) {
        const PairBounds bounds = pairs.template bound<Filter>();
        for (std::uint32_t bits = bounds.possible; bits != 0; bits &= bits - 1) {
            const int k = __builtin_ctz(bits);
            Leaf<Arch, Method>::take(bounds.lower[k], pairs.slot[k], flights_[pairs.whose[k]].best);
        }
    }

    void land(const Flight& flight) const {
        Leaf<Arch, Method>::store(flight.best, candidates_, flight.i);
    }
};

} // namespace raylane::simd
