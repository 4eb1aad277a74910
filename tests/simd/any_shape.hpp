#pragma once

#include "tests/oracle.hpp"
#include "tests/placing.hpp"

#include <vector>

/// What tests ask of shapes of whichever kind.
namespace raylane::tests {

inline core::Kind kind_of(const AnyShape& any) {
    return std::visit([]<class Shape>(const Shape&) { return core::kind_of<Shape>; }, any);
}

inline std::vector<oracle::Hit> crossings(const AnyShape& any, const core::Ray<double>& ray) {
    return std::visit([&](const auto& shape) { return oracle::crossings(shape, ray); }, any);
}

} // namespace raylane::tests
