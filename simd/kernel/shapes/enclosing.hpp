#pragma once

#include "simd/kernel/shapes/shape.hpp"

/// Bounding spheres of shapes: the first and cheapest bound.
namespace raylane::simd {

/// A bounding sphere of a shape, per lane. `rounded_up` enlarges the radius by 2^-20 of the radius
/// and of the centre's coordinates, which exceeds the sum of all roundings here.
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
