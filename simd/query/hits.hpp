#pragma once

#include "core/numbers/vector.hpp"
#include "simd/query/paths.hpp"

#include <utility>

namespace raylane::simd {

/// Form in which hits are requested.
enum class Asked : std::uint8_t {
    points, ///< for images: points and normals, in double
    /// For the library: the floats nearest to t and normals; rays may have exact directions
    /// (Paths), and hits have hit_normal_doubtful.
    floats,
};

/// A hit point that differs from the point to which the ray and its t in double lead.
struct HitPoint {
    std::uint32_t lane;
    core::Vec3d point;
};

/// Hits of rays, by lane.
struct Hits {
    std::uint32_t* slot; ///< no_slot: no hit
    double* t;
    double* error;
    double* normal[3];
    double* shading_normal[3]; ///< null where the scene has no smooth triangles
    std::uint32_t* hit;        ///< Found::hit's bits

    void take_from(Arena& arena, std::size_t capacity, bool smooth) {
        slot = arena.take<std::uint32_t>(capacity);
        t = arena.take<double>(capacity);
        error = arena.take<double>(capacity);
        arena.take(normal, capacity);
        for (double*& column : shading_normal)
            column = smooth ? arena.take<double>(capacity) : nullptr;
        hit = arena.take<std::uint32_t>(capacity);
    }

    /// Copies lane `from` of `other` to lane `to`.
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

    void swap(std::size_t a, std::size_t b) const {
        std::swap(slot[a], slot[b]);
        std::swap(hit[a], hit[b]);
        std::swap(t[a], t[b]);
        std::swap(error[a], error[b]);
        for (int axis = 0; axis < 3; ++axis) {
            std::swap(normal[axis][a], normal[axis][b]);
            if (shading_normal[axis] != nullptr)
                std::swap(shading_normal[axis][a], shading_normal[axis][b]);
        }
    }

    void set_normals(std::size_t lane, const core::Vec3d& flat, const core::Vec3d& shading) const {
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis][lane] = flat[axis];
            if (shading_normal[axis] != nullptr) shading_normal[axis][lane] = shading[axis];
        }
    }

    /// Returns `count` hits and their rays, from `begin` on, for a kernel to solve.
    Found found(const Paths& paths, std::size_t begin, std::size_t count) const {
        Found found{};
        found.count = count;
        for (int axis = 0; axis < 3; ++axis) {
            found.origin[axis] = paths.origin[axis] + begin;
            found.direction[axis] = paths.direction[axis] + begin;
            found.normal[axis] = normal[axis] + begin;
            if (shading_normal[axis] != nullptr)
                found.shading_normal[axis] = shading_normal[axis] + begin;
            if (paths.stand_for_others())
                found.exact_direction[axis] = paths.exact_direction[axis] + begin;
        }
        if (paths.stand_for_others()) found.exact_length = paths.exact_length + begin;
        if (paths.t_after != nullptr) {
            found.t_after = paths.t_after + begin;
            found.start = paths.start + begin;
        }
        found.origin_first = paths.origin_first + begin;
        found.origin_last = paths.origin_last + begin;
        found.origin_bits = paths.origin_bits + begin;
        found.slot = slot + begin;
        found.t = t + begin;
        found.error = error + begin;
        found.hit = hit + begin;
        return found;
    }
};

} // namespace raylane::simd
