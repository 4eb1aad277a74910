#pragma once

#include "simd/kernel/shapes/axial.hpp"
#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/first_crossing.hpp"
#include "simd/kernel/shapes/sphere.hpp"

/// Filters of cylinders and cones. Each ray is first moved to t = `start`, where it enters the slab
/// between the ends or a bounding sphere, unless it starts inside. So magnitudes are those of the
/// shape, the mirror nappe lies behind the ray, and the ray's next crossing with the body is the
/// answer.
namespace raylane::simd {

/// Filter of a cylinder or cone. Let x be the unit axis, f = origin + start d - base, m = f x x,
/// n = d x x, and W + s M the width at s = t - start, where W = r0 + k f . x, M = k d . x and
/// k = (r1 - r0) / |axis|. Then
///   F(s) = |m + s n|^2 - (W + s M)^2 = (n.n - M^2) s^2 + 2 (m.n - M W) s + (m.m - W^2)
/// and, as |m x n| = |f . n|, the discriminant is |W n - M m|^2 - (f . n)^2, without the
/// cancellation in B^2 - A C. For a cylinder k = 0.
///
/// Rounding moves x by u across itself and changes its length by 3.5 u, and k by 5 u. Let |f| stand
/// for its upper bound root_above(f . f), and let e = slack + u (3 start + 24 |f|). Then the point
/// at `start` is off by slack + u (3 start + 2 |f|). With |n|, |d| <= 1, |m| <= |f| and
/// |W| <= r0 + k |f|, the errors are:
///   m       slack + u (3 start + 9 |f|)               n   8 u
///   f . n   slack + u (3 start + 13 |f|)              M   15 u k
///   W       k (slack + u (3 start + 17 |f|)) + 3 u r0
///   W n - M m   k (2 slack + u (6 start + 53 |f|)) + 11 u r0
/// W n - M m and f . n together, with 2 u of each for the squares, give the discriminant's `body`
/// = (1 + 2.5 k) e + 16 u r0. It bounds the errors of m and W with their squares' too, so that
/// C is off by less than 2 body (|m| + |W| + body). B is off by |m| 11 u + |n| (error of m) + |M|
/// (error of W) + |W| 17 u k < (1 + 2 k^2) e + (22 k + 4) u r0.
template <class Arch, bool tapers, bool capped>
struct AxialFilter {
    using F = Floats<Arch>;
    static constexpr bool is_costly = true;
    static constexpr int values = tapers ? 8 : 7;

    Vectors<Arch> base, axis; ///< axis: of length 1
    Vectors<Arch> whole_axis;
    F largest_radius;
    F half_length, base_radius, narrowing;
    F reach;             ///< all of the shape is within this distance of the base
    Mask<Arch> ordinary; ///< no overflow or underflow in |axis|^2
    F body_factor, body_error, slope_factor, slope_error;

    template <class Reader>
    explicit AxialFilter(Reader reader) : AxialFilter(AxialNumbers<Arch, tapers>(reader)) {}
    explicit AxialFilter(const AxialNumbers<Arch, tapers>& shape)
        : base(shape.base), whole_axis(shape.axis), largest_radius(shape.base_radius),
          base_radius(shape.base_radius), narrowing(zero<Arch>()) {
        const F r0 = shape.base_radius, r1 = shape.top_radius;
        if constexpr (tapers) largest_radius = max(r0, r1);
        const F axis_squared = fast_dot(whole_axis, whole_axis);
        const F length = sqrt(axis_squared);
        const F inverse = F(1.0F) / length;
        axis = scaled<Arch>(inverse, whole_axis);
        half_length = F(0.5F) * length;
        ordinary = (axis_squared > F(0x1p-90F)) & (axis_squared < F(0x1p+120F));
        reach = (length + largest_radius) * F(1 + 0x1p-10F);
        if constexpr (tapers) {
            narrowing = (r1 - r0) * inverse;
            const F k = abs(narrowing);
            body_factor = fast_mul_add<Arch>(F(2.5F), k, F(1.0F));
            slope_factor = fast_mul_add<Arch>(k + k, k, F(1.0F));
            slope_error = fast_mul_add<Arch>(F(22.0F), k, F(4.0F)) * r0 * F(half_ulp);
        } else {
            slope_error = r0 * F(4 * half_ulp);
        }
        body_error = r0 * F(16 * half_ulp);
    }
    template <class Reader>
    explicit AxialFilter(Derived<Reader> reader)
        : base(next_vector<Arch>(reader)), axis(next_vector<Arch>(reader)),
          whole_axis(next_vector<Arch>(reader)), largest_radius(reader.next()),
          half_length(reader.next()), base_radius(reader.next()), narrowing(reader.next()),
          reach(reader.next()), ordinary(reader.next() > zero<Arch>()), body_factor(reader.next()),
          body_error(reader.next()), slope_factor(reader.next()), slope_error(reader.next()) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        const F o = zero<Arch>();
        visit_each(visit, base, axis, whole_axis, largest_radius, half_length, base_radius,
                   narrowing, reach, select(ordinary, F(1.0F), o), tapers ? body_factor : o,
                   body_error, tapers ? slope_factor : o, slope_error);
    }

