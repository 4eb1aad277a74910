#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/shape_table.hpp"

#include <cmath>
#include <limits>

namespace raylane::core {

/// A ray's crossing with a shape.
template <class Real>
struct Hit {
    Real t = std::numeric_limits<Real>::infinity();
    double error = 0.0;    ///< bound on the error of t
    bool at_start = false; ///< a contact of the start, t = 0
    ShapeId shape = no_shape;
    Face face = body;
    bool entering = false;
    Kind kind{};
    Place place{};
    bool joins = false;    ///< in a sorted list: at the same t as the hit before
    bool reversed = false; ///< its shape is a reversed part of a solid, in which the outside counts

    Hit() = default;
    Hit(const Crossing<Real>& crossing, ShapeId shape_, Kind kind_, Place place_, bool reversed_)
        : t(crossing.t), error(crossing.error), shape(shape_), face(crossing.face),
          entering(crossing.entering), kind(kind_), place(place_), reversed(reversed_) {}
    template <class Other>
    explicit Hit(const Hit<Other>& other)
        : t(Real(other.t)), error(other.error), at_start(other.at_start), shape(other.shape),
          face(other.face), entering(other.entering), kind(other.kind), place(other.place),
          joins(other.joins), reversed(other.reversed) {}

    bool any() const { return shape != no_shape; }
    /// Returns true if the ray goes to the inside of the shape, or of the solid for a reversed
    /// part.
    bool enters() const { return entering != reversed; }

    /// Orders two hits at the same t: hits at the start, then entering hits, then the lower shape
    /// id.
    bool precedes(const Hit& other) const {
        if (at_start != other.at_start) return at_start;
        if (enters() != other.enters()) return enters();
        return shape < other.shape;
    }
    /// Returns true if t alone proves that this hit is nearer.
    bool is_surely_before(const Hit& other) const {
        return static_cast<double>(other.t) - static_cast<double>(t) >
               (error + other.error) * (1.0 + 0x1p-50);
    }
};

} // namespace raylane::core
