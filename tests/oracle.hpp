#pragma once

#include "tests/shapes/shapes.hpp"

#include <optional>

/// Truth about a ray and a shape, for the floats and doubles given: decided in numbers that are
/// never rounded (rationals, and roots of quadratics over them), so that a tie is a tie. Digits
/// alone cannot tell one. What a shape's crossings and normals are is in its file in tests/shapes/.
namespace raylane::oracle {

/// The first crossing with t > 0, what is entered before what is left.
template <class Shape, class Real>
std::optional<Hit> first_hit(const Shape& shape, const core::Ray<Real>& ray) {
    std::optional<Hit> first;
    for (const Hit& hit : crossings(shape, ray)) {
        if (!(hit.t > 0)) continue;
        const int order = first ? compare(hit, *first) : -1;
        if (order < 0 || (order == 0 && hit.entering && !first->entering)) first = hit;
    }
    return first;
}

} // namespace raylane::oracle
