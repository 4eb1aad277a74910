#pragma once

#include "simd/kernel/shapes/axial_kernels.hpp"
#include "simd/kernel/shapes/quadratic.hpp"

namespace raylane::simd {

/// Same formulas as core/shapes/cone.hpp, per lane.
template <class Arch, bool capped, bool textbook>
struct ConeSolver {
    Axis<Arch> axis;
    Floats<Arch> base_radius, top_radius, slope;

    template <class Reader>
    explicit ConeSolver(Reader reader) : ConeSolver(AxialNumbers<Arch, true>(reader)) {}
    template <class Reader>
    explicit ConeSolver(Derived<Reader> reader)
        : axis(reader), base_radius(reader.next()), top_radius(reader.next()),
          slope(reader.next()) {}
    explicit ConeSolver(const AxialNumbers<Arch, true>& cone)
        : axis(cone.base, cone.axis), base_radius(cone.base_radius), top_radius(cone.top_radius),
          slope((top_radius - base_radius) / axis.squared) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        axis.derived(visit);
        visit_each(visit, base_radius, top_radius, slope);
    }

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Floats<Arch> o = zero<Arch>();
        const AxialRays<Arch> axial(axis, rays);
        const Floats<Arch> W = mul_add<Arch>(slope, axial.height_origin, base_radius);
        const Floats<Arch> M = slope * axial.height_direction;
        const Floats<Arch> across_squared = squared_length(axial.across_direction);
        const Floats<Arch> A = mul_add<Arch>(negated(M), M, across_squared);
        const Floats<Arch> B =
            mul_add<Arch>(negated(M), W, dot(axial.across_origin, axial.across_direction));
        const Floats<Arch> C = mul_add<Arch>(negated(W), W, squared_length(axial.across_origin));
        const Mask<Arch> opens_up = A > o, opens_down = A < o;

        Crossings<Arch> roots = solve_quadratic<Arch, textbook>(
            A, B, C, mul_add<Arch>(M, M, across_squared), [&](const Floats<Arch>& tau) {
                const Floats<Arch> width = mul_add<Arch>(tau, M, W);
                return mul_add<Arch>(negated(width), width,
                                     squared_length(mul_add<Arch>(tau, axial.across_direction,
                                                                  axial.across_origin)));
            });
        const Mask<Arch> from_body = starts.on_surface & (starts.face == o);
        const Mask<Arch> no_roots = ~roots.first.exists & ~roots.second.exists;
        const Mask<Arch> missed = ~from_body & no_roots & (opens_up | (C > o));
        const Mask<Arch> beside = missed & ~starts.on_surface;
        const Mask<Arch> by_rim = missed & starts.on_surface;

        roots.first.exists = roots.first.exists & ~from_body;
        const Mask<Arch> body_exit = from_body & opens_up;
        roots.second.exists = (roots.second.exists & ~from_body) | body_exit | by_rim;
        roots.second.t = select(from_body, not_behind<Arch>(negated(B + B) / A), roots.second.t);
        const Floats<Arch> vertex = select(opens_up, negated(B) / A, o);
        roots.second.t = select(by_rim, not_behind<Arch>(vertex), roots.second.t);
        roots.second.entering = roots.second.entering & ~from_body & ~by_rim;

        const Mask<Arch> widens = M > o;
        for (Crossing<Arch>* root : {&roots.first, &roots.second}) {
            const Mask<Arch> on_nappe = (root->entering & widens) | (~root->entering & ~widens);
            root->exists = root->exists & (~opens_down | on_nappe);
        }

        Crossings<Arch> result = roots;
        if constexpr (capped) {
            ClipInterval<Arch> interval;
            for (const Crossing<Arch>& root : {roots.first, roots.second}) {
                interval.clip_front(root.exists & root.entering & ~starts.on_surface, root.t, o);
                interval.clip_back(root.exists & ~root.entering, root.t, o);
            }
            clip_caps(interval, axial, starts);
            result = interval.crossings(starts.on_surface);
        } else {
            result = keep_between_ends(roots, axial);
        }
        result.first.exists = result.first.exists & ~beside;
        result.second.exists = result.second.exists & ~beside;
        return inward_only(result, starts);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>& face) const {
        const Floats<Arch> o = zero<Arch>();
        const Vectors<Arch> unit_axis = normalized(axis.axis);
        const Vectors<Arch> across = offset_from_axis(axis.base, axis.axis, point);
        const Floats<Arch> narrowing = base_radius - top_radius;
        const Floats<Arch> width = sqrt(squared_length(across));
        const Vectors<Arch> gradient =
            mul_add<Arch>(width * narrowing / axis.squared, axis.axis, across);
        const Vectors<Arch> at_apex = select(narrowing > o, unit_axis, -unit_axis);
        const Vectors<Arch> on_body =
            select(squared_length(gradient) > o, normalized(gradient), at_apex);
        return select(face == constant<Arch>(base_cap_code), -unit_axis,
                      select(face == constant<Arch>(top_cap_code), unit_axis, on_body));
    }
};

template <>
struct ShapeKernels<core::OpenCone> : AxialKernels<true, false, ConeSolver> {};
template <>
struct ShapeKernels<core::CappedCone> : AxialKernels<true, true, ConeSolver> {};

} // namespace raylane::simd
