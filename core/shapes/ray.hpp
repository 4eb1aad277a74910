#pragma once

#include "core/numbers/vector.hpp"

#include <array>
#include <cstdint>

namespace raylane::core {

/// The points origin + t direction, t > 0. t is a length if the direction is a unit vector.
template <class Real>
struct Ray {
    Vec3<Real> origin;
    Vec3<Real> direction;
};

/// Part of a shape's surface. Quadratic surfaces and flat shapes have one (`body`), and solids may
/// have caps besides. A box has two per edge: 2 i through the corner, 2 i + 1 opposite, for edges i
/// = 0, 1, 2.
using Face = std::uint8_t;
inline constexpr Face body = 0;
inline constexpr Face base_cap = 1;
inline constexpr Face top_cap = 2;

/// Start of a ray, as one shape sees it. A ray that starts on the shape has t = 0 as a root. No
/// arithmetic has to find it again: the solvers leave it out instead of testing for it with an
/// epsilon.
struct Start {
    bool on_surface = false;
    Face face = body;    ///< the face that it starts on, if on_surface
    bool inward = false; ///< true if the ray goes to the inside (behind a flat surface)
};

/// Crossing of a line and a surface.
template <class Real>
struct Crossing {
    Real t;
    Face face;
    bool entering = false; ///< from the outside (front) to the inside (back)
    double error = 0.0;    ///< bound on the error of t; set only by solve() in double
};

/// The crossings of a ray with one shape, in the order of t. The caller has to test for t > 0, or
/// for t >= 0 after a start on the surface. At most two: all shapes are of second degree or convex.
template <class Real>
class Crossings {
  public:
    Crossings() = default;
    Crossings(const Crossing<Real>& only) { add(only); } // NOLINT: implicit
    Crossings(const Crossing<Real>& first, const Crossing<Real>& second) {
        add(first);
        add(second);
    }

    void add(const Crossing<Real>& crossing) { crossings_[count_++] = crossing; }
    const Crossing<Real>* begin() const { return crossings_.data(); }
    const Crossing<Real>* end() const { return crossings_.data() + count_; }

  private:
    std::array<Crossing<Real>, 2> crossings_;
    int count_ = 0;
};

/// Returns max(0, t): the far root of a ray that starts on the surface and goes inward. If the ray
/// is tangent, rounding may put the root behind the start; the ray then leaves where it starts.
template <class Real>
Real not_behind(const Real& t) {
    return static_cast<double>(t) > 0.0 ? t : Real(0.0);
}

/// The side of a solid on which a point is.
enum class Side : std::int8_t { inside = -1, surface = 0, outside = 1 };

} // namespace raylane::core
