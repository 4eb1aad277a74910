#pragma once

#include "simd/kernel/trace/box_ray.hpp"

namespace raylane::simd {

/// What a ray is still to visit: up to 16 children and where it enters them, in no order. The next
/// is the first that it enters. What does not fit waits elsewhere until the rest is done, and then
/// comes back: of each such heap, the next one is below one of its children, so that there is no
/// more than one to a level.
template <class Arch>
struct Queue {
    using S = Streams<Arch>;
    using F = Floats<Arch>;
    static constexpr int lanes = static_cast<int>(F::size);

    alignas(64) float t[16 + F::size]; ///< the first `size`
    std::uint32_t child[16 + F::size];
    int size;
    int spilled; ///< entries elsewhere; their number by heaps is in between

    void clear() { size = spilled = 0; }

    /// Adds the children of a node, and pops. `first` is the t of the nearest crossing so far.
    [[gnu::always_inline]] std::uint32_t step(const NodeView& node, const BoxRay& ray,
                                              const BoxRay::Rows& rows, float first,
                                              const Pending& pending) {
        const F t_most(first * culling_slack);
        for (int from = 0; from < 16; from += lanes) {
            F near = zero<Arch>();
            const std::uint32_t bits = ray.template enter<Arch>(node, rows, from, t_most, near);
            const int more = __builtin_popcount(bits);
            if (size + more > 16) [[unlikely]]
                spill(pending);
            Lanes<Arch>::compress_store(t + size, xsimd::min(near, F(largest)), bits);
            Lanes<Arch>::compress_store(reinterpret_cast<float*>(child + size),
                                        S::load_bits(node.children + from), bits);
            size += more;
        }
        return pop(first, pending);
    }

    /// The next child, unless all are entered too far behind the first crossing. Each t has its
    /// place in its last bits, which makes it less by 15 ulps at most.
    [[gnu::always_inline]] std::uint32_t pop(float first, const Pending& pending) {
        float limit = first * culling_slack * BoxRay::allowance;
        limit = limit < largest ? limit : largest;
        float least = least_tagged();
        while (spilled != 0 && least > limit)
            [[unlikely]] {
                unspill(pending);
                least = least_tagged();
            }
        const std::uint32_t place = __builtin_bit_cast(std::uint32_t, least) & 15;
        const bool any = least <= limit;
        size -= static_cast<int>(any);
        const std::uint32_t result = any ? child[place] : no_child;
        t[place] = t[size];
        child[place] = child[size];
        return result;
    }

  private:
    static constexpr float largest = 0x1.FFFFFEp127F;

    float least_tagged() const {
        static constexpr std::uint32_t places[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                     8, 9, 10, 11, 12, 13, 14, 15};
        static constexpr float numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
        const F end(static_cast<float>(size)), high = S::broadcast_bits(~15U);
        F least = S::infinity();
        for (int from = 0; from < 16; from += lanes) {
            const F tagged = (S::load(t + from) & high) | S::load_bits(places + from);
            least = xsimd::min(least,
                               xsimd::select(S::load(numbers + from) < end, tagged, S::infinity()));
        }
        return Lanes<Arch>::least(least);
    }

    /// The last heap, or as much of it as there is room for.
    [[gnu::noinline]] void unspill(const Pending& pending) {
        const int some = spilled < 16 ? spilled : 16;
        for (size = 0; size < some; ++size) {
            --spilled;
            t[size] = pending.t[spilled];
            child[size] = pending.child[spilled];
        }
    }

    [[gnu::noinline]] void spill(const Pending& pending) {
        for (int i = 0; i < size; ++i) {
            pending.t[spilled] = t[i];
            pending.child[spilled++] = child[i];
        }
        size = 0;
    }
};

#ifdef __AVX512F__
/// In registers while it is worked on. An empty place has t = infinity.
template <>
struct Queue<Avx512> {
    alignas(64) float t[16];
    std::uint32_t child[16];
    int spilled;

    void clear() {
        _mm512_store_ps(t, _mm512_set1_ps(__builtin_inff()));
        spilled = 0;
    }

    [[gnu::always_inline]] std::uint32_t step(const NodeView& node, const BoxRay& ray,
                                              const BoxRay::Rows& rows, float first,
                                              const Pending& pending) {
        const __m512 empty = _mm512_set1_ps(__builtin_inff());
        Floats<Avx512> near = _mm512_setzero_ps();
        const auto entered =
            static_cast<__mmask16>(ray.enter<Avx512>(node, rows, 0, first * culling_slack, near));
        __m512 ts = _mm512_load_ps(t);
        __m512i children = _mm512_load_si512(child);
        __mmask16 room = _mm512_cmp_ps_mask(ts, empty, _CMP_EQ_OQ);
        if (__builtin_popcount(room) < __builtin_popcount(entered)) [[unlikely]] {
            spill(pending);
            ts = empty;
            room = 0xFFFF;
        }
        const __m512 finite = _mm512_min_ps(near, _mm512_set1_ps(largest));
        const __m512 new_ts = _mm512_mask_compress_ps(empty, entered, finite);
        const __m512i new_children =
            _mm512_maskz_compress_epi32(entered, _mm512_loadu_si512(node.children));
        return pop(_mm512_mask_expand_ps(ts, room, new_ts),
                   _mm512_mask_expand_epi32(children, room, new_children), first, pending);
    }

    [[gnu::always_inline]] std::uint32_t pop(float first, const Pending& pending) {
        return pop(_mm512_load_ps(t), _mm512_load_si512(child), first, pending);
    }

  private:
    static constexpr float largest = 0x1.FFFFFEp127F;

    [[gnu::always_inline]] std::uint32_t pop(__m512 ts, __m512i children, float first,
                                             const Pending& pending) {
        const __m512 empty = _mm512_set1_ps(__builtin_inff());
        float limit = first * culling_slack * BoxRay::allowance;
        limit = limit < largest ? limit : largest;
        float least = _mm512_reduce_min_ps(ts);
        while (spilled != 0 && least > limit)
            [[unlikely]] {
                const int some = spilled < 16 ? spilled : 16;
                spilled -= some;
                const auto wanted = static_cast<__mmask16>((1U << some) - 1);
                ts = _mm512_mask_loadu_ps(empty, wanted, pending.t + spilled);
                children = _mm512_maskz_loadu_epi32(wanted, pending.child + spilled);
                least = _mm512_reduce_min_ps(ts);
            }
        const std::uint32_t all = _mm512_cmp_ps_mask(ts, _mm512_set1_ps(least), _CMP_EQ_OQ);
        _mm512_store_ps(t, _mm512_mask_mov_ps(ts, static_cast<__mmask16>(all & -all), empty));
        _mm512_store_si512(child, children);
        const std::uint32_t nearest = child[__builtin_ctz(all)];
        return least <= limit ? nearest : no_child;
    }

    [[gnu::noinline]] void spill(const Pending& pending) {
        for (int i = 0; i < 16; ++i) {
            if (!(t[i] < __builtin_inff())) continue;
            pending.t[spilled] = t[i];
            pending.child[spilled++] = child[i];
        }
    }
};
#endif

} // namespace raylane::simd
