#pragma once

#include "core/shapes/error_predicate.hpp"
#include "core/shapes/form.hpp"
#include "core/shapes/ray.hpp"

#include <optional>

/// Shared parts of flat shapes. A ray that starts on one does not meet it again; a ray in its plane
/// does not hit it.
namespace raylane::core {

/// Solves normal . (origin + t direction - point) = 0.
template <class Real>
std::optional<Crossing<Real>> cross_plane(const Vec3<Real>& to_point, const Vec3<Real>& normal,
                                          const Vec3<Real>& direction,
                                          ErrorPredicate<Real>& predicate) {
    const Real approach = dot(normal, direction);
    const int side = predicate.sign(approach);
    if (side == 0) return std::nullopt;
    return Crossing<Real>{dot(normal, to_point) / approach, body, side < 0};
}

} // namespace raylane::core
