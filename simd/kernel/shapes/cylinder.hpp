#pragma once

#include "simd/kernel/shapes/axial_kernels.hpp"
#include "simd/kernel/shapes/quadratic.hpp"

namespace raylane::simd {

/// Same formulas as core/shapes/cylinder.hpp, per lane.
template <class Arch, bool capped, bool textbook>
struct CylinderSolver {
    Axis<Arch> axis;
    Floats<Arch> radius;

    template <class Reader>
    explicit CylinderSolver(Reader reader) : CylinderSolver(AxialNumbers<Arch, false>(reader)) {}
    template <class Reader>
    explicit CylinderSolver(Derived<Reader> reader) : axis(reader), radius(reader.next()) {}
    explicit CylinderSolver(const AxialNumbers<Arch, false>& cylinder)
        : axis(cylinder.base, cylinder.axis), radius(cylinder.base_radius) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        axis.derived(visit);
        visit(radius);
    }

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const AxialRays<Arch> axial(axis, rays);
        const Floats<Arch> speed_squared = squared_length(axial.across_direction);
        const Divisor<Arch> by_speed_squared(speed_squared);
        const Mask<Arch> parallel =
            ~(speed_squared > zero<Arch>()) & ~(speed_squared < zero<Arch>());
        const Floats<Arch> tau =
            select(parallel, zero<Arch>(),
                   negated(dot(axial.across_origin, axial.across_direction)) / by_speed_squared);

        ClipInterval<Arch> interval;
        const Mask<Arch> from_body = starts.on_surface & (starts.face == zero<Arch>());
        interval.clip_back(from_body & ~parallel, not_behind<Arch>(tau + tau), zero<Arch>());

        const Vectors<Arch> foot = mul_add<Arch>(tau, axial.across_direction, axial.across_origin);
        const Floats<Arch> discriminant =
            mul_add<Arch>(radius, radius, negated(squared_length(foot)));
        const Mask<Arch> no_roots = discriminant < zero<Arch>();
        Mask<Arch> beside = no_roots & ~starts.on_surface;
        const Floats<Arch> half_chord =
            sqrt(select(no_roots, zero<Arch>(), discriminant) / by_speed_squared);
        if constexpr (textbook) {
            const Floats<Arch> C = squared_length(axial.across_origin) - radius * radius;
            const Crossings<Arch> roots = solve_textbook<Arch>(
                speed_squared, dot(axial.across_origin, axial.across_direction), C);
            beside = ~starts.on_surface &
                     ((parallel & (C > zero<Arch>())) | (~parallel & ~roots.first.exists));
            interval.clip_front(roots.first.exists & ~parallel & ~starts.on_surface, roots.first.t,
                                zero<Arch>());
            interval.clip_back(roots.second.exists & ~parallel & ~starts.on_surface, roots.second.t,
                               zero<Arch>());
            interval.clip_back(~parallel & ~from_body & starts.on_surface, tau + half_chord,
                               zero<Arch>());
        } else {
            interval.clip_front(~parallel & ~starts.on_surface, tau - half_chord, zero<Arch>());
            interval.clip_back(~parallel & ~from_body, tau + half_chord, zero<Arch>());
        }

        if constexpr (capped) clip_caps(interval, axial, starts);
        Crossings<Arch> result = interval.crossings(starts.on_surface);
        if constexpr (!capped) result = keep_between_ends(result, axial);
        result.first.exists = result.first.exists & ~beside;
        result.second.exists = result.second.exists & ~beside;
        return inward_only(result, starts);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>& face) const {
        const Vectors<Arch> unit_axis = normalized(axis.axis);
        const Vectors<Arch> from_axis = normalized(offset_from_axis(axis.base, axis.axis, point));
        return select(face == constant<Arch>(base_cap_code), -unit_axis,
                      select(face == constant<Arch>(top_cap_code), unit_axis, from_axis));
    }
};

template <>
struct ShapeKernels<core::OpenCylinder> : AxialKernels<false, false, CylinderSolver> {};
template <>
struct ShapeKernels<core::CappedCylinder> : AxialKernels<false, true, CylinderSolver> {};

} // namespace raylane::simd
