#pragma once

#include "simd/kernel/solvers/box.hpp"
#include "simd/kernel/solvers/cone.hpp"
#include "simd/kernel/solvers/cylinder.hpp"
#include "simd/kernel/solvers/flat.hpp"
#include "simd/kernel/solvers/quadric.hpp"
#include "simd/kernel/solvers/sphere.hpp"
#include "simd/scene_view.hpp"

namespace raylane::simd {

/// Calls visit.operator()<Lanes of the kind>(). The order is core::Kind's. `textbook`: with the
/// textbooks' formulas where there are better ones.
template <class Arch, bool textbook = false, class Visit>
void with_lanes(KindNumber kind, const Visit& visit) {
    switch (kind) {
    case 0:
        return visit.template operator()<SphereLanes<Arch, textbook>>();
    case 1:
        return visit.template operator()<PlaneLanes<Arch>>();
    case 2:
        return visit.template operator()<DiscLanes<Arch>>();
    case 3:
        return visit.template operator()<TriangleLanes<Arch>>();
    case 4:
        return visit.template operator()<SmoothTriangleLanes<Arch>>();
    case 5:
        return visit.template operator()<BoxLanes<Arch>>();
    case 6:
        return visit.template operator()<CylinderLanes<Arch, false, textbook>>();
    case 7:
        return visit.template operator()<CylinderLanes<Arch, true, textbook>>();
    case 8:
        return visit.template operator()<ConeLanes<Arch, false, textbook>>();
    case 9:
        return visit.template operator()<ConeLanes<Arch, true, textbook>>();
    default:
        return visit.template operator()<QuadricLanes<Arch, textbook>>();
    }
}

} // namespace raylane::simd
