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
inline Vector opposite(const Vector& v) {
    return Exact(-1) * v;
}

/// Order of the size of a component of the unit vector and this: -1 if it is less.
inline int compare_size(const Normal& n, int axis, const Exact& size) {
    const Exact square = size * size;
    return sign_at(n.t, n.v0[axis] * n.v0[axis] - square * inner(n.v0, n.v0),
                   Exact(2) * (n.v0[axis] * n.v1[axis] - square * inner(n.v0, n.v1)),
                   n.v1[axis] * n.v1[axis] - square * inner(n.v1, n.v1));
}

/// The unit vector's components, each the nearest float, ties to even.
inline core::Vec3f rounded(const Normal& n) {
    core::Vec3<Number> v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = n.sign(axis) == 0 ? Number(0) : abs(value_at(n.t, n.v0[axis], n.v1[axis]));
    const Number length = sqrt(Number(v.x * v.x + v.y * v.y + v.z * v.z));
    core::Vec3f result(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
        const int sign = n.sign(axis);
        if (sign == 0) continue;
        result[axis] =
            static_cast<float>(sign) * nearest_float(Number(v[axis] / length), [&](double middle) {
                return compare_size(n, axis, Exact(middle));
            });
    }
    return result;
}

} // namespace raylane::oracle
