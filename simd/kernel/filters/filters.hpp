#pragma once
#include "simd/kernel/filters/plane.hpp"
#include "simd/kernel/filters/sphere.hpp"
#include "simd/kernel/trace/spheres_around.hpp"
namespace raylane::simd {
template <class Arch, int kind>
struct AnyFilter {
    SphereAround<Arch> s;
    template <class Reader>
    explicit AnyFilter(Reader r) : s(sphere_around<Arch>(kind, r)) {}
    Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        const Vectors<Arch> f = rays.origin - s.center;
        const Floats<Arch> tau = negated(fast_dot(f, rays.direction));
        const Vectors<Arch> foot = fast_mul_add<Arch>(tau, rays.direction, f);
        const Floats<Arch> D = s.radius * s.radius * Floats<Arch>(1.0001F) - fast_dot(foot, foot);
        const Floats<Arch> h = xsimd::sqrt(D) * Floats<Arch>(1.0001F);
        return {(D >= zero<Arch>()) & (tau + h > zero<Arch>()), xsimd::max(zero<Arch>(), tau - h),
                none<Arch>(), tau};
    }
};
template <class Arch, class Visit>
void with_filter(KindNumber kind, const Visit& visit) {
    switch (kind) {
    case 0:
        return visit.template operator()<SphereFilter<Arch>>();
    case 1:
        return visit.template operator()<PlaneFilter<Arch>>();
    case 2:
        return visit.template operator()<AnyFilter<Arch, 2>>();
    case 3:
    case 4:
        return visit.template operator()<AnyFilter<Arch, 3>>();
    case 5:
        return visit.template operator()<AnyFilter<Arch, 5>>();
    case 6:
    case 7:
        return visit.template operator()<AnyFilter<Arch, 7>>();
    case 8:
    case 9:
        return visit.template operator()<AnyFilter<Arch, 9>>();
    default:
        return visit.template operator()<AnyFilter<Arch, 10>>();
    }
}
} // namespace raylane::simd
