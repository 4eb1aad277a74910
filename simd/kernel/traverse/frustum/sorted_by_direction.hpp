#pragma once

#include "simd/kernel/traverse/frustum/frustum.hpp"

namespace raylane::simd {

/// Rays that end at one point, in an order in which the rays of a packet arrive from nearly the
/// same direction, however far apart they start. They are sorted only as far as this pays: packets
/// that are narrow already may stay as they are. The rays of the other packets follow, in the order
/// of their directions along a Morton curve.
template <class Arch>
struct SortedByDirection : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    RoundedRays rays;
    Occlusions occlusions;

    static constexpr std::size_t columns = 13;
    static constexpr std::size_t column_of(std::size_t count) { return (count + 31) / 16 * 16; }
    /// Sorting does not pay for fewer rays.
    static constexpr std::size_t min_count = 64;
    static bool has_room(std::size_t count, const Workspace& workspace) {
        return count >= min_count && count <= workspace.capacity &&
               column_of(count) * (columns * sizeof(float) + 1) <=
                   workspace.capacity * list_record_bytes;
    }

    SortedByDirection(const RoundedRays& from, const Occlusions& asked, std::size_t count,
                      const Workspace& workspace)
        : rays(from), occlusions(asked), keys_(workspace.lists), others_(keys_ + column_of(count)) {
        const std::size_t room = column_of(count);
        auto* const column = reinterpret_cast<float*>(workspace.records);
        const auto ids = [&](std::size_t k) {
            return reinterpret_cast<std::uint32_t*>(column + k * room);
        };
        number_ = ids(10);
        u_ = column + 11 * room;
        v_ = column + 12 * room;
        find_slopes(from, count);
        kept_ = keep_narrow(count);
        if (kept_ == count) return;
        sort_others(count);

        for (std::size_t axis = 0; axis < 3; ++axis) {
            rays.origin[axis] = column + axis * room;
            rays.direction[axis] = column + (3 + axis) * room;
        }
        rays.slack = column + 6 * room;
        std::uint32_t *const first = ids(7), *const last = ids(8);
        rays.origin_first = first;
        rays.origin_last = last;
        float* const t_limit = column + 9 * room;
        occlusions = {t_limit, reinterpret_cast<std::uint8_t*>(column + columns * room)};
        for (int axis = 0; axis < 3; ++axis) {
            gather(from.origin[axis], count, rays.origin[axis]);
            gather(from.direction[axis], count, rays.direction[axis]);
        }
        gather(from.slack, count, rays.slack);
        gather(from.origin_first, count, first);
        gather(from.origin_last, count, last);
        gather(asked.t_limit, count, t_limit);
        gather(asked.state, count, occlusions.state);
    }

    /// Writes the results to the caller's arrays, in the caller's order.
    void hand_back(const Occlusions& asked, std::size_t count) const {
        if (kept_ == count) return;
        for (std::size_t k = 0; k < kept_; k += 16)
            __builtin_memcpy(asked.state + number_[k], occlusions.state + k, 16);
        for (std::size_t k = kept_; k < count; ++k)
            asked.state[number_[k]] = occlusions.state[k];
    }

  private:
    /// Copies a column in the new order.
    template <class Value>
    void gather(const Value* from, std::size_t count, Value* __restrict to) const {
        const std::uint32_t* const number = number_;
        for (std::size_t k = 0; k < kept_; k += 16)
            __builtin_memcpy(to + k, from + number[k], 16 * sizeof(Value));
        for (std::size_t k = kept_; k < count; ++k)
            to[k] = from[number[k]];
    }

    static constexpr unsigned cells = 32; ///< per side
    /// Steeper rays cannot be part of a frustum.
    static constexpr float steepest = Frustum<Arch>::steepest;

    /// Returns x with a 0 bit between each two bits.
    static unsigned spread(unsigned x) {
        x = (x | x << 4) & 0x10F;
        x = (x | x << 2) & 0x133;
        return (x | x << 1) & 0x155;
    }

