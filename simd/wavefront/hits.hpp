#pragma once

#include "simd/wavefront/paths.hpp"

namespace raylane::simd {

/// What rays hit, by lane.
struct Hits {
    std::uint32_t* slot; ///< no_slot: nothing
    double* t;
    double* error;
    double* normal[3];
    double* shading_normal[3]; ///< null where the scene has no smooth triangles
    std::uint32_t* hit;        ///< hit_bits

    void take_from(Arena& arena, std::size_t capacity, bool smooth) {
        slot = arena.take<std::uint32_t>(capacity);
        t = arena.take<double>(capacity);
        error = arena.take<double>(capacity);
        arena.take(normal, capacity);
        for (double*& column : shading_normal)
            column = smooth ? arena.take<double>(capacity) : nullptr;
        hit = arena.take<std::uint32_t>(capacity);
    }

    /// Lane `from` of `other` to lane `to`.
    void copy(const Hits& other, std::size_t from, std::size_t to) const {
        slot[to] = other.slot[from];
        hit[to] = other.hit[from];
        t[to] = other.t[from];
        error[to] = other.error[from];
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis][to] = other.normal[axis][from];
            if (shading_normal[axis] != nullptr)
                shading_normal[axis][to] = other.shading_normal[axis][from];
        }
    }

    /// The first `count` of these and of the rays, for a kernel to finish.
    Found found(const Paths& paths, std::size_t count) const {
        Found found{};
        found.count = count;
        for (int axis = 0; axis < 3; ++axis) {
            found.origin[axis] = paths.origin[axis];
            found.direction[axis] = paths.direction[axis];
            found.normal[axis] = normal[axis];
            found.shading_normal[axis] = shading_normal[axis];
        }
        found.departed_first = paths.departed_first;
        found.departed_last = paths.departed_last;
        found.departure = paths.departure;
        found.slot = slot;
        found.t = t;
        found.error = error;
        found.hit = hit;
        return found;
    }
};

} // namespace raylane::simd
