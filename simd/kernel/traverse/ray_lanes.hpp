#pragma once

#include "simd/kernel/traverse/cut.hpp"

namespace raylane::simd {

/// Rays of a stream, one per lane.
template <class Arch, class Method>
struct RayLanes {
    using S = Streams<Arch>;
    using F = Floats<Arch>;

    typename Method::Rays rays;
    F origin_first, origin_last;

    RayLanes(const typename Method::Rays& rays_there, const F& first, const F& last)
        : rays(rays_there), origin_first(first), origin_last(last) {}
    RayLanes(const RoundedRays& stream, std::size_t i)
        : rays(Method::packet(stream, i)), origin_first(S::load_bits(stream.origin_first + i)),
          origin_last(S::load_bits(stream.origin_last + i)) {}

    CutRays<Arch> to_cut() const { return {rays, origin_first, origin_last}; }

    /// True for rays that do not start on the shape.
    Mask<Arch> elsewhere(std::uint32_t id) const {
        return ~Lanes<Arch>::in_range(S::broadcast_bits(id), origin_first, origin_last);
    }
};

/// Candidates of a packet's rays.
template <class Arch>
struct LaneCandidates {
    using S = Streams<Arch>;
    using F = Floats<Arch>;

    F first, second, slot;

    LaneCandidates(const Candidates& candidates, std::size_t i)
        : first(S::load(candidates.first + i)), second(S::load(candidates.second + i)),
          slot(S::load_bits(candidates.slot + i)) {}

    void store(const Candidates& candidates, std::size_t i) const {
        first.store_unaligned(candidates.first + i);
        second.store_unaligned(candidates.second + i);
        S::store_bits(slot, candidates.slot + i);
    }

    /// Updates the candidates with one shape. `crossed` is as in bounds_of_cut().
    template <class Filter, class Method, class Crossed = NoCrossedFaces>
    [[gnu::always_inline]] void
    test(const Filter& filter, std::uint32_t id, std::uint32_t this_slot, const ClipPlanesView* cut,
         const RayLanes<Arch, Method>& packet, const Crossed& crossed = {}) {
        if constexpr (sifts_packets<Filter, typename Method::Rays>)
            if (Lanes<Arch>::bits(filter.may_meet(packet.rays)) == 0) return;
        if constexpr (knows_cuts<Method>)
            if (cut != nullptr)
                return take(bounds_of_cut<Arch>(filter, packet.to_cut(), *cut, crossed),
                            packet.elsewhere(id), this_slot);
        take(filter.bounds(packet.rays), packet.elsewhere(id), this_slot);
    }

    /// Restores the candidates `before`, except in lanes of `chosen`.
    void keep(const Mask<Arch>& chosen, const LaneCandidates& before) {
        first = select(chosen, first, before.first);
        second = select(chosen, second, before.second);
        slot = select(chosen, slot, before.slot);
    }

    /// Updates the candidates with the bounds of one shape, in lanes of `counts`.
    [[gnu::always_inline]] void take(const Bounds<Arch>& bounds, const Mask<Arch>& counts,
                                     std::uint32_t this_slot) {
        const F t = select(bounds.possible & counts, bounds.lower, S::infinity());
        slot = select(t < first, S::broadcast_bits(this_slot), slot);
        second = min(second, max(t, first));
        first = min(first, t);
    }
};

/// Occlusions of a packet's rays.
template <class Arch>
struct LaneOcclusions {
    using S = Streams<Arch>;
    using F = Floats<Arch>;

    F t_limit, perhaps_before, surely_before;
    std::uint32_t maybe_blocked = 0; ///< rays that may be blocked, as bits
    std::uint32_t sure = 0;          ///< rays that are certainly blocked, as bits

    LaneOcclusions(const Occlusions& occlusions, std::size_t i)
        : t_limit(S::load(occlusions.t_limit + i)), perhaps_before(t_limit * F(perhaps_within)),
          surely_before(t_limit * F(surely_within)) {}

    /// Updates the occlusions with one shape, for the rays in `asked`.
    template <class Filter, class Method>
    [[gnu::always_inline]] void
    test(const Filter& filter, std::uint32_t id, bool plain, const ClipPlanesView* cut,
         const RayLanes<Arch, Method>& packet, std::uint32_t asked = ~0U) {
        asked &= Lanes<Arch>::bits(packet.elsewhere(id));
        if (asked == 0) return;
        if constexpr (sifts_packets<Filter, typename Method::Rays>)
            if (Lanes<Arch>::bits(filter.may_meet(packet.rays)) == 0) return;
        if constexpr (knows_cuts<Method>)
            if (cut != nullptr && !plain) {
                maybe_blocked |= Lanes<Arch>::bits(may_cross_cut<Arch>(filter, packet.to_cut(),
                                                                       *cut, perhaps_before)) &
                                 asked;
                return;
            }
        const Obstacle<Arch> obstacle =
            obstacle_of<Arch>(filter, packet.rays, asked, perhaps_before, surely_before);
        maybe_blocked |= Lanes<Arch>::bits(obstacle.possible) & asked;
        if (plain) sure |= Lanes<Arch>::bits(obstacle.possible & obstacle.certain) & asked;
    }

    /// Stores at most the first `count` lanes. Returns whether all of these are blocked.
    bool store(std::uint8_t* state, std::size_t count) const {
        bool all_blocked = true;
        for (std::size_t lane = 0; lane < count && lane < F::size; ++lane) {
            if ((sure >> lane & 1) != 0)
                state[lane] = blocked;
            else if ((maybe_blocked >> lane & 1) != 0 && state[lane] == unblocked)
                state[lane] = doubtful;
            all_blocked = all_blocked && state[lane] == blocked;
        }
        return all_blocked;
    }
};

} // namespace raylane::simd
