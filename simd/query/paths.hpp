#pragma once

#include "core/optics/media.hpp"
#include "simd/query/scene_data.hpp"
#include "simd/threads/arena.hpp"
#include "simd/units/kernels.hpp"

#include <algorithm>
#include <cstdint>

namespace raylane::simd {

/// Rays in double, structure of arrays, with the ids of the shapes that they leave, first to last.
struct RayColumns {
    std::size_t count;
    const double* origin[3];
    const double* direction[3]; ///< of length 1
    const std::uint32_t* origin_first;
    const std::uint32_t* origin_last;
    const double* start = nullptr; ///< crossings before it do not count; null: 0
};

/// Lengths below this may lose digits as floats.
inline constexpr float min_length = 0x1p-100F;

/// Origin bit in addition to the kernels': the ray may cross again the shape that it starts on.
inline constexpr std::uint32_t origin_may_return = 0x10000;
static_assert(((stream_tie_counts | stream_half_ulp) & origin_may_return) == 0);

/// Rays in progress, structure of arrays: the members of core::ReferenceTracer::Path except for the
/// depth, which a whole wave shares.
struct Paths {
    std::size_t count = 0;
    double* origin[3];
    double* direction[3];
    double* throughput[3];
    std::uint32_t* sample;
    /// The shapes that a ray leaves: first and last id, slot of the one that was hit, and origin
    /// bits.
    std::uint32_t* origin_first;
    std::uint32_t* origin_last;
    std::uint32_t* origin_slot;
    std::uint32_t* origin_bits;
    core::Media* media; ///< media that the ray is inside of; null without transmissive materials
    /// Transparent surfaces passed in a straight line, and the length of this line before the ray's
    /// start. Null without transparent surfaces; `travelled` is null without fog, too.
    std::uint32_t* passed = nullptr;
    double* travelled = nullptr;
    /// Exact directions, of any length, and their lengths. `direction` is then their normalised
    /// form, which is rounded. Null: `direction` is exact.
    double* exact_direction[3];
    double* exact_length;
    /// Lower limits, as in StreamRays, of rays with exact directions. Null: no limits.
    double* t_after;
    double* start;

    void take_from(Arena& arena, std::size_t capacity, bool with_media, bool for_others = false) {
        arena.take(origin, capacity);
        arena.take(direction, capacity);
        arena.take(throughput, capacity);
        sample = arena.take<std::uint32_t>(capacity);
        origin_first = arena.take<std::uint32_t>(capacity);
        origin_last = arena.take<std::uint32_t>(capacity);
        origin_slot = arena.take<std::uint32_t>(capacity);
        origin_bits = arena.take<std::uint32_t>(capacity);
        media = with_media ? arena.take<core::Media>(capacity) : nullptr;
        for (double*& column : exact_direction)
            column = for_others ? arena.take<double>(capacity) : nullptr;
        exact_length = for_others ? arena.take<double>(capacity) : nullptr;
        t_after = for_others ? arena.take<double>(capacity) : nullptr;
        start = for_others ? arena.take<double>(capacity) : nullptr;
    }

    void take_passed_from(Arena& arena, std::size_t capacity, bool with_fog) {
        passed = arena.take<std::uint32_t>(capacity);
        if (with_fog) travelled = arena.take<double>(capacity);
    }

    bool stand_for_others() const { return exact_length != nullptr; }
    /// Returns the length of the exact direction.
    double length_of(std::size_t lane) const {
        return stand_for_others() ? exact_length[lane] : 1.0;
    }

    core::Media media_at(std::size_t lane) const {
        return media != nullptr ? media[lane] : core::empty_space;
    }

    void set_media(std::size_t lane, core::Media values) const {
        if (media != nullptr) media[lane] = values;
    }

    std::uint32_t passed_at(std::size_t lane) const {
        return passed != nullptr ? passed[lane] : 0U;
    }

    double travelled_at(std::size_t lane) const {
        return travelled != nullptr ? travelled[lane] : 0.0;
    }

    void set_passed(std::size_t lane, std::uint32_t surfaces, double way) const {
        if (passed != nullptr) passed[lane] = surfaces;
        if (travelled != nullptr) travelled[lane] = way;
    }

    void move_to(std::size_t lane, const core::Vec3d& point) const {
        for (int axis = 0; axis < 3; ++axis)
            origin[axis][lane] = point[axis];
    }

    /// Starts the lane's ray on a shape, at a hit with these bits: on the side to which the ray
    /// that hit it goes if it passes `through`, otherwise on the side from which it came. Shape:
    /// SceneData::ShapeRecord, or the members of it that NamedShape has.
    template <class Shape>
    void start_on(std::size_t lane, std::uint32_t slot, const Shape& shape, std::uint32_t hit,
                  bool through) const {
        const bool inward = through == ((hit & hit_entering) != 0);
        origin_first[lane] = shape.coplanar.first;
        origin_last[lane] = shape.coplanar.last;
        origin_slot[lane] = slot;
        origin_bits[lane] = (hit & hit_face) | (inward ? origin_inward : 0) |
                            (shape.may_be_met_again(inward) ? origin_may_return : 0);
    }

    /// Starts lanes `begin` to `end` on no surface.
    void start_nowhere(std::size_t begin, std::size_t end) const {
        for (std::uint32_t* column : {origin_first, origin_last, origin_slot})
            std::fill(column + begin, column + end, no_slot);
        std::fill(origin_bits + begin, origin_bits + end, 0U);
    }

    RayColumns columns() const {
        return {count,
                {origin[0], origin[1], origin[2]},
                {direction[0], direction[1], direction[2]},
                origin_first,
                origin_last,
                start};
    }

    /// Copies lane `from` of `other` to lane `to`.
    void copy(const Paths& other, std::size_t from, std::size_t to) const {
        copy_ray(other, from, to);
        for (int channel = 0; channel < 3; ++channel)
            throughput[channel][to] = other.throughput[channel][from];
        sample[to] = other.sample[from];
        if (media != nullptr) media[to] = other.media[from];
        if (passed != nullptr) passed[to] = other.passed[from];
        if (travelled != nullptr) travelled[to] = other.travelled[from];
    }

    /// Copies the ray alone, and the shapes that it leaves.
    void copy_ray(const Paths& other, std::size_t from, std::size_t to) const {
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis][to] = other.origin[axis][from];
            direction[axis][to] = other.direction[axis][from];
        }
        if (stand_for_others() && other.stand_for_others()) {
            for (int axis = 0; axis < 3; ++axis)
                exact_direction[axis][to] = other.exact_direction[axis][from];
            exact_length[to] = other.exact_length[from];
        }
        if (t_after != nullptr) {
            t_after[to] = other.t_after != nullptr ? other.t_after[from] : 0.0;
            start[to] = other.t_after != nullptr ? other.start[from] : 0.0;
        }
        origin_first[to] = other.origin_first[from];
        origin_last[to] = other.origin_last[from];
        origin_slot[to] = other.origin_slot[from];
        origin_bits[to] = other.origin_bits[from];
    }
};

} // namespace raylane::simd
