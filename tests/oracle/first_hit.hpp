#pragma once

#include "tests/shapes/shapes.hpp"

#include <optional>

/// The truth about a ray and a shape of given floats or doubles. It is decided in numbers that are
/// never rounded (rationals, and roots of quadratics over them), so that a tie is a tie, which
/// digits alone cannot tell. Each shape's file in tests/shapes/ has its crossings and normals.
namespace raylane::oracle {

/// Returns the first crossing with t > 0. At one t, entering comes before leaving.
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
