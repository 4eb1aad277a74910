#pragma once

#include "simd/kernel/shapes/axial.hpp"
#include "simd/kernel/shapes/axial_filter.hpp"
#include "simd/kernel/shapes/axial_finisher.hpp"
#include "simd/kernel/shapes/quadratic.hpp"

namespace raylane::simd {

template <class Arch>
struct CylinderNumbers {
    Vectors<Arch> base, axis;
    Floats<Arch> radius;

    template <class Reader>
    explicit CylinderNumbers(Reader reader)
        : base(next_vector<Arch>(reader)), axis(next_vector<Arch>(reader)), radius(reader.next()) {}

    static constexpr int ends = 2;
    /// Around one end of the body, which is between both.
    SphereAround<Arch> enclosing(int end) const {
        return end == 0 ? rounded_up<Arch>(base, radius) : rounded_up<Arch>(base + axis, radius);
    }

    Floats<Arch> base_width() const { return radius; }
    Floats<Arch> top_width() const { return radius; }
};

template <class Arch, bool capped>
struct CylinderFilter {
    static constexpr bool is_costly = true;
    static constexpr int values = 7;
    AxialFilter<Arch, false> axial;

    template <class Reader>
    explicit CylinderFilter(Reader reader) : axial(read(reader)) {}

    [[gnu::always_inline]] Mask<Arch> may_meet(const FilterRays<Arch>& rays) const {
        return axial.may_meet(rays);
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        if constexpr (capped)
            return axial.capped_bounds(rays);
        else
            return axial.open_bounds(rays);
    }

  private:
    template <class Reader>
    static AxialFilter<Arch, false> read(Reader& reader) {
        const Vectors<Arch> base = next_vector<Arch>(reader), axis = next_vector<Arch>(reader);
        const Floats<Arch> radius = reader.next();
        return {base, axis, radius, radius};
    }
};

/// core/shapes/cylinder.hpp
template <class Arch, bool capped, bool textbook>
struct CylinderSolver : CylinderNumbers<Arch> {
    using Numbers = CylinderNumbers<Arch>;
    using Numbers::Numbers, Numbers::base, Numbers::axis, Numbers::radius;
    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const AxialRays<Arch> axial(base, axis, rays);
        const Floats<Arch> speed_squared = squared_length(axial.across_direction);
        const Mask<Arch> parallel =
            ~(speed_squared > zero<Arch>()) & ~(speed_squared < zero<Arch>());
        const Floats<Arch> tau =
            select(parallel, zero<Arch>(),
                   negated(dot(axial.across_origin, axial.across_direction)) / speed_squared);

        ClipInterval<Arch> interval;
        const Mask<Arch> from_body = starts.on_surface & (starts.face == zero<Arch>());
        interval.clip_back(from_body & ~parallel, not_behind<Arch>(tau + tau), zero<Arch>());

        const Vectors<Arch> foot = mul_add<Arch>(tau, axial.across_direction, axial.across_origin);
        const Floats<Arch> discriminant =
            mul_add<Arch>(radius, radius, negated(squared_length(foot)));
        const Mask<Arch> no_roots = discriminant < zero<Arch>();
        Mask<Arch> beside = no_roots & ~starts.on_surface;
        const Floats<Arch> half_chord =
            sqrt(select(no_roots, zero<Arch>(), discriminant) / speed_squared);
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
        const Vectors<Arch> unit_axis = normalized(axis);
        const Vectors<Arch> from_axis = normalized(offset_from_axis(base, axis, point));
        return select(face == constant<Arch>(base_cap_code), -unit_axis,
                      select(face == constant<Arch>(top_cap_code), unit_axis, from_axis));
    }
};

template <class Arch>
struct CylinderProfile : CylinderNumbers<Arch> {
    static constexpr bool tapers = false;
    using CylinderNumbers<Arch>::CylinderNumbers;
};

template <>
struct ShapeKernels<core::OpenCylinder> {
    template <class Arch>
    using Numbers = CylinderNumbers<Arch>;
    template <class Arch, bool textbook>
    using Solver = CylinderSolver<Arch, false, textbook>;
    template <class Arch>
    using Filter = CylinderFilter<Arch, false>;
    template <class D>
    using Finisher = OpenFinisher<D, CylinderProfile<D>>;
};

template <>
struct ShapeKernels<core::CappedCylinder> {
    template <class Arch>
    using Numbers = CylinderNumbers<Arch>;
    template <class Arch, bool textbook>
    using Solver = CylinderSolver<Arch, true, textbook>;
    template <class Arch>
    using Filter = CylinderFilter<Arch, true>;
    template <class D>
    using Finisher = CappedFinisher<D, CylinderProfile<D>>;
};

} // namespace raylane::simd
