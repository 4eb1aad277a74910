#pragma once

#include "simd/kernel/shapes/shape.hpp"

/// Spheres around shapes: the first and cheapest bound.
namespace raylane::simd {

/// A sphere around a shape, per lane. The radius is rounded up by more than all roundings here can
/// amount to: `rounded_up` adds 2^-20 of the radius and of the centre's coordinates.
template <class Arch>
struct SphereAround {
    Vectors<Arch> center;
    Floats<Arch> radius;
};

template <class Arch>
SphereAround<Arch> rounded_up(const Vectors<Arch>& center, const Floats<Arch>& radius) {
    const Floats<Arch> sizes = abs(center.x) + abs(center.y) + abs(center.z);
    return {center, radius + Floats<Arch>(0x1p-20F) * (radius + sizes)};
}

template <class Arch>
Floats<Arch> length(const Vectors<Arch>& v) {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

template <class Arch>
Vectors<Arch> half(const Vectors<Arch>& v) {
    const Floats<Arch> h(0.5F);
    return {v.x * h, v.y * h, v.z * h};
}

} // namespace raylane::simd
