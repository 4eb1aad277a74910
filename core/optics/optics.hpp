#pragma once

#include "core/numbers/elementary.hpp"
#include "core/numbers/vector.hpp"
#include "core/scene/material.hpp"

#include <algorithm>
#include <cmath>

/// Reflection and refraction at one surface. Cosines are of the angles between ray and normal, in
/// [0, 1].
namespace raylane::core {

/// Refraction of a ray at the surface between two indices of refraction.
template <class Real>
struct Refraction {
    bool total; ///< total internal reflection: nothing is transmitted
    Real cos_incident;
    Real cos_transmitted;   ///< 0 if total
    Vec3<Real> transmitted; ///< unit; not set if total
};

/// Applies Snell's law. `incident` and `normal` are unit vectors, and the normal is on the side
/// that the ray comes from. The sine comes from the component along the surface, not from 1 -
/// cos^2, which cancels.
template <class Real>
Refraction<Real> refract(const Vec3<Real>& incident, const Vec3<Real>& normal, Real n1, Real n2) {
    const Real cos_incident = std::clamp(-dot(incident, normal), Real(0), Real(1));
    const Vec3<Real> along = (n1 / n2) * mul_add(cos_incident, normal, incident);
    const Real sin_squared = squared_length(along);
    // Rounding must not cause total reflection into a denser medium.
    if (sin_squared > Real(1) && n1 > n2) return {true, cos_incident, Real(0), {}};
    const Real cos_transmitted = std::sqrt(std::max(Real(0), Real(1) - sin_squared));
    return {false, cos_incident, cos_transmitted, mul_add(-cos_transmitted, normal, along)};
}

/// Returns Schlick's approximation of the reflected fraction. It needs the cosine of the larger of
/// the two angles: the transmitted one when the ray leaves the denser side (Shirley, "Bug in my
/// Schlick code"). Source: Schlick, "An Inexpensive BRDF Model for Physically-based Rendering"
/// (1994).
template <class Real>
Real schlick(Real cos_incident, Real cos_transmitted, Real n1, Real n2) {
    const Real root = (n1 - n2) / (n1 + n2);
    const Real at_normal = root * root;
    const Real rest = Real(1) - (n1 <= n2 ? cos_incident : cos_transmitted);
    const Real rest_squared = rest * rest;
    return at_normal + (Real(1) - at_normal) * (rest_squared * rest_squared * rest);
}

/// Returns the reflected fraction by Fresnel's equations: the mean of both polarisations.
template <class Real>
Real dielectric(Real cos_incident, Real cos_transmitted, Real n1, Real n2) {
    const Real perpendicular =
        (n1 * cos_incident - n2 * cos_transmitted) / (n1 * cos_incident + n2 * cos_transmitted);
    const Real parallel =
        (n1 * cos_transmitted - n2 * cos_incident) / (n1 * cos_transmitted + n2 * cos_incident);
    return std::min(Real(1), (perpendicular * perpendicular + parallel * parallel) / Real(2));
}

/// Returns the reflected fraction R in [0, 1] of a material between two indices. The rest is 1 - R,
/// and R + (1 - R) is 1 to the bit.
template <class Real>
Real reflectance(const Material& material, const Refraction<Real>& refraction, Real n1, Real n2) {
    if (refraction.total) return Real(1);
    if (material.reflection == Reflection::constant) return Real(material.reflectivity);
    // Equal indices reflect nothing; Schlick's approximation would at grazing angles.
    if (n1 == n2) return Real(0);
    const auto fresnel =
        material.reflection == Reflection::schlick ? schlick<Real> : dielectric<Real>;
    return fresnel(refraction.cos_incident, refraction.cos_transmitted, n1, n2);
}

/// Returns the share of light, linear RGB, that a body transmits over a distance: Beer and
/// Lambert's law.
template <class Real>
Vec3<Real> let_through_medium(const Material& material, Real distance) {
    Vec3<Real> share(1);
    for (int channel = 0; channel < 3; ++channel)
        if (material.absorption[channel] > 0.0F)
            share[channel] = core::exp(-Real(material.absorption[channel]) * distance);
    return share;
}

/// Returns the mean of a share over the channels, for single numbers such as alpha.
template <class Real>
Real mean_of_channels(const Vec3<Real>& share) {
    return (share.x + share.y + share.z) / Real(3);
}

/// Returns the share of light that a surface lets through in a straight line, at the cosine `cos`
/// of its angle to the normal. The line is not refracted, so its angle counts as the one on the
/// rarer side. Total reflection therefore never blocks a light in a body that the light has to
/// enter first. Light passes a transparent surface unattenuated where the surface does not cover.
template <class Real>
Real let_straight_through(const Material& material, Real cos, Real n1, Real n2) {
    const Real rarer = std::min(n1, n2), denser = std::max(n1, n2);
    const Real sine = rarer / denser;
    const Real sin_squared = sine * sine * (Real(1) - cos * cos);
    const Refraction<Real> refraction{
        false, cos, std::sqrt(std::max(Real(0), Real(1) - sin_squared)), {}};
    const Real share =
        (Real(1) - reflectance(material, refraction, rarer, denser)) * Real(material.transmission);
    if (!material.is_transparent()) return share;
    return mul_add(Real(material.opacity), share, Real(1) - Real(material.opacity));
}

} // namespace raylane::core
