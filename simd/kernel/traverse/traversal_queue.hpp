#pragma once

#include "simd/kernel/lanes/short_lanes.hpp"
#include "simd/kernel/traverse/box_ray.hpp"

namespace raylane::simd {

/// Queue of the children that a ray has yet to visit, with the t at which it enters them. The next
/// child is the one that the ray enters first, out of the last 16. t is held in 16 bits, which
/// suffices for ordering: if the ray enters two children within 1/256 of each other, either may be
/// the next.
template <class Arch>
struct TraversalQueue {
    using S = Streams<Arch>;
    using F = Floats<Arch>;
    static constexpr int window = 16;

    std::uint16_t* key; ///< after 16 keys without a child
    std::uint32_t* child;
    int size;

    /// Places the queue in the memory for one ray.
    void place(const Pending& pending, int ray, std::uint32_t levels) {
        const std::size_t room = pending_entries(levels) * static_cast<std::size_t>(ray);
        key = pending.key + room + window;
        child = pending.child + room + window;
        for (int i = -window; i < 0; ++i)
            key[i] = 0xFFFF;
    }

    /// Starts with one child, which every ray enters.
    void start(std::uint32_t only) {
        key[0] = 0;
        child[0] = only;
        size = 1;
    }

    /// Adds the children of a node that are entered before `first`, the t of the nearest crossing
    /// so far.
    [[gnu::always_inline]] void enter(const NodeView& node, const BoxRay& ray,
                                      const BoxRay::Rows& rows, float first) {
        const F t_limit(first * culling_slack);
        for (int from = 0, end = end_of_filled<Arch>(node.children); from < end;
             from += static_cast<int>(F::size)) {
            F near = zero<Arch>();
            const std::uint32_t bits = ray.template enter<Arch>(node, rows, from, t_limit, near);
            add(near, node.children + from, bits);
        }
    }

    /// Does the same and returns the next child, for a ray that is traced alone: if the children
    /// are in one register, the nearest of these, which does not go through memory.
    [[gnu::always_inline]] std::uint32_t enter_next(const NodeView& node, const BoxRay& ray,
                                                    const BoxRay::Rows& rows, float first) {
        if (end_of_filled<Arch>(node.children) > static_cast<int>(F::size)) {
            enter(node, ray, rows, first);
            return pop(first);
        }
        F near = zero<Arch>();
        const Mask<Arch> entered =
            ray.template entered<Arch>(node, rows, 0, F(first * culling_slack), near);
        const std::uint32_t bits = Lanes<Arch>::bits(entered);
        if (bits == 0) return pop(first);
        const F least(Lanes<Arch>::least(select(entered, near, S::infinity())));
        const std::uint32_t nearest = Lanes<Arch>::bits(entered & (near <= least));
        const std::uint32_t others = bits & ~(nearest & (0U - nearest));
        add(near, node.children, others);
        return node.children[__builtin_ctz(nearest)];
    }

    /// Adds the wanted ones of a register's worth of children, entered at `near` >= 0.
    [[gnu::always_inline]] void add(const F& near, const std::uint32_t* children,
                                    std::uint32_t wanted) {
        ShortLanes<Arch>::compress_keys(key + size, near, wanted);
        Lanes<Arch>::compress_store(reinterpret_cast<float*>(child + size), S::load_bits(children),
                                    wanted);
        size += __builtin_popcount(wanted);
    }

    /// Returns the next child, or no_child if all are entered too far beyond the first crossing.
    [[gnu::always_inline]] std::uint32_t pop(float first) {
        return pop_before(first * culling_slack * BoxRay::allowance);
    }

    /// Returns the child that was added last, or no_child if the queue is empty.
    std::uint32_t pop_last() { return size == 0 ? no_child : child[--size]; }

    /// Returns the next child, or no_child if all are entered beyond `limit`. No branch depends on
    /// the ray, except when the last 16 children are all beyond the limit.
    [[gnu::always_inline]] std::uint32_t pop_before(float limit) {
        const float positive = limit > 0 ? limit : 0;
        const std::uint32_t last = __builtin_bit_cast(std::uint32_t, positive) >> 15;
        for (;;) {
            const std::uint32_t nearest = ShortLanes<Arch>::min_of_16(key + size - window);
            const std::uint32_t behind = static_cast<std::uint32_t>((nearest >> 16) <= last) - 1;
            const int at = size - window + static_cast<int>(nearest & 0xFFFF);
            const std::uint32_t result = child[at] | behind;
            key[at] = key[size - 1];
            child[at] = child[size - 1];
            size -= static_cast<int>(behind & (window - 1)) + 1;
            if (result != no_child) [[likely]]
                return result;
            if (size <= 0) return result;
        }
    }
};

} // namespace raylane::simd
