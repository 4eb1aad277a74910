#pragma once

#include "simd/kernel/lanes/bounded.hpp"
#include "simd/kernel/shapes/crossings.hpp"
#include "simd/kernel/shapes/enclosing.hpp"

/// Shared parts of cylinders and cones, as in core/shapes/axial.hpp.
namespace raylane::simd {

/// The numbers of a cone if `tapers`, otherwise of a cylinder, which has a single radius.
template <class Arch, bool tapers>
struct AxialNumbers {
    Vectors<Arch> base, axis;
    Floats<Arch> base_radius, top_radius;

    template <class Reader>
    explicit AxialNumbers(Reader reader)
        : base(next_vector<Arch>(reader)), axis(next_vector<Arch>(reader)),
          base_radius(reader.next()), top_radius(base_radius) {
        if constexpr (tapers) top_radius = reader.next();
    }

    static constexpr int ends = 2;
    /// Returns the bounding sphere of one end. The body lies between those of both ends.
    SphereAround<Arch> enclosing(int end) const {
        return end == 0 ? rounded_up<Arch>(base, base_radius)
                        : rounded_up<Arch>(base + axis, top_radius);
    }
};

/// An axis, with the numbers derived from it that rays need.
template <class Arch>
struct Axis {
    Vectors<Arch> base, axis;
    Floats<Arch> squared;
    Divisor<Arch> by_squared;

    Axis(const Vectors<Arch>& base_, const Vectors<Arch>& axis_)
        : base(base_), axis(axis_), squared(squared_length(axis_)), by_squared(squared) {}
    template <class Reader>
    explicit Axis(Derived<Reader>& reader)
        : base(next_vector<Arch>(reader)), axis(next_vector<Arch>(reader)), squared(reader.next()),
          by_squared(Divisor<Arch>::of_kept(reader.next())) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, base, axis, squared, by_squared.kept());
    }
};

/// Same as core::are_parallel, per lane of numbers with bounds.
template <class Arch>
Mask<Arch> are_parallel(const Vectors<Arch>& a, const Vectors<Arch>& b) {
    using D = typename Floats<Arch>::D;
    using F = Floats<D>;
    const auto have_equal_products = [](const F& p, const F& q, const F& r, const F& s) {
        const auto first = DoubleDoubles<D>::two_product(p, q);
        const auto second = DoubleDoubles<D>::two_product(r, s);
        const F o = zero<D>();
        const Mask<D> are_zero = ((p == o) | (q == o)) & ((r == o) | (s == o));
        return (first.high == second.high) & (first.low == second.low) &
               (are_zero | (abs(first.high) > F(0x1p-900)));
    };
    const F a_x = a.x.in_double(), a_y = a.y.in_double(), a_z = a.z.in_double();
    const F b_x = b.x.in_double(), b_y = b.y.in_double(), b_z = b.z.in_double();
    return Mask<Arch>(have_equal_products(a_y, b_z, a_z, b_y) &
                          have_equal_products(a_z, b_x, a_x, b_z) &
                          have_equal_products(a_x, b_y, a_y, b_x),
                      Mask<D>(true));
}

template <class Arch>
struct AxialRays {
    Floats<Arch> axis_squared, height_origin, height_direction;
    Vectors<Arch> across_origin, across_direction;

    AxialRays(const Axis<Arch>& axis, const Rays<Arch>& rays) : axis_squared(axis.squared) {
        const Vectors<Arch> from_base = rays.origin - axis.base;
        height_origin = dot(from_base, axis.axis);
        height_direction = dot(rays.direction, axis.axis);
        across_origin =
            mul_add<Arch>(negated(height_origin / axis.by_squared), axis.axis, from_base);
        across_direction =
            mul_add<Arch>(negated(height_direction / axis.by_squared), axis.axis, rays.direction);
        if constexpr (requires { axis_squared.error; }) {
            const Floats<Arch> o = zero<Arch>();
            across_direction = select<Arch>(are_parallel<Arch>(axis.axis, rays.direction),
                                            {o, o, o}, across_direction);
        }
    }

    Mask<Arch> between_ends(const Floats<Arch>& t) const {
        const Floats<Arch> height = mul_add<Arch>(t, height_direction, height_origin);
        return ~(height < zero<Arch>()) & ~(axis_squared < height);
    }
};

inline constexpr float base_cap_code = 1.0F;
inline constexpr float top_cap_code = 2.0F;

template <class Arch>
void clip_caps(ClipInterval<Arch>& interval, const AxialRays<Arch>& axial,
               const Starts<Arch>& starts) {
    const Floats<Arch> base_face = constant<Arch>(base_cap_code),
                       top_face = constant<Arch>(top_cap_code);
    interval.clip_slab(~starts.on_surface, axial.height_origin, axial.height_direction,
                       axial.axis_squared, base_cap_code, top_cap_code);
    const Mask<Arch> rises =
        starts.on_surface & (axial.height_direction > zero<Arch>()) & (starts.face != top_face);
    const Mask<Arch> falls =
        starts.on_surface & (axial.height_direction < zero<Arch>()) & (starts.face != base_face);
    interval.clip_back(rises, (axial.axis_squared - axial.height_origin) / axial.height_direction,
                       top_face);
    interval.clip_back(falls, negated(axial.height_origin) / axial.height_direction, base_face);
}

template <class Arch>
Crossings<Arch> keep_between_ends(Crossings<Arch> crossings, const AxialRays<Arch>& axial) {
    crossings.first.exists = crossings.first.exists & axial.between_ends(crossings.first.t);
    crossings.second.exists = crossings.second.exists & axial.between_ends(crossings.second.t);
    return crossings;
}

template <class Arch>
Vectors<Arch> offset_from_axis(const Vectors<Arch>& base, const Vectors<Arch>& axis,
                               const Vectors<Arch>& point) {
    const Vectors<Arch> from_base = point - base;
    Vectors<Arch> across =
        mul_add<Arch>(negated(dot(from_base, axis) / squared_length(axis)), axis, from_base);
    if constexpr (requires { across.x.error; }) {
        // No bound on errors proves that an offset from a coordinate axis has no part along it.
        const Floats<Arch> o = zero<Arch>();
        const Mask<Arch> no_x = axis.x == o, no_y = axis.y == o, no_z = axis.z == o;
        across = {select(no_y & no_z, o, across.x), select(no_z & no_x, o, across.y),
                  select(no_x & no_y, o, across.z)};
    }
    return across;
}

} // namespace raylane::simd
