#pragma once

#include "simd/kernel/shapes/box.hpp"
#include "simd/kernel/shapes/cone.hpp"
#include "simd/kernel/shapes/cylinder.hpp"
#include "simd/kernel/shapes/disc.hpp"
#include "simd/kernel/shapes/ellipsoid.hpp"
#include "simd/kernel/shapes/plane.hpp"
#include "simd/kernel/shapes/quadric.hpp"
#include "simd/kernel/shapes/sphere.hpp"
#include "simd/kernel/shapes/triangle.hpp"

#include <type_traits>

namespace raylane::simd {

/// Calls visit.operator()<Shape>() with the shape type of `kind`.
template <class Visit>
void with_shape(core::Kind kind, const Visit& visit) {
    core::with_shape_type(
        kind, [&]<class Shape>(std::type_identity<Shape>) { visit.template operator()<Shape>(); });
}

/// Same with the kind's solver, and below with its filter or certified solver, in place of the
/// shape type.
template <class Arch, bool textbook = false, class Visit>
void with_solver(core::Kind kind, const Visit& visit) {
    with_shape(kind, [&]<class Shape>() {
        visit.template operator()<typename ShapeKernels<Shape>::template Solver<Arch, textbook>>();
    });
}
template <class Arch, class Visit>
void with_filter(core::Kind kind, const Visit& visit) {
    with_shape(kind, [&]<class Shape>() {
        visit.template operator()<typename ShapeKernels<Shape>::template Filter<Arch>>();
    });
}
template <class D, class Visit>
void with_certified_solver(core::Kind kind, const Visit& visit) {
    with_shape(kind, [&]<class Shape>() {
        visit.template operator()<typename ShapeKernels<Shape>::template CertifiedSolver<D>>();
    });
}

} // namespace raylane::simd
