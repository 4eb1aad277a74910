#include "tests/oracle/normal.hpp"

namespace raylane::oracle {

Vector opposite(const Vector& v) {
    return Exact(-1) * v;
}

int compare_size(const Normal& n, int axis, const Exact& size) {
    const Exact square = size * size;
    return sign_at(n.t, n.v0[axis] * n.v0[axis] - square * inner(n.v0, n.v0),
                   Exact(2) * (n.v0[axis] * n.v1[axis] - square * inner(n.v0, n.v1)),
                   n.v1[axis] * n.v1[axis] - square * inner(n.v1, n.v1));
}

core::Vec3f rounded(const Normal& n) {
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
