#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/dyadic.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/side.hpp"

#include <algorithm>

/// Finds the side of a solid that a point is on. Each solid and each half-space has
///   std::array<Real, n> forms_at(shape, point)
/// polynomials that are less than 0 inside of it, all of them, and of which one is more than 0
/// outside.
namespace raylane::core {

/// Decides as real arithmetic does: in double with error bounds, and in exact numbers where these
/// leave a doubt.
template <class Shape>
Side side_of(const Shape& solid, const Vec3d& point) {
    bool is_known = true;
    for (const Bounded<double>& form : forms_at(solid, convert<Bounded<double>>(point))) {
        if (form.value > form.error) return Side::outside;
        is_known = is_known && form.value < -form.error;
    }
    if (is_known) return Side::inside;
    int most = -1;
    for (const Dyadic& form : forms_at(solid, convert<Dyadic>(point)))
        most = std::max(most, form.sign());
    return static_cast<Side>(most);
}

} // namespace raylane::core
