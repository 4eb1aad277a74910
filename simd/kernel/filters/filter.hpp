#pragma once

#include "simd/kernel/solvers/shapes.hpp"

/// Filters: float arithmetic that cannot be wrong, because it does not say where a ray crosses a
/// shape, but between which bounds. What survives them is solved in double.
///
/// Each filter stands for one kind of shape, is loaded like its solver (solvers/shapes.hpp), and
/// has
///   Bounds<Arch> bounds(const FilterRays<Arch>&) const
/// The bounds hold whether or not mul_add is fused, and for every ray whose floats are within the
/// stated errors.
namespace raylane::simd {

/// Rays that were rounded to float. The ray meant has a direction of length 1 +- 2^-48 and is
/// within half an ulp of this direction in each component, and within `slack`, a length, of this
/// origin.
template <class Arch>
struct FilterRays {
    Vectors<Arch> origin, direction;
    Floats<Arch> slack;
};

/// What is certain of a ray's crossings with one shape, of those with t > 0, per lane.
template <class Arch>
struct Bounds {
    Mask<Arch> possible; ///< false: there is none
    Floats<Arch> lower;  ///< where possible: none is before this; >= 0
    Mask<Arch> certain;  ///< there is one
    Floats<Arch> upper;  ///< where certain: the first is not behind this
};

/// Half an ulp of 1: what one operation is off by, relative to its result.
inline constexpr float half_ulp = 0x1p-24F;

/// a * b + c, fused where the processor does it in one instruction.
template <class Arch>
Floats<Arch> fast_mul_add(const Floats<Arch>& a, const Floats<Arch>& b, const Floats<Arch>& c) {
    if constexpr (Lanes<Arch>::has_mul_add)
        return Lanes<Arch>::mul_add(a, b, c);
    else
        return a * b + c;
}

template <class Arch>
Vectors<Arch> fast_mul_add(const Floats<Arch>& s, const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return {fast_mul_add<Arch>(s, a.x, b.x), fast_mul_add<Arch>(s, a.y, b.y),
            fast_mul_add<Arch>(s, a.z, b.z)};
}

template <class Arch>
Floats<Arch> fast_dot(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return fast_mul_add<Arch>(a.x, b.x, fast_mul_add<Arch>(a.y, b.y, a.z * b.z));
}

/// |a| . |b|, which bounds the rounding errors of a . b.
template <class Arch>
Floats<Arch> absolute_dot(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    return xsimd::abs(a.x * b.x) + xsimd::abs(a.y * b.y) + xsimd::abs(a.z * b.z);
}

} // namespace raylane::simd
