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
///
/// The offset from the centre errs by 4 u |f| and 8 u |t| |direction| by component, and with t.
template <class Arch>
struct SphereFinisher {
    SphereLanes<Arch> sphere;

    template <class Reader>
    explicit SphereFinisher(Reader reader) : sphere(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] Finished<Arch> finish(const Rays<Arch>& rays,
                                                 const Starts<Arch>& starts) const {
        const F radius = sphere.radius;
        const Vectors<Arch> from_center = rays.origin - sphere.center;
        const F shift = negated(dot(from_center, rays.direction));
        const Vectors<Arch> foot = mul_add<Arch>(shift, rays.direction, from_center);
        const F discriminant = radius * radius - squared_length(foot);
        const F H = abs(shift) + (radius + radius);
        const F discriminant_error = H * (F(0x1p-49) * radius + F(0x1p-90) * H);
        const F root = sqrt(discriminant);

        const F inverse = F(1.0) / (radius * root);
        const F crossing_error = F(0x1p-45) * H + discriminant_error * (inverse * radius);
        const F entry = shift - root;
        const Mask<Arch> entering = (entry > zero<Arch>()) & ~starts.on_surface;
        const F from_foot = select(starts.on_surface, shift, select(entering, negated(root), root));
        const F t = shift + from_foot;
        const F error = select(starts.on_surface, F(0x1p-49) * H + F(0x1p-46) * t, crossing_error);
        const Mask<Arch> ahead = (starts.on_surface & starts.inward &
                                  (squared_length(foot) < F(2.0) * (radius * radius))) |
                                 (~starts.on_surface & (discriminant > discriminant_error) &
                                  (abs(entry) > crossing_error));
        const F inverse_radius = inverse * root;
        Finished<Arch> result = {
            ahead & is_result<Arch>(t, error) & (error < F(0x1p-14) * radius),
            t,
            error,
            zero<Arch>(),
            entering,
            scaled<Arch>(inverse_radius, mul_add<Arch>(from_foot, rays.direction, foot))};
        if constexpr (wanted == Wanted::all) {
            const F along = error + F(0x1p-48) * H;
            const auto off = [&](const F& from, const F& way) {
                return F(0x1p-50) * abs(from) + along * abs(way);
            };
            result.normal_error = error_of_unit<Arch>(result.normal,
                                                      {off(from_center.x, rays.direction.x),
                                                       off(from_center.y, rays.direction.y),
                                                       off(from_center.z, rays.direction.z)},
                                                      inverse_radius);
            const Mask<Arch> uncertain = ~result.certain & ~starts.on_surface;
            if (any<Arch>(uncertain))
                result.misses =
                    uncertain & (passes(shift, foot) | ((discriminant > discriminant_error) &
                                                        (shift + root < negated(crossing_error))));
        }
        return result;
    }

  private:
    using F = Floats<Arch>;

    /// Whether the line surely does not come near enough: as above, with |foot| in place of the
    /// radius, which is less.
    Mask<Arch> passes(const F& shift, const Vectors<Arch>& foot) const {
        const F size = sum_of_sizes(foot), H = abs(shift) + (size + size);
        const F error = H * (F(0x1p-49) * size + F(0x1p-90) * H);
        return squared_length(foot) - sphere.radius * sphere.radius > error;
    }
};

} // namespace raylane::simd
