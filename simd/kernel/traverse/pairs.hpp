#pragma once

#include "simd/kernel/traverse/leaf.hpp"

namespace raylane::simd {

/// True if rays are paired with the shapes of this filter: its bounds are costly, and it can reject
/// rays at less cost.
template <class Filter, class Method>
inline constexpr bool packs_pairs =
    Method::rounded_alone&& sifts_packets<Filter, typename Method::Rays>;

/// Bounds of pairs, with masks as bits. `possible` is set only for pairs that exist, and never for
/// a shape that the ray starts on.
struct PairBounds {
    float lower[16], upper[16];
    std::uint32_t possible, certain;
};

/// Pairs of a ray and a shape that it may meet, one per lane. A ray may meet only one or two of the
/// shapes in a block.
template <class Arch, class Method>
class Pairs : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

  public:
    std::uint32_t slot[16];
    int whose[16]; ///< the caller's number of the ray

    /// Adds the pairs of a ray and the shapes in a block that it may meet. Whenever there are 16
    /// pairs, calls take() and starts again with none.
    template <class Filter, class Take>
    [[gnu::always_inline]] void gather(const TableView& table, std::uint32_t number,
                                       const float* block, const RoundedRays& rays, std::size_t i,
                                       int owner, const Take& take) {
        std::uint32_t bits =
            Leaf<Arch, Method>::template may_meet<Filter>(PlainLanes<Arch>(table, block), rays, i);
        for (; bits != 0; bits &= bits - 1) {
            add(table, number, block, __builtin_ctz(bits), rays, i, owner);
            if (count_ == 16) flush(take);
        }
    }
    /// Calls take() for the remaining pairs.
    template <class Take>
    [[gnu::always_inline]] void flush(const Take& take) {
        if (count_ != 0) take();
        count_ = 0;
    }

    bool empty() const { return count_ == 0; }

    /// Returns the bounds of the pairs. Not inlined, as all callers share it.
    template <class Filter>
    [[gnu::noinline]] PairBounds bound() const {
        static_assert(Filter::values <= max_values);
        PairBounds result{};
        for (int from = 0; from < count_; from += static_cast<int>(F::size)) {
            const auto load = [&](const float(&rows)[3][16]) {
                return Vectors<Arch>{S::load(rows[0] + from), S::load(rows[1] + from),
                                     S::load(rows[2] + from)};
            };
            const Bounds<Arch> bounds =
                Filter(BlockReader<Arch>(values_, from))
                    .bounds({load(origin_), load(direction_), S::load(slack_ + from)});
            const M possible =
                bounds.possible & S::first_lanes(static_cast<std::size_t>(count_ - from));
            result.possible |= Lanes<Arch>::bits(possible) << from;
            result.certain |= Lanes<Arch>::bits(possible & bounds.certain) << from;
            bounds.lower.store_unaligned(result.lower + from);
            bounds.upper.store_unaligned(result.upper + from);
        }
        return result;
    }

  private:
    void add(const TableView& table, std::uint32_t number, const float* block, int lane,
             const RoundedRays& rays, std::size_t i, int owner) {
        const auto rows = S::rows_of(block);
        for (std::uint32_t value = 0; value < table.values; ++value)
            values_[value][count_] = rows[value][lane];
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis][count_] = rays.origin[axis][i];
            direction_[axis][count_] = rays.direction[axis][i];
        }
        slack_[count_] = rays.slack[i];
        slot[count_] = table.first_slot + 16 * number + static_cast<std::uint32_t>(lane);
        whose[count_++] = owner;
    }

    static constexpr int max_values = 8;

    float values_[max_values][16];
    float origin_[3][16], direction_[3][16], slack_[16];
    int count_ = 0;
};

/// Pairs of each kind, collected across blocks.
template <class Arch, class Method>
class PairsByKind {
  public:
    Pairs<Arch, Method>& of(core::Kind kind) { return pairs_[static_cast<int>(kind)]; }

    /// Calls take.template operator()<Filter>(pairs) for the remaining pairs of each kind.
    template <class Take>
    [[gnu::always_inline]] void flush(const Take& take) {
        Streams<Arch>::for_each_kind((1U << core::kind_count) - 1, [&](core::Kind kind) {
            if (!of(kind).empty())
                Method::with_filter(kind, [&]<class Filter>() {
                    if constexpr (packs_pairs<Filter, Method>)
                        of(kind).flush([&] { take.template operator()<Filter>(of(kind)); });
                });
        });
    }

  private:
    Pairs<Arch, Method> pairs_[core::kind_count];
};

} // namespace raylane::simd
