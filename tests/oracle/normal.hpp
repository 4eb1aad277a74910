#pragma once

#include "tests/oracle/line.hpp"

/// Exact normals. Each shape's file defines
///   Normal normal(shape, ray, hit)
/// which returns the normal towards the outside (the front) at a crossing. At an apex it returns
/// the axis towards the outside instead.
namespace raylane::oracle {

/// The vector v0 + t v1 at a root t, of any length.
struct Normal {
    Root t;
    Vector v0, v1;

    static Normal fixed(const Vector& v) { return {{{}, Exact(1), 0, {}}, v, {}}; }
    int sign(int axis) const { return sign_at(t, v0[axis], v1[axis]); }
    bool vanishes() const { return sign(0) == 0 && sign(1) == 0 && sign(2) == 0; }
};
Vector opposite(const Vector& v);

/// Compares the absolute value of a component of the unit vector with `size`: -1 if it is less.
int compare_size(const Normal& n, int axis, const Exact& size);

/// Returns the unit vector, each component rounded to the nearest float, ties to even.
core::Vec3f rounded(const Normal& n);

} // namespace raylane::oracle
