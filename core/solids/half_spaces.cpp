#include "core/solids/half_spaces.hpp"

#include "core/numbers/dyadic.hpp"
#include "core/numbers/infinity.hpp"
#include "core/solids/hull.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

/// Claim: p_k < u for all points p of several half-spaces.
///
/// Symbols: half-space i holds where f_i(p) <= 0. The form of a plane is l_i(p) = n . (p - point).
/// Weights w, v and tau are at least 0.
///
/// The product of two planes' forms is l_i(p) l_j(p) >= 0. So the sum
/// q(p) = sum w_i f_i(p) - v l_i(p) l_j(p) is at most 0. If
///   tau q(p) + (u - p_k) > 0 for every p,
/// that is, where the symmetric matrix of this form is positive definite, u - p_k > 0 follows.
///
/// Doubles find q, tau and u; Sylvester's criterion in exact arithmetic decides. If q is
/// d . A d - s about its centre c, the least u is c_k + h for h = sqrt(s (A^-1)_kk), by
/// tau = (A^-1)_kk / (2 h).
namespace raylane::core {

namespace {

using Exactly = Vec3<Dyadic>;

/// p . rows p + 2 linear . p + one.
struct Form { // NOLINT: clang-tidy 14 invents the name
    Exactly rows[3];
    Exactly linear;
    Dyadic one;
};
Form operator+(const Form& a, const Form& b) {
    Form sum{{}, a.linear + b.linear, a.one + b.one};
    for (int i = 0; i < 3; ++i)
        sum.rows[i] = a.rows[i] + b.rows[i];
    return sum;
}
Form operator*(const Dyadic& factor, Form form) {
    for (Exactly& row : form.rows)
        row = factor * row;
    form.linear = factor * form.linear;
    form.one = factor * form.one;
    return form;
}

Exactly times(const Exactly (&rows)[3], const Exactly& v) {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

/// Returns the same form about another origin.
Form about(const Vec3d& origin, Form form) {
    const Exactly at = convert<Dyadic>(origin), before = form.linear;
    form.linear = before + times(form.rows, at);
    form.one = form.one + dot(at, Exactly(form.linear + before));
    return form;
}

/// Returns true if the 4 x 4 matrix is positive definite, by Sylvester's criterion.
bool is_positive(const Form& form) {
    const auto& [a, b, c] = form.rows;
    if (a.x.sign() <= 0 || (a.x * b.y - a.y * a.y).sign() <= 0) return false;
    const Exactly adjugate[3] = {cross(b, c), cross(c, a), cross(a, b)};
    const Dyadic determinant = dot(a, adjugate[0]);
    return determinant.sign() > 0 &&
           (form.one * determinant - dot(form.linear, times(adjugate, form.linear))).sign() > 0;
}

double nearly(const Dyadic& a) {
    return a.sign() == 0 ? 0.0 : a.approximately().to_double();
}
Vec3d nearly(const Exactly& v) {
    return {nearly(v.x), nearly(v.y), nearly(v.z)};
}

/// Returns the power of two that brings the largest component to [1, 2).
Dyadic to_one(std::initializer_list<double> components) {
    double largest = 0.0;
    for (const double component : components)
        largest = std::max(largest, std::abs(component));
    return Dyadic(std::ldexp(1.0, largest > 0.0 ? -std::ilogb(largest) : 0));
}

struct LinearForm {
    Exactly normal;
    Dyadic offset; ///< normal . p + offset
};

LinearForm linear_form_of(const PlaneOf<double>& plane, bool reversed) {
    const Vec3d& n = plane.normal;
    LinearForm result{to_one({n.x, n.y, n.z}) * convert<Dyadic>(reversed ? -n : n), {}};
    result.offset = -dot(result.normal, convert<Dyadic>(plane.point));
    return result;
}

Form form_of(const QuadricOf<double>& q, bool reversed) {
    Form form{{{q.xx, q.xy, q.xz}, {q.xy, q.yy, q.yz}, {q.xz, q.yz, q.zz}}, {q.x, q.y, q.z}, q.one};
    const Dyadic factor = to_one({q.xx, q.yy, q.zz, q.xy, q.xz, q.yz});
    return about(-q.center, (reversed ? -factor : factor) * form);
}

/// Returns -a(p) b(p).
Form less_product(const LinearForm& a, const LinearForm& b) {
    const Dyadic half(-0.5);
    Form form;
    for (int i = 0; i < 3; ++i)
        form.rows[i] = half * (a.normal[i] * b.normal + b.normal[i] * a.normal);
    form.linear = half * (a.offset * b.normal + b.offset * a.normal);
    form.one = -(a.offset * b.offset);
    return form;
}

/// Returns false for most forms that are not an ellipsoid's, so that cylinders and cones need no
/// exact arithmetic.
bool may_be_definite(const QuadricOf<double>& q) {
    const Vec3d a(q.xx, q.xy, q.xz), b(q.xy, q.yy, q.yz), c(q.xz, q.yz, q.zz);
    const double mean = (q.xx + q.yy + q.zz) / 3.0;
    return core::dot(a, core::cross(b, c)) / mean / mean / mean > 1e-12;
}

/// Bounds of the points at which all added forms are at most 0.
class Extent {
  public:
    Bounds bounds = everywhere();

    void add(const Form& form) {
        const Vec3d a = nearly(form.rows[0]), b = nearly(form.rows[1]), c = nearly(form.rows[2]);
        const Vec3d adjugate[3] = {core::cross(b, c), core::cross(c, a), core::cross(a, b)};
        const double determinant = core::dot(a, adjugate[0]);
        if (!(a.x > 0.0 && adjugate[2].z > 0.0 && determinant > 0.0)) return;
        const Vec3d linear = nearly(form.linear) / -determinant;
        Vec3d center;
        for (int axis = 0; axis < 3; ++axis)
            center[axis] = core::dot(adjugate[axis], linear);
        const auto is_finite = [](const Vec3d& v) {
            return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
        };
        if (!is_finite(center)) return;
        const Form around = about(center, form);
        const double size = -nearly(around.one);
        if (!(size > 0.0)) return;
        for (int axis = 0; axis < 3; ++axis) {
            const double inverse = adjugate[axis][axis] / determinant;
            const double reach = std::sqrt(size * inverse) * (1.0 + 0x1p-16);
            const double tau = inverse / (2.0 * reach);
            if (!std::isfinite(reach) || !(tau > 0.0)) continue;
            const Form weighed = Dyadic(tau) * around;
            for (const bool up : {false, true}) {
                float& end = (up ? bounds.upper : bounds.lower)[axis];
                const auto further = static_cast<float>(center[axis] + (up ? reach : -reach));
                const float limit = std::nextafter(further, (up ? 1.0F : -1.0F) * infinity<float>);
                if (!std::isfinite(limit) || (up ? limit >= end : limit <= end)) continue;
                Form distance = weighed; // to the limit
                distance.linear[axis] = distance.linear[axis] + Dyadic(up ? -0.5 : 0.5);
                const Dyadic to_limit = Dyadic(limit) - Dyadic(center[axis]);
                distance.one = distance.one + (up ? to_limit : -to_limit);
                if (is_positive(distance)) end = limit;
            }
        }
    }
};

} // namespace

QuadricOf<double> within(QuadricOf<double> quadric, const Bounds& bounds) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto lower = static_cast<double>(bounds.lower[axis]) - quadric.center[axis];
        const auto upper = static_cast<double>(bounds.upper[axis]) - quadric.center[axis];
        const double beside = 0x1p-20 * (upper - lower) + 0x1p-20 * std::abs(lower) +
                              0x1p-20 * std::abs(upper) + 0x1p-100;
        quadric.lower[axis] = static_cast<double>(static_cast<float>(lower - beside));
        quadric.upper[axis] = static_cast<double>(static_cast<float>(upper + beside));
    }
    return quadric;
}