    void find_slopes(const RoundedRays& from, std::size_t count) {
        int along = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (__builtin_fabsf(from.direction[axis][count / 2]) >
                __builtin_fabsf(from.direction[along][count / 2]))
                along = axis;
        F low[2] = {F(steepest), F(steepest)}, high[2] = {F(-steepest), F(-steepest)};
        for (std::size_t i = 0; i < count; i += F::size) {
            const M filled = S::first_lanes(count - i);
            const F w = S::load(from.direction[along] + i);
            for (int side = 0; side < 2; ++side) {
                const F any = S::load(from.direction[(along + 1 + side) % 3] + i) / w;
                // NaN is clamped to one of the ends.
                const F slope = max(min(any, F(steepest)), F(-steepest));
                slope.store_unaligned((side == 0 ? u_ : v_) + i);
                low[side] = min(low[side], select(filled, slope, low[side]));
                high[side] = max(high[side], select(filled, slope, high[side]));
            }
        }
        for (int side = 0; side < 2; ++side) {
            least_[side] = Lanes<Arch>::least(low[side]);
            extent_[side] = Lanes<Arch>::greatest(high[side]) - least_[side];
        }
    }

    /// True if a ray of a packet is further than `most` from the packet's first ray.
    bool is_wide(std::size_t packet, float most) const {
        const F u(u_[packet]), v(v_[packet]);
        std::uint32_t apart = 0;
        for (std::size_t i = packet; i < packet + 16; i += F::size)
            apart |=
                Lanes<Arch>::bits(abs(S::load(u_ + i) - u) + abs(S::load(v_ + i) - v) > F(most));
        return apart != 0;
    }

    /// Numbers the rays of narrow packets and lists the other packets. A packet is narrow if it is
    /// whole, and at most `wide` times as wide as if all packets filled a rectangle without
    /// overlapping. Returns the number of rays in narrow packets, or `count` if nearly all are, or
    /// 0 if too few are.
    std::size_t keep_narrow(std::size_t count) {
        const float packets = static_cast<float>((count + 15) / 16);
        const float most = wide * (extent_[0] + extent_[1]) / __builtin_sqrtf(packets);
        std::size_t kept = 0;
        others_count_ = 0;
        for (std::size_t packet = 0; packet < count; packet += 16) {
            for (std::size_t lane = 0; lane < 16; ++lane)
                number_[kept + lane] = static_cast<std::uint32_t>(packet + lane);
            others_[others_count_] = static_cast<std::uint16_t>(packet);
            const bool keeps = packet + 16 <= count && !is_wide(packet, most);
            kept += keeps ? 16 : 0;
            others_count_ += keeps ? 0 : 1;
        }
        if (static_cast<float>(kept) > nearly_all * static_cast<float>(count)) return count;
        if (static_cast<float>(kept) > enough * static_cast<float>(count)) return kept;
        for (others_count_ = 0; 16 * others_count_ < count; ++others_count_)
            others_[others_count_] = static_cast<std::uint16_t>(16 * others_count_);
        return 0;
    }

    /// Numbers the rays of the other packets by their cells in the plane of slopes.
    void sort_others(std::size_t count) {
        const float extent = extent_[0] > extent_[1] ? extent_[0] : extent_[1];
        const float scale = (static_cast<float>(cells) - 0.01F) / (extent + 0x1p-60F);
        std::uint16_t* const __restrict keys = keys_;
        const float *const u = u_, *const v = v_, left = least_[0], lower = least_[1];
        for (std::size_t i = 0; i < count; ++i) {
            const auto x = static_cast<unsigned>(static_cast<int>((u[i] - left) * scale));
            const auto y = static_cast<unsigned>(static_cast<int>((v[i] - lower) * scale));
            keys[i] =
                static_cast<std::uint16_t>(spread(x & (cells - 1)) | spread(y & (cells - 1)) << 1);
        }
        std::uint32_t ends[cells * cells + 1] = {};
        for (std::size_t k = 0; k < others_count_; ++k)
            for (std::size_t i = others_[k], end = end_of(i, count); i < end; ++i)
                ++ends[keys[i] + 1];
        ends[0] = static_cast<std::uint32_t>(kept_);
        for (unsigned key = 0; key < cells * cells; ++key)
            ends[key + 1] += ends[key];
        for (std::size_t k = 0; k < others_count_; ++k)
            for (std::size_t i = others_[k], end = end_of(i, count); i < end; ++i)
                number_[ends[keys[i]]++] = static_cast<std::uint32_t>(i);
    }

    static std::size_t end_of(std::size_t packet, std::size_t count) {
        return packet + 16 < count ? packet + 16 : count;
    }

    static constexpr float wide = 1.5F, nearly_all = 0.85F, enough = 0.75F;

    std::uint16_t *keys_, *others_;
    std::uint32_t* number_;
    float *u_, *v_;
    float least_[2], extent_[2];
    std::size_t kept_, others_count_ = 0;
};

} // namespace raylane::simd
