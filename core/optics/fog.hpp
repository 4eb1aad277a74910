#pragma once

#include "core/numbers/elementary.hpp"
#include "core/scene/surroundings.hpp"

#include <algorithm>

namespace raylane::core {

/// Returns the fraction of fog in [0, 1] on a segment of length `distance` whose end has the world
/// coordinate `z`.
template <class Real>
Real fog_fraction(const Fog& fog, Real distance, Real z) {
    const Real start = Real(fog.start), end = Real(fog.end);
    switch (fog.kind) {
    case FogKind::none:
        break;
    case FogKind::linear_z:
        return std::clamp((z - start) / (end - start), Real(0), Real(1));
    case FogKind::linear:
        return std::clamp((distance - start) / (end - start), Real(0), Real(1));
    case FogKind::exponential:
        return Real(0) - core::expm1(-Real(fog.density) * distance);
    }
    return Real(0);
}

/// Returns fog_fraction() for a ray that hits nothing: the limit for an infinite segment.
template <class Real>
Real fog_fraction_at_infinity(const Fog& fog, const Vec3<Real>& origin,
                              const Vec3<Real>& direction) {
    if (fog.kind == FogKind::none) return Real(0);
    if (fog.kind != FogKind::linear_z) return Real(1);
    if (direction.z == Real(0)) return fog_fraction(fog, Real(0), origin.z);
    return (direction.z > Real(0)) == (fog.end > fog.start) ? Real(1) : Real(0);
}

} // namespace raylane::core
