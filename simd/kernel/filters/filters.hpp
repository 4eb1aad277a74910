#pragma once

#include "simd/kernel/filters/box.hpp"
#include "simd/kernel/filters/cone.hpp"
#include "simd/kernel/filters/cylinder.hpp"
#include "simd/kernel/filters/disc.hpp"
#include "simd/kernel/filters/plane.hpp"
#include "simd/kernel/filters/quadric.hpp"
#include "simd/kernel/filters/sphere.hpp"
#include "simd/kernel/filters/triangle.hpp"
#include "simd/scene_view.hpp"

namespace raylane::simd {

/// Calls visit.operator()<filter of the kind>(). The order is core::Kind's.
template <class Arch, class Visit>
void with_filter(KindNumber kind, const Visit& visit) {
    switch (kind) {
    case 0:
        return visit.template operator()<SphereFilter<Arch>>();
    case 1:
        return visit.template operator()<PlaneFilter<Arch>>();
    case 2:
        return visit.template operator()<DiscFilter<Arch>>();
    case 3:
    case 4:
        return visit.template operator()<TriangleFilter<Arch>>();
    case 5:
        return visit.template operator()<BoxFilter<Arch>>();
    case 6:
        return visit.template operator()<CylinderFilter<Arch, false>>();
    case 7:
        return visit.template operator()<CylinderFilter<Arch, true>>();
    case 8:
        return visit.template operator()<ConeFilter<Arch, false>>();
    case 9:
        return visit.template operator()<ConeFilter<Arch, true>>();
    default:
        return visit.template operator()<QuadricFilter<Arch>>();
    }
}

} // namespace raylane::simd