    /// True where a ray may meet the shape. Costs less than bounds().
    ///
    /// Let a be the axis as given, c = d x a and R the largest radius. The ray passes the line
    /// through the axis at a distance of |f . c| / |c|, nearest to base + s a where
    /// s |c|^2 = P = f . a - (f . d)(d . a). It is nearer than R where s is off by less than
    /// R |d . a| / |c|^2. So it misses if |f . c| > R |c|, and if P is not within R |d . a| of the
    /// interval from 0 to |c|^2.
    ///
    /// With f off by slack + u |f| and d by u, f . c is off by |a| (slack + 8 u |f|), |c| by
    /// 3.5 u |a|, P by |a| (2 slack + 16 u |f|), |c|^2 by 12 u |a|^2 and d . a by 4 u |a|.
    [[gnu::always_inline]] Mask<Arch> may_meet(const FilterRays<Arch>& rays) const {
        const F o = zero<Arch>();
        const Vectors<Arch> a = whole_axis;
        const F size = abs(a.x) + abs(a.y) + abs(a.z) + F(0x1p-100F);
        const F radius = (largest_radius + F(0x1p-60F)) * F(1 + 0x1p-19F);
        const F radius_squared = radius * radius;

        const Vectors<Arch> f = rays.origin - base;
        const Vectors<Arch> c = fast_cross(rays.direction, a);
        const F c_squared = fast_dot(c, c) + F(0x1p-110F);
        const F rise = fast_dot(rays.direction, a);
        const F far = abs(f.x) + abs(f.y) + abs(f.z);
        const F error = size * fast_mul_add<Arch>(F(10 * half_ulp), far,
                                                  fast_mul_add<Arch>(F(8 * half_ulp), radius,
                                                                     rays.slack + rays.slack));
        const F beside = abs(fast_dot(f, c)) - error;
        const F beside_squared = beside * beside;
        const F along =
            fast_mul_add<Arch>(fast_dot(f, rays.direction), negated(rise), fast_dot(f, a));
        const F half_way = F(0.5F) * c_squared;
        const F room = fast_mul_add<Arch>(radius, abs(rise), error + error) +
                       fast_mul_add<Arch>(F(20 * half_ulp) * size, size, half_way);
        const Mask<Arch> missed =
            ((beside > o) &
             (beside_squared > fast_mul_add<Arch>(radius_squared, c_squared, F(underflow)))) |
            (abs(along - half_way) > room);
        const Mask<Arch> known = beside_squared + abs(along) < F(__builtin_inff());
        return is_number<Arch>(f.x) & ~(missed & known);
    }

    /// The chord is that of a bounding sphere. It does not bound where the ray enters and leaves
    /// the shape inside the sphere.
    static constexpr bool has_chord_around = true;
    [[gnu::always_inline]] Chord<Arch> chord(const FilterRays<Arch>& rays) const requires capped {
        const Vectors<Arch> middle = fast_mul_add<Arch>(F(0.5F), whole_axis, base);
        // Adds more than anything that underflows.
        const F radius = half_length + largest_radius + F(0x1p-40F);
        const Chord<Arch> around = SphereFilter<Arch>(rounded_up<Arch>(middle, radius)).chord(rays);
        return {around.entry, around.exit_end, zero<Arch>(), around.exit_end};
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        if constexpr (capped)
            return capped_bounds(rays);
        else
            return open_bounds(rays);
    }

  private:
    struct Crossing {
        Stay<Arch> between_ends;
        F start;
        FirstCrossing<Arch> body;
        Mask<Arch> is_shape;
        Mask<Arch> near;  ///< close enough for the errors in between_ends, as is any ray that hits
        Mask<Arch> nappe; ///< W > 0
    };

