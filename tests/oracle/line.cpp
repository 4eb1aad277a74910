#include "tests/oracle/line.hpp"

namespace raylane::oracle {

int compare(const Hit& a, const Hit& b) {
    return compare(a.root, a.t, b.root, b.t);
}

bool is_within(const Line& line, const Root& t, const Vector& offset, const Exact& radius) {
    const Vector f = line.f - offset;
    return sign_at(t, inner(f, f) - radius * radius, Exact(2) * inner(f, line.d),
                   inner(line.d, line.d)) <= 0;
}

std::optional<Hit> plane_crossing(const Line& line, const Vector& normal, const Exact& height,
                                  Face face) {
    const Exact approach = inner(normal, line.d);
    if (approach.sign() == 0) return std::nullopt;
    return Hit(Root::quotient(height - inner(normal, line.f), approach), approach.sign() < 0, face);
}

std::vector<Hit> first_and_last(const std::vector<Hit>& on_faces) {
    std::optional<Hit> first, last;
    const auto choose = [](std::optional<Hit>& chosen, const Hit& hit, int wanted) {
        const int order = chosen ? compare(hit, *chosen) : wanted;
        if (order == wanted || (order == 0 && hit.face < chosen->face)) chosen = hit;
    };
    for (const Hit& hit : on_faces)
        hit.entering ? choose(first, hit, -1) : choose(last, hit, 1);
    if (!first || !last) return {};
    return {*first, *last};
}

Vector opposite(const Vector& v) {
    return Exact(-1) * v;
}

int compare_size(const Normal& n, int axis, const Exact& size) {
    const Exact square = size * size;
    return sign_at(n.t, n.v0[axis] * n.v0[axis] - square * inner(n.v0, n.v0),
                   Exact(2) * (n.v0[axis] * n.v1[axis] - square * inner(n.v0, n.v1)),
                   n.v1[axis] * n.v1[axis] - square * inner(n.v1, n.v1));
}

namespace {

template <class Real>
core::Vec3<Real> nearest(const Normal& n) {
    core::Vec3<Number> v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = n.sign(axis) == 0 ? Number(0) : abs(value_at(n.t, n.v0[axis], n.v1[axis]));
    const Number length = sqrt(Number(v.x * v.x + v.y * v.y + v.z * v.z));
    core::Vec3<Real> result(Real(0));
    for (int axis = 0; axis < 3; ++axis) {
        const int sign = n.sign(axis);
        if (sign == 0) continue;
        const auto compare = [&](const Exact& sum) {
            return compare_size(n, axis, Exact(0.5) * sum);
        };
        result[axis] =
            static_cast<Real>(sign) * nearest_number<Real>(Number(v[axis] / length), compare);
    }
    return result;
}

} // namespace

core::Vec3f rounded(const Normal& n) {
    return nearest<float>(n);
}

core::Vec3d rounded_to_double(const Normal& n) {
    return nearest<double>(n);
}

} // namespace raylane::oracle
