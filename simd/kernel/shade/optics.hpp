#pragma once

#include "simd/kernel/lanes/vectors.hpp"
#include "simd/units/shade_kernels.hpp"

namespace raylane::simd {

/// core::Refraction and the reflected fraction, per lane (core/optics/optics.hpp).
template <class Arch>
struct Refractions {
    using F = Floats<Arch>;
    using M = Mask<Arch>;

    M total;
    F cos_incident, cos_transmitted;
    Vectors<Arch> transmitted;

    Refractions(const Vectors<Arch>& incident, const Vectors<Arch>& normal, const F& n1,
                const F& n2)
        : total(false), cos_incident(0.0), cos_transmitted(0.0), transmitted(incident) {
        const F zero(0.0), one(1.0);
        cos_incident = min(max(negated(dot<Arch>(incident, normal)), zero), one);
        const Vectors<Arch> tangential = mul_add<Arch>(cos_incident, normal, incident);
        const F ratio = n1 / n2;
        const Vectors<Arch> along = {ratio * tangential.x, ratio * tangential.y,
                                     ratio * tangential.z};
        const F sin_squared = squared_length<Arch>(along);
        total = (sin_squared > one) & (n1 > n2);
        cos_transmitted = select(total, zero, sqrt(max(zero, one - sin_squared)));
        transmitted = mul_add<Arch>(negated(cos_transmitted), normal, along);
    }

    void replace(const M& where, const Refractions& by) {
        total = (where & by.total) | (~where & total);
        cos_incident = select(where, by.cos_incident, cos_incident);
        cos_transmitted = select(where, by.cos_transmitted, cos_transmitted);
        transmitted = select<Arch>(where, by.transmitted, transmitted);
    }

    F reflectance(const MaterialView& material, const F& n1, const F& n2) const {
        const F one(1.0);
        const F none = select(total, one, F(0.0));
        switch (material.reflection) {
        case core::Reflection::constant:
            return select(total, one, F(material.reflectivity));
        case core::Reflection::schlick:
            return select(total | (n1 == n2), none, schlick(n1, n2));
        case core::Reflection::dielectric:
            return select(total | (n1 == n2), none, dielectric(n1, n2));
        }
        __builtin_unreachable();
    }

  private:
    F schlick(const F& n1, const F& n2) const {
        const F one(1.0);
        const F root = (n1 - n2) / (n1 + n2);
        const F at_normal = root * root;
        const F rest = one - select(n1 <= n2, cos_incident, cos_transmitted);
        const F squared = rest * rest;
        return at_normal + (one - at_normal) * (squared * squared * rest);
    }

    F dielectric(const F& n1, const F& n2) const {
        const F perpendicular =
            (n1 * cos_incident - n2 * cos_transmitted) / (n1 * cos_incident + n2 * cos_transmitted);
        const F parallel =
            (n1 * cos_transmitted - n2 * cos_incident) / (n1 * cos_transmitted + n2 * cos_incident);
        return min(F(1.0), (perpendicular * perpendicular + parallel * parallel) * F(0.5));
    }
};

} // namespace raylane::simd
