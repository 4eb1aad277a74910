#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/shape.hpp"
#include "simd/units/stream_kernels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace raylane::simd {

/// Returns the array from element `first` on; null stays null.
template <class Value>
Value* from(Value* values, std::size_t first) {
    return values != nullptr ? values + first : nullptr;
}

/// Reports a ray that cannot start on the shape that it names. `field` is an array of RayStream.
struct InvalidStart : core::InvalidValue {
    InvalidStart(const core::InvalidValue& invalid, const std::uint32_t* ray_)
        : core::InvalidValue(invalid), ray(ray_) {}

    const std::uint32_t* ray; ///< its element of RayStream::origin_shape
};

/// Points, structure of arrays: coordinate a of point i is at[a][i].
template <class Real>
struct PointStream {
    std::size_t count = 0;
    const Real* at[3] = {};
};

/// The cell of each point: of the solids that it is inside of, the one with the highest id. Null:
/// not requested.
struct CellStream {
    core::ShapeId* shape = nullptr;          ///< no_shape: in no solid
    core::MaterialIndex* material = nullptr; ///< inside of the solid; no_medium: in no solid
    std::uint8_t* on_surface = nullptr;
};

/// The closest surface point of each point, as in core::Closest. Null: not requested.
struct ClosestStream {
    double* distance = nullptr;
    double* point[3] = {};
    core::ShapeId* shape = nullptr;
    std::uint8_t* face = nullptr;
};

/// Normals of hits as doubles, by ray: those of HitStream, but each component is the double nearest
/// to the true one. Null: not requested.
struct NormalStream {
    double* normal[3] = {};

    bool any() const {
        return normal[0] != nullptr || normal[1] != nullptr || normal[2] != nullptr;
    }
};

/// The limits of a ray, in the caller's units.
struct Limits {
    double t_min, t_max;
};
template <class Real>
Limits limits_of(const RayStream<Real>& rays, std::size_t i) {
    return {rays.t_min != nullptr ? static_cast<double>(std::max(Real(0), rays.t_min[i])) : 0.0,
            rays.t_max != nullptr ? static_cast<double>(rays.t_max[i])
                                  : std::numeric_limits<double>::infinity()};
}

/// Return `count` rays from `first` on, and their hits.
template <class Real>
RayStream<Real> part_of(const RayStream<Real>& rays, std::size_t first, std::size_t count) {
    const auto part = [first](const Real* const(&from_all)[3], int axis) {
        return from(from_all[axis], first);
    };
    return {count,
            {part(rays.origin, 0), part(rays.origin, 1), part(rays.origin, 2)},
            {part(rays.direction, 0), part(rays.direction, 1), part(rays.direction, 2)},
            from(rays.t_min, first),
            from(rays.t_max, first),
            from(rays.origin_shape, first),
            from(rays.origin_face, first),
            from(rays.origin_inward, first)};
}

inline HitStream part_of(const HitStream& hits, std::size_t first) {
    return {from(hits.t, first),
            {from(hits.normal[0], first), from(hits.normal[1], first), from(hits.normal[2], first)},
            from(hits.shape, first),
            from(hits.entering, first),
            from(hits.face, first),
            from(hits.t_double, first),
            from(hits.touching, first)};
}

/// Return `count` points from `first` on, their cells and their closest points.
template <class Real>
PointStream<Real> part_of(const PointStream<Real>& points, std::size_t first, std::size_t count) {
    return {count, {points.at[0] + first, points.at[1] + first, points.at[2] + first}};
}

inline CellStream part_of(const CellStream& cells, std::size_t first) {
    return {from(cells.shape, first), from(cells.material, first), from(cells.on_surface, first)};
}

inline ClosestStream part_of(const ClosestStream& closest, std::size_t first) {
    return {from(closest.distance, first),
            {from(closest.point[0], first), from(closest.point[1], first),
             from(closest.point[2], first)},
            from(closest.shape, first),
            from(closest.face, first)};
}

inline NormalStream part_of(const NormalStream& normals, std::size_t first) {
    return {{from(normals.normal[0], first), from(normals.normal[1], first),
             from(normals.normal[2], first)}};
}

/// Store a hit in the requested columns, or that a ray has no hit.
inline void store(const HitStream& hits, std::size_t i, float t, double t_double,
                  const core::Vec3f& normal, core::ShapeId shape, bool entering, core::Face face) {
    if (hits.t != nullptr) hits.t[i] = t;
    if (hits.t_double != nullptr) hits.t_double[i] = t_double;
    for (int axis = 0; axis < 3; ++axis)
        if (hits.normal[axis] != nullptr) hits.normal[axis][i] = normal[axis];
    if (hits.shape != nullptr) hits.shape[i] = shape;
    if (hits.entering != nullptr) hits.entering[i] = entering ? 1 : 0;
    if (hits.face != nullptr) hits.face[i] = face;
}

inline void store_none(const HitStream& hits, std::size_t i) {
    store(hits, i, std::numeric_limits<float>::infinity(), std::numeric_limits<double>::infinity(),
          core::Vec3f(0.0F), core::no_shape, false, core::body);
}

} // namespace raylane::simd
