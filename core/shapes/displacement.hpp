#pragma once

#include "core/shapes/precision.hpp"
#include "core/shapes/types.hpp"

#include <limits>
#include <type_traits>

namespace raylane::core {

/// Displacement: how far the surface that a method of floats (fast or robust) draws may be from the
/// one meant, in units of length across the line of sight, for rays that start no further than
/// `reach` from any point of the shape: where such a ray hits (misses), it does so with the shape
/// meant, once it is moved sideways by no more than this. (It includes what rounding the shape to
/// floats moves it by.) Infinite where there is no such bound, or
/// the error is no longer small beside the shape.
double displacement(const InDouble<Sphere>& sphere, Precision precision, double reach);
double displacement(const InDouble<Disc>& disc, Precision precision, double reach);
double displacement(const InDouble<Quadric>& quadric, Precision precision, double reach);

/// The others may be seen along an axis, an edge or without end, and there float has no bound.
template <class Shape>
double displacement(const Shape& shape, Precision precision, double reach) {
    if constexpr (std::is_same_v<NumberOf<Shape>, float>)
        return displacement(to_doubles(shape), precision, reach);
    else
        return std::numeric_limits<double>::infinity();
}

} // namespace raylane::core
