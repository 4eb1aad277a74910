#pragma once

#include "simd/kernel/finishers/finisher.hpp"
#include "simd/kernel/solvers/sphere.hpp"

namespace raylane::simd {

/// The solver's formula, with one division and, as directions are unit vectors, none by
/// |direction|^2.
///
/// The foot of the perpendicular from the centre, start + 0 direction, is off by `local.error`
/// across the ray. Along the ray it is off by 2^-46 |f|, f = origin - center: 2^-47 |f| as
/// |direction|^2 is not 1, and 5 u |f| for the dot product. With |foot| <= r and H = |shift| + 2 r
/// >= |f| + |foot|, the discriminant r^2 - |foot|^2 errs by
///   2 r (4.1 u |f| + u r) + (5 u |f|)^2   from across,
///   2^-91 |f|^2                           from along, where |foot|^2 is at its least,
///   6 u r^2                               from its own roundings,
/// so by less than H (16 u r + 2^-90 H). Its root errs by that, divided by it; and t further by
/// 2^-46 |f| and 2^-47 |root|, so by 2^-45 H. A start on the surface has t = 2 shift, which errs by
/// 10 u |f| and, as |direction|^2 is not 1, by 2^-47 of itself.
template <class Arch>
struct SphereFinisher {
    SphereLanes<Arch> sphere;

    template <class Reader>
    explicit SphereFinisher(Reader reader) : sphere(reader) {}

    [[gnu::always_inline]] Finished<Arch> finish(const Rays<Arch>& rays,
                                                 const Starts<Arch>& starts) const {
        using F = Floats<Arch>;
        const F radius = sphere.radius;
        const Vectors<Arch> from_center = rays.origin - sphere.center;
        const F shift = negated(dot(from_center, rays.direction));
        const Vectors<Arch> foot = mul_add<Arch>(shift, rays.direction, from_center);
        const F discriminant = radius * radius - squared_length(foot);
        const F H = xsimd::abs(shift) + (radius + radius);
        const F discriminant_error = H * (F(0x1p-49) * radius + F(0x1p-90) * H);
        const F root = xsimd::sqrt(discriminant);

        const F inverse = F(1.0) / (radius * root);
        const F crossing_error = F(0x1p-45) * H + discriminant_error * (inverse * radius);
        const F entry = shift - root;
        const Mask<Arch> entering = (entry > zero<Arch>()) & ~starts.on_surface;
        const F from_foot =
            xsimd::select(starts.on_surface, shift, xsimd::select(entering, negated(root), root));
        const F t = shift + from_foot;
        const F error =
            xsimd::select(starts.on_surface, F(0x1p-49) * H + F(0x1p-46) * t, crossing_error);
        const Mask<Arch> one_ahead = (starts.on_surface & starts.inward &
                                      (squared_length(foot) < F(2.0) * (radius * radius))) |
                                     (~starts.on_surface & (discriminant > discriminant_error) &
                                      (xsimd::abs(entry) > crossing_error));
        return {one_ahead & is_result<Arch>(t, error),
                t,
                error,
                zero<Arch>(),
                entering,
                scaled<Arch>(inverse * root, mul_add<Arch>(from_foot, rays.direction, foot))};
    }
};

} // namespace raylane::simd