    [[gnu::always_inline]] Crossing cross(const FilterRays<Arch>& rays) const {
        const Vectors<Arch> from_base = rays.origin - base;
        const F closest = negated(fast_dot(from_base, rays.direction));

        // The height above the middle. Its error is 9 u |f| and slack for f . x, 2 u |axis| for
        // half the length, twice, and 3 u of their sum for rounding. If the ray comes near,
        // |f| <= |closest| + 2 reach.
        const F position = fast_dot(from_base, axis) - half_length;
        const F rise = fast_dot(rays.direction, axis);
        const F far = abs(closest) + (reach + reach);
        const F height_error = fast_mul_add<Arch>(F(15 * half_ulp), far, rays.slack);
        const Stay<Arch> ends =
            cross_slab<Arch>(position, half_length, height_error, rise, F(9 * half_ulp));

        const F start = max(positive_part<Arch>(ends.in_low),
                            positive_part<Arch>(closest - (reach + height_error)));
        const Vectors<Arch> f = fast_mul_add<Arch>(start, rays.direction, from_base);
        const Vectors<Arch> m = fast_cross(f, axis), n = fast_cross(rays.direction, axis);
        const F distance = root_above<Arch>(fast_dot(f, f));
        const F error = fast_mul_add<Arch>(F(24 * half_ulp), distance,
                                           fast_mul_add<Arch>(F(3 * half_ulp), start, rays.slack));
        const F across = fast_dot(f, n);
        const F m_squared = fast_dot(m, m);
        const F m_length = root_above<Arch>(m_squared);

        F W = base_radius, B = fast_dot(m, n), B_error = error + slope_error,
          body = error + body_error, g_squared, g_length;
        if constexpr (tapers) {
            const F M = narrowing * rise;
            W = fast_mul_add<Arch>(narrowing, fast_dot(f, axis), base_radius);
            B = fast_mul_add<Arch>(negated(M), W, B);
            B_error = fast_mul_add<Arch>(slope_factor, error, slope_error);
            body = fast_mul_add<Arch>(body_factor, error, body_error);
            const Vectors<Arch> across_m = {M * m.x, M * m.y, M * m.z};
            const Vectors<Arch> g = fast_mul_add<Arch>(W, n, -across_m);
            g_squared = fast_dot(g, g);
            g_length = root_above<Arch>(g_squared);
        } else {
            g_squared = base_radius * base_radius * fast_dot(n, n);
            g_length = base_radius; // |n| <= 1 but for rounding, which the error covers
        }
        const F C = fast_mul_add<Arch>(negated(W), W, m_squared);
        const F C_error = (body + body) * (m_length + abs(W) + body);
        const F D = fast_mul_add<Arch>(negated(across), across, g_squared);
        const F D_error = body * (g_length + g_length + body);
        return {ends,
                start,
                FirstCrossing<Arch>(B, B_error, C, C_error, D, D_error),
                is_number<Arch>(closest),
                (distance < reach + reach),
                (W > zero<Arch>())};
    }

    [[gnu::always_inline]] Bounds<Arch> open_bounds(const FilterRays<Arch>& rays) const {
        const Crossing crossing = cross(rays);
        const Bounds<Arch> bounds = surface_bounds<Arch>(crossing.is_shape, crossing.between_ends,
                                                         crossing.start, crossing.body);
        return sure(crossing, bounds);
    }

    [[gnu::always_inline]] Bounds<Arch> capped_bounds(const FilterRays<Arch>& rays) const {
        const Crossing crossing = cross(rays);
        const Stay<Arch>& ends = crossing.between_ends;
        const FirstCrossing<Arch>& body = crossing.body;
        const F o = zero<Arch>();
        const F body_low = (crossing.start + body.low) * F(1 - 4 * half_ulp);
        const F body_high = (crossing.start + body.high) * F(1 + 4 * half_ulp);

        // A ray that is within the body at `start` enters the solid there at the earliest. If it
        // starts inside the solid, its exit counts, through the body or through an end.
        const Mask<Arch> within = body.inside & crossing.nappe & crossing.near;
        const Mask<Arch> inside = within & ends.inside & (crossing.start == o);
        const F entry = select(body.outside, body_low, crossing.start);
        const F leaves = select(body.none, F(__builtin_inff()), body_low);
        const F exit = min(positive_part<Arch>(ends.out_low), leaves); // NaN if `leaves` is NaN
        const Mask<Arch> missed = (body.none & body.outside) | (ends.out_high < crossing.start) |
                                  (body.outside & (ends.out_high < body_low));

        // A crossing is certain through the body between the ends; through an end, if the ray does
        // not leave the body before; or from inside.
        const Mask<Arch> by_body =
            body.outside & body.definite & (body_low >= ends.in_high) & (body_high <= ends.out_low);
        const Mask<Arch> by_end = within & (ends.in_low > o) & (crossing.start <= ends.in_high) &
                                  (ends.in_high <= leaves) & (ends.in_high <= ends.out_low);
        const F exit_high = select(body.definite, min(body_high, ends.out_high), ends.out_high);
        return sure(crossing,
                    {crossing.is_shape & ~missed, positive_part<Arch>(select(inside, exit, entry)),
                     ends.definite & (by_body | by_end | inside),
                     select(inside, exit_high, select(body.outside, body_high, ends.in_high))});
    }

    [[gnu::always_inline]] Bounds<Arch> sure(const Crossing& crossing,
                                             const Bounds<Arch>& bounds) const {
        return {crossing.is_shape & (bounds.possible | ~ordinary),
                select(ordinary, bounds.lower, zero<Arch>()),
                bounds.certain & ordinary & crossing.near, bounds.upper};
    }
};

} // namespace raylane::simd
