#pragma once

#include "core/media.hpp"
#include "simd/scene_view.hpp"
#include "simd/wavefront/arena.hpp"

#include <cstdint>

namespace raylane::simd {

/// Rays underway, structure of arrays: what core::ReferenceTracer::Path holds, but the depth, which
/// a whole wave shares.
struct Paths {
    std::size_t count = 0;
    double* origin[3];
    double* direction[3];
    double* throughput[3];
    std::uint32_t* sample;
    /// The shapes left, first to last id, the one that was hit, and departure_bits.
    std::uint32_t* departed_first;
    std::uint32_t* departed_last;
    std::uint32_t* departed_slot;
    std::uint32_t* departure;
    std::uint32_t* media[core::Media::depth]; ///< null where nothing transmits

    void take_from(Arena& arena, std::size_t capacity, bool with_media) {
        arena.take(origin, capacity);
        arena.take(direction, capacity);
        arena.take(throughput, capacity);
        sample = arena.take<std::uint32_t>(capacity);
        departed_first = arena.take<std::uint32_t>(capacity);
        departed_last = arena.take<std::uint32_t>(capacity);
        departed_slot = arena.take<std::uint32_t>(capacity);
        departure = arena.take<std::uint32_t>(capacity);
        for (std::uint32_t*& column : media)
            column = with_media ? arena.take<std::uint32_t>(capacity) : nullptr;
    }

    core::Media media_at(std::size_t lane) const {
        if (media[0] == nullptr) return {};
        return core::Media({media[0][lane], media[1][lane], media[2][lane], media[3][lane]});
    }

    void set_media(std::size_t lane, const core::Media& values) const {
        if (media[0] == nullptr) return;
        for (int i = 0; i < core::Media::depth; ++i)
            media[i][lane] = values.at(i);
    }

    /// Lane `from` of `other` to lane `to`.
    void copy(const Paths& other, std::size_t from, std::size_t to) const {
        copy_ray(other, from, to);
        for (int channel = 0; channel < 3; ++channel)
            throughput[channel][to] = other.throughput[channel][from];
        sample[to] = other.sample[from];
        if (media[0] == nullptr) return;
        for (int i = 0; i < core::Media::depth; ++i)
            media[i][to] = other.media[i][from];
    }

    /// The ray alone, and what it leaves.
    void copy_ray(const Paths& other, std::size_t from, std::size_t to) const {
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis][to] = other.origin[axis][from];
            direction[axis][to] = other.direction[axis][from];
        }
        departed_first[to] = other.departed_first[from];
        departed_last[to] = other.departed_last[from];
        departed_slot[to] = other.departed_slot[from];
        departure[to] = other.departure[from];
    }
};

} // namespace raylane::simd
