#pragma once

#include "simd/kernel/trace/group.hpp"

namespace raylane::simd {

/// Rays that end at one point, in the order of the directions in which they come there, along a
/// Morton curve: those of a bunch, or a group, are then close together however far apart they
/// start.
template <class Arch>
struct SortedTowards : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    RoundedRays rays;
    Occlusions occlusions;

    static constexpr std::size_t columns = 13;
    static constexpr std::size_t column_of(std::size_t count) { return (count + 31) / 16 * 16; }
    /// Fewer are not worth the work.
    static constexpr std::size_t least_count = 64;
    static bool has_room(std::size_t count, const Workspace& workspace) {
        return count >= least_count && count <= workspace.capacity &&
               column_of(count) * (columns * sizeof(float) + 1) <=
                   workspace.capacity * stream_record_bytes;
    }

    SortedTowards(const RoundedRays& from, const Occlusions& asked, std::size_t count,
                  const Workspace& workspace)
        : rays(from), keys_(workspace.lists) {
        const std::size_t room = column_of(count);
        auto* const column = reinterpret_cast<float*>(workspace.records);
        const auto ids = [&](std::size_t k) {
            return reinterpret_cast<std::uint32_t*>(column + k * room);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            rays.origin[axis] = column + axis * room;
            rays.direction[axis] = column + (3 + axis) * room;
        }
        rays.slack = column + 6 * room;
        std::uint32_t *const first = ids(7), *const last = ids(8);
        rays.departed_first = first;
        rays.departed_last = last;
        float* const t_most = column + 9 * room;
        number_ = ids(10);
        occlusions = {t_most, reinterpret_cast<std::uint8_t*>(column + columns * room)};

        std::uint32_t ends[cells * cells + 1] = {};
        find_keys(from, count, column + 11 * room, column + 12 * room, ends);
        for (std::size_t i = 0; i < count; ++i)
            number_[ends[keys_[i]]++] = static_cast<std::uint32_t>(i);
        for (int axis = 0; axis < 3; ++axis) {
            gather(from.origin[axis], count, rays.origin[axis]);
            gather(from.direction[axis], count, rays.direction[axis]);
        }
        gather(from.slack, count, rays.slack);
        gather(from.departed_first, count, first);
        gather(from.departed_last, count, last);
        gather(asked.t_most, count, t_most);
        gather(asked.state, count, occlusions.state);
    }

    /// What has been found, for who asked.
    void hand_back(const Occlusions& asked, std::size_t count) const {
        for (std::size_t k = 0; k < count; ++k)
            asked.state[number_[k]] = occlusions.state[k];
    }

  private:
    /// A column in the new order.
    template <class Value>
    void gather(const Value* from, std::size_t count, Value* __restrict to) const {
        const std::uint32_t* const number = number_;
        for (std::size_t k = 0; k < count; ++k)
            to[k] = from[number[k]];
    }

    static constexpr unsigned cells = 32; ///< a side
    /// Steeper rays are no part of a group.
    static constexpr float steepest = Group<Arch>::steepest;

    /// Bits of x with one between each.
    static unsigned spread(unsigned x) {
        x = (x | x << 4) & 0x10F;
        x = (x | x << 2) & 0x133;
        return (x | x << 1) & 0x155;
    }

    /// Of each ray its cell in the plane of slopes, and in `ends` where the rays of each begin.
    void find_keys(const RoundedRays& from, std::size_t count, float* u, float* v,
                   std::uint32_t* ends) {
        int along = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (__builtin_fabsf(from.direction[axis][count / 2]) >
                __builtin_fabsf(from.direction[along][count / 2]))
                along = axis;
        F low[2] = {F(steepest), F(steepest)}, high[2] = {F(-steepest), F(-steepest)};
        for (std::size_t i = 0; i < count; i += F::size) {
            const M here = S::first_lanes(count - i);
            const F w = S::load(from.direction[along] + i);
            for (int side = 0; side < 2; ++side) {
                const F any = S::load(from.direction[(along + 1 + side) % 3] + i) / w;
                // What is not a number ends up at one end.
                const F slope = xsimd::max(xsimd::min(any, F(steepest)), F(-steepest));
                slope.store_unaligned((side == 0 ? u : v) + i);
                low[side] = xsimd::min(low[side], xsimd::select(here, slope, low[side]));
                high[side] = xsimd::max(high[side], xsimd::select(here, slope, high[side]));
            }
        }
        float least[2], extent = 0x1p-60F;
        for (int side = 0; side < 2; ++side) {
            least[side] = Lanes<Arch>::least(low[side]);
            const float size = Lanes<Arch>::greatest(high[side]) - least[side];
            extent = size > extent ? size : extent;
        }
        const float scale = (static_cast<float>(cells) - 0.01F) / extent;
        std::uint16_t* const __restrict keys = keys_;
        for (std::size_t i = 0; i < count; ++i) {
            const auto x = static_cast<unsigned>(static_cast<int>((u[i] - least[0]) * scale));
            const auto y = static_cast<unsigned>(static_cast<int>((v[i] - least[1]) * scale));
            keys[i] =
                static_cast<std::uint16_t>(spread(x & (cells - 1)) | spread(y & (cells - 1)) << 1);
        }
        for (std::size_t i = 0; i < count; ++i)
            ++ends[keys[i] + 1];
        for (unsigned key = 0; key < cells * cells; ++key)
            ends[key + 1] += ends[key];
    }

    std::uint16_t* keys_;
    std::uint32_t* number_;
};

} // namespace raylane::simd
