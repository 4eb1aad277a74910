#pragma once

#include "core/numbers/infinity.hpp"
#include "core/solids/solids.hpp"

#include <algorithm>
#include <cstddef>

/// Computes bounds of solids.
namespace raylane::core {

inline Bounds everywhere() {
    return {Vec3f(-infinity<float>), Vec3f(infinity<float>)};
}

inline Bounds common(const Bounds& a, const Bounds& b) {
    Bounds both;
    for (int axis = 0; axis < 3; ++axis) {
        both.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
        both.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
    }
    return both;
}

inline bool is_empty(const Bounds& bounds) {
    return !(bounds.lower.x <= bounds.upper.x && bounds.lower.y <= bounds.upper.y &&
             bounds.lower.z <= bounds.upper.z);
}

inline bool contains(const Bounds& outer, const Bounds& inner) {
    return outer.contains(inner.lower) && outer.contains(inner.upper);
}

/// Number of times that a box is halved along each axis.
inline constexpr std::size_t max_halvings = 3;

/// Bounds of all points of a box at which a predicate may hold, found by halving the box. Calls
/// may_be(position of a cell, remaining halvings) for a cell after the cell that contains it.
template <class MayBe>
class Hull {
  public:
    Hull(const Bounds& box, const MayBe& may_be) : may_be_(may_be) { add(box, max_halvings); }
    const Bounds& bounds() const { return hull_; }

  private:
    void add(const Bounds& cell, std::size_t halvings) {
        if (!is_empty(hull_) && contains(hull_, cell)) return;
        if (!may_be_(somewhere_in(cell), halvings)) return;
        if (halvings == 0) {
            hull_.include(cell);
            return;
        }
        const Vec3f middle = 0.5F * cell.lower + 0.5F * cell.upper;
        for (int octant = 0; octant < 8; ++octant) {
            Bounds part = cell;
            for (int axis = 0; axis < 3; ++axis)
                ((octant >> axis & 1) != 0 ? part.lower : part.upper)[axis] = middle[axis];
            add(part, halvings - 1);
        }
    }

    const MayBe& may_be_;
    Bounds hull_;
};

/// Repeats this while the bounds shrink.
template <class MayBe>
Bounds hull_in(Bounds box, const MayBe& may_be) {
    for (int turn = 0; turn < 4 && !is_empty(box); ++turn) {
        const double before = box.half_area();
        box = Hull<MayBe>(box, may_be).bounds();
        if (!(box.half_area() < 0.75 * before)) break;
    }
    return box;
}

} // namespace raylane::core
