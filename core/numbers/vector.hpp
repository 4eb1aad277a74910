#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace glm {

/// GLM's own negation, from 1.0.2 on, is 0 - v: it gives zeros of the other sign and requires
/// numbers that can be made of ints. The compiler prefers this overload, as it is more specialised.
template <class Real>
constexpr vec<3, Real, defaultp> operator-(const vec<3, Real, defaultp>& v) {
    return {-v.x, -v.y, -v.z};
}

} // namespace glm

/// Three-component vectors. GLM holds the components. The products are defined here, because
/// raylane guarantees the order of the operations and every fused multiply-add in them.
///
/// GLM's x/r/s unions need trivial types, but the oracle's numbers are not trivial: the build
/// defines GLM_FORCE_XYZW_ONLY for every target.
namespace raylane::core {

template <class Real>
using Vec3 = glm::vec<3, Real, glm::defaultp>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

/// a * b + c, rounded once for the built-in types (IEEE 754 fusedMultiplyAdd).
inline float mul_add(float a, float b, float c) {
    return std::fma(a, b, c);
}
inline double mul_add(double a, double b, double c) {
    return std::fma(a, b, c);
}
template <class Real>
Real mul_add(const Real& a, const Real& b, const Real& c) {
    return a * b + c;
}

/// s * a + b, component by component.
template <class Real>
Vec3<Real> mul_add(const Real& s, const Vec3<Real>& a, const Vec3<Real>& b) {
    return {mul_add(s, a.x, b.x), mul_add(s, a.y, b.y), mul_add(s, a.z, b.z)};
}

template <class Real>
Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
    return mul_add(a.x, b.x, mul_add(a.y, b.y, Real(a.z * b.z)));
}

/// The products are rounded before they are subtracted, so that cross(a, b) equals -cross(b, a) to
/// the bit: two triangles that share an edge then agree on which side of it a ray passes.
template <class Real>
Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
    return {Real(Real(a.y * b.z) - Real(a.z * b.y)), Real(Real(a.z * b.x) - Real(a.x * b.z)),
            Real(Real(a.x * b.y) - Real(a.y * b.x))};
}

/// Returns the largest magnitude of a component.
template <class Real>
Real largest_component(const Vec3<Real>& a) {
    using std::abs;
    return std::max({abs(a.x), abs(a.y), abs(a.z)});
}

template <class Real>
Real squared_length(const Vec3<Real>& a) {
    return dot(a, a);
}

template <class Real>
Real length(const Vec3<Real>& a) {
    using std::sqrt;
    return sqrt(squared_length(a));
}

template <class Real>
Vec3<Real> normalized(const Vec3<Real>& a) {
    return a / length(a);
}

/// Returns the mirror image of `incident` (pointing at the surface) in the plane across the unit
/// `normal`.
template <class Real>
Vec3<Real> reflected(const Vec3<Real>& incident, const Vec3<Real>& normal) {
    return mul_add(Real(Real(-2) * dot(incident, normal)), normal, incident);
}

/// Converts a vector to another real type.
template <class To, class From>
Vec3<To> convert(const Vec3<From>& v) {
    return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}

} // namespace raylane::core