Bounds bounds_of_common(std::span<const HalfSpace> half_spaces) {
    // More forms would cost more than bounds are worth.
    constexpr std::size_t max_quadrics = 4, max_planes = 12;
    const bool is_single = half_spaces.size() == 1;
    std::vector<Form> quadrics;
    std::vector<LinearForm> planes;
    for (const HalfSpace& half_space : half_spaces) {
        const auto* quadric = std::get_if<QuadricOf<double>>(&half_space.shape);
        const auto* plane = std::get_if<PlaneOf<double>>(&half_space.shape);
        if (is_single && (quadric == nullptr || !may_be_definite(*quadric))) return everywhere();
        if (quadric != nullptr && quadrics.size() < max_quadrics)
            quadrics.push_back(form_of(*quadric, half_space.reversed));
        if (plane != nullptr && planes.size() < max_planes)
            planes.push_back(linear_form_of(*plane, half_space.reversed));
    }
    if (quadrics.empty()) return everywhere();
    std::vector<Form> slabs;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j)
            if (dot(planes[i].normal, planes[j].normal).sign() < 0)
                slabs.push_back(less_product(planes[i], planes[j]));
    Extent extent;
    for (std::size_t i = 0; i < quadrics.size(); ++i) {
        extent.add(quadrics[i]);
        for (std::size_t j = 0; j < i; ++j)
            extent.add(quadrics[i] + quadrics[j]);
        Form product = quadrics[i];
        for (const Form& slab : slabs) {
            product = product + slab;
            for (const double weight : {0x1p-6, 0x1p-3, 0.5, 8.0, 64.0})
                extent.add(Dyadic(weight) * quadrics[i] + slab);
        }
        if (slabs.size() > 1) extent.add(product);
    }
    return extent.bounds;
}

} // namespace raylane::core
