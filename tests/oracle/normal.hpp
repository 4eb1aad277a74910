#pragma once

#include "tests/oracle/line.hpp"

/// Normals in exact numbers. Each shape's file has its own
///   Normal normal(shape, ray, hit)
/// the normal outside (in front) at one of its crossings; at an apex what stands in for it: the
/// axis, to the outside.
namespace raylane::oracle {

/// v0 + t v1 at a root: of any length.
struct Normal {
    Root t;
    Vector v0, v1;

    static Normal fixed(const Vector& v) { return {{{}, Exact(1), 0, {}}, v, {}}; }
    int sign(int axis) const { return sign_at(t, v0[axis], v1[axis]); }
    bool vanishes() const { return sign(0) == 0 && sign(1) == 0 && sign(2) == 0; }
};
Vector opposite(const Vector& v);

/// Order of the size of a component of the unit vector and this: -1 if it is less.
int compare_size(const Normal& n, int axis, const Exact& size);

/// The unit vector's components, each the nearest float, ties to even.
core::Vec3f rounded(const Normal& n);

} // namespace raylane::oracle
