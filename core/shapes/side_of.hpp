#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/dyadic.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/side.hpp"

#include <algorithm>

/// Finds the side of a solid on which a point is. Each solid and each half-space has
///   std::array<Real, n> forms_at(shape, point)
/// polynomials that are all less than 0 inside. Outside, at least one is more than 0.
namespace raylane::core {

/// Returns the side as real arithmetic decides: in double with error bounds, and in exact numbers
/// if these leave a doubt.
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
