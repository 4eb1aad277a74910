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
