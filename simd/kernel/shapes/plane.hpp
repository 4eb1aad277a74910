#pragma once

#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/flat.hpp"

namespace raylane::simd {

template <class Arch>
struct PlaneNumbers {
    Vectors<Arch> point, normal;

    template <class Reader>
    explicit PlaneNumbers(Reader reader)
        : point(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)) {}

    /// A plane has no bounding sphere, so the radius is infinite.
    SphereAround<Arch> enclosing() const { return {point, Floats<Arch>(__builtin_inff())}; }
};

template <class Arch>
struct PlaneFilter : PlaneNumbers<Arch> {
    using Numbers = PlaneNumbers<Arch>;
    using Numbers::Numbers, Numbers::point, Numbers::normal;
    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> to_point = point - rays.origin;
        const FlatCrossing<Arch> crossing = cross_plane(to_point, normal, rays);
        // A plane is the only shape that a ray may meet beyond the largest float.
        const F lower = min(positive_part<Arch>(crossing.lower), F(0x1.fffffep+127F));
        return {is_number<Arch>(to_point.x) & ~crossing.behind, lower, crossing.ahead,
                crossing.upper};
    }
};

template <class Arch, bool>
struct PlaneSolver : PlaneNumbers<Arch> {
    using Numbers = PlaneNumbers<Arch>;
    using Numbers::Numbers, Numbers::point, Numbers::normal;
    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        Crossing<Arch> crossing = cross_plane(point - rays.origin, normal, rays.direction);
        crossing.exists = crossing.exists & ~starts.on_surface;
        return only(crossing);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>&) const {
        return normalized(normal);
    }
};

/// CertifiedSolver of a plane. t = (normal . (point - origin)) / (normal . direction), where
/// rounding is relative to the single terms of each product. So for a plane along the coordinate
/// axes, the distance of its point hardly matters. Each product errs by 4 u times the sum of its
/// terms' sizes. t errs by both errors divided by approach, enlarged by the relative error of
/// approach itself, which is at most 2^-27 where t is certain.
template <class Arch>
struct PlaneCertifiedSolver {
    PlaneNumbers<Arch> plane;

    template <class Reader>
    explicit PlaneCertifiedSolver(Reader reader) : plane(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] CertifiedCrossing<Arch> solve(const Rays<Arch>& rays,
                                                         const Starts<Arch>& starts) const {
        using F = Floats<Arch>;
        const F inverse = F(1.0) / dot(plane.normal, rays.direction);
        const Vectors<Arch> to_point = plane.point - rays.origin;
        const F t = dot(plane.normal, to_point) * inverse;
        const F error = F(0x1p-50) * abs(inverse) *
                        (sum_of_terms(plane.normal, to_point) +
                         abs(t) * sum_of_terms(plane.normal, rays.direction));
        return solve_flat<wanted, Arch>(all<Arch>(), all<Arch>(),
                                        have_no_product(plane.normal, rays.direction), t, error,
                                        inverse, unit<Arch>(plane.normal), starts);
    }

  private:
    static Floats<Arch> sum_of_terms(const Vectors<Arch>& a, const Vectors<Arch>& b) {
        return abs(a.x * b.x) + abs(a.y * b.y) + abs(a.z * b.z);
    }
};

template <>
struct ShapeKernels<core::Plane>
    : ShapeKernelsOf<PlaneNumbers, PlaneFilter, PlaneSolver, PlaneCertifiedSolver> {};

} // namespace raylane::simd
