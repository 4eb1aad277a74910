#pragma once

#include "core/numbers/elementary.hpp"
#include "core/scene/material.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace raylane::core {

/// Returns whether a checker's cells hold their upper edge along an axis, not the lower one.
inline bool holds_upper_edge(const Pattern& pattern, int axis) {
    return (pattern.axes >> (axis + 3) & 1) != 0;
}

namespace detail {

/// Adding and subtracting this rounds values below 2^23 to multiples of 2^-28, in float values
/// below 2^8 to multiples of 2^-14.
template <class Real>
inline constexpr Real to_round(std::is_same_v<Real, float> ? 0x1.8p9 : 0x1.8p24);

/// Returns 0 in [0, 1), 1 in [1, 2), 0 in [2, 3), ... Symmetric paths often meet the exact edges of
/// cells, where rounding would choose a side. Values that are so close to an edge belong to the
/// cell that begins there. The pixels of an image therefore do not depend on last bits, and a
/// cube's face along the cells has one colour.
template <class Real>
int parity(Real value) {
    constexpr Real c = to_round<Real>;
    const Real cell = std::floor((value + c) - c);
    return cell == Real(2) * std::floor(cell / Real(2)) ? 0 : 1;
}

} // namespace detail

/// Returns the pattern's colour at a point in its coordinates. `on_shape`: used by some formulas.
template <class Real>
Vec3<Real> color_at(const Pattern& pattern, const Vec3<Real>& point,
                    const ShapeCoordinates& on_shape = {}) {
    const Vec3<Real> first = convert<Real>(pattern.colors[0]),
                     second = convert<Real>(pattern.colors[1]);
    switch (pattern.kind) {
    case PatternKind::solid:
    case PatternKind::image: // see color_on()
    case PatternKind::cutaway:
        break;
    case PatternKind::checker: {
        int sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            if ((pattern.axes >> axis & 1) != 0)
                sum += holds_upper_edge(pattern, axis)
                           ? 1 - detail::parity(-point[axis] / Real(pattern.size))
                           : detail::parity(point[axis] / Real(pattern.size));
        return sum % 2 == 0 ? first : second;
    }
    case PatternKind::stripes: {
        const Vec3d direction = normalized(convert<double>(pattern.direction));
        const auto distance = static_cast<Real>(dot(convert<double>(point), direction));
        return detail::parity(distance / Real(pattern.size)) == 0 ? first : second;
    }
    case PatternKind::gradient: {
        // In double, so that no square of a coordinate is infinite.
        const Vec3d run = convert<double>(pattern.to) - convert<double>(pattern.from);
        const Vec3d offset = convert<double>(point) - convert<double>(pattern.from);
        const auto s =
            static_cast<Real>(std::clamp(dot(offset, run) / squared_length(run), 0.0, 1.0));
        return mul_add(s, Vec3<Real>(second - first), first);
    }
    case PatternKind::formula:
        return convert<Real>(color_of(pattern.formula.program(), convert<double>(point), on_shape));
    }
    return first;
}

} // namespace raylane::core
