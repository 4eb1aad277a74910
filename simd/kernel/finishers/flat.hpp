#pragma once

#include "simd/kernel/finishers/finisher.hpp"
#include "simd/kernel/solvers/flat.hpp"

namespace raylane::simd {

/// A flat shape is not met again by a ray that starts on it. `passed`: the line surely does not
/// cross it, for one as it is parallel to it; `clear`: where t is known, so that it may be behind
/// the ray.
template <Wanted wanted, class Arch>
Finished<Arch> finish_flat(const Mask<Arch>& clear, const Mask<Arch>& inside,
                           const Mask<Arch>& passed, const Floats<Arch>& t,
                           const Floats<Arch>& error, const Floats<Arch>& approach,
                           const Vectors<Arch>& unit_normal, const Starts<Arch>& starts) {
    Finished<Arch> result = {clear & inside & ~starts.on_surface & is_result<Arch>(t, error),
                             t,
                             error,
                             zero<Arch>(),
                             approach < zero<Arch>(),
                             unit_normal};
    if constexpr (wanted == Wanted::all) {
        result.misses = (clear & (t < negated(error))) | passed;
        result.normal_error = error_of_unit<Arch>(unit_normal);
    }
    return result;
}

/// t = (normal . (point - origin)) / (normal . direction), where rounding is relative to the single
/// terms of each product: on a floor along the axes it hardly matters how far away its point is.
/// Each product errs by 4 u times the sum of its terms' sizes; t by both, divided by approach, and
/// the share 2^-27 of which approach itself is in doubt where t is certain.
template <class Arch>
struct PlaneFinisher {
    PlaneLanes<Arch> plane;

    template <class Reader>
    explicit PlaneFinisher(Reader reader) : plane(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] Finished<Arch> finish(const Rays<Arch>& rays,
                                                 const Starts<Arch>& starts) const {
        using F = Floats<Arch>;
        const F inverse = F(1.0) / dot(plane.normal, rays.direction);
        const Vectors<Arch> to_point = plane.point - rays.origin;
        const F t = dot(plane.normal, to_point) * inverse;
        const F error = F(0x1p-50) * abs(inverse) *
                        (sum_of_terms(plane.normal, to_point) +
                         abs(t) * sum_of_terms(plane.normal, rays.direction));
        return finish_flat<wanted, Arch>(all<Arch>(), all<Arch>(),
                                         have_no_product(plane.normal, rays.direction), t, error,
                                         inverse, unit<Arch>(plane.normal), starts);
    }

  private:
    static Floats<Arch> sum_of_terms(const Vectors<Arch>& a, const Vectors<Arch>& b) {
        return abs(a.x * b.x) + abs(a.y * b.y) + abs(a.z * b.z);
    }
};

/// With N >= |normal|, normal . at(s) is off by N times the error of the position and 6 u (|start|
/// + |s|) for the products; so s errs by that, divided by |approach|, if approach itself is certain
/// within a fifth: it errs by 5 u N.
template <class Arch>
struct DiscFinisher {
    DiscLanes<Arch> disc;

    template <class Reader>
    explicit DiscFinisher(Reader reader) : disc(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] Finished<Arch> finish(const Rays<Arch>& rays,
                                                 const Starts<Arch>& starts) const {
        using F = Floats<Arch>;
        const F radius = disc.radius;
        const LocalRays<Arch> local(rays, disc.center);
        const F N = sum_of_sizes(disc.normal);
        const F approach = dot(disc.normal, local.direction);
        const F inverse = F(1.0) / approach;
        const F s = negated(dot(disc.normal, local.start)) * inverse;
        const F position_error = local.error_at(s, 8.0);
        const F error_s = F(1.25) * N * position_error * abs(inverse);

        // |p| <= radius: p is off by `off`, so |p|^2 by 2 radius off + off^2, and 6 u radius^2.
        const F off = position_error + error_s, reach = radius + off;
        const F squared = squared_length(local.at(s));
        const Mask<Arch> clear = abs(approach) > F(0x1p-44) * N;
        const Mask<Arch> inside =
            radius * radius - squared > radius * (F(3.0) * off + F(0x1p-49) * radius);
        const Mask<Arch> outside = squared > (reach * reach) * F(1.0 + 0x1p-48);
        const F t = local.shift + s;
        const Mask<Arch> passed = (clear & outside) | have_no_product(disc.normal, local.direction);
        return finish_flat<wanted, Arch>(clear, inside, passed, t, local.error_of_t(t, s, error_s),
                                         approach, unit<Arch>(disc.normal), starts);
    }
};

/// Barycentric coordinates, times normal . direction, from one cross product of start and
/// direction (Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997).
/// With U >= |b - a|, V >= |c - a|: the normal errs by 5 u U V, its products with vectors by 10 u U
/// V times their lengths; the coordinates by U or V times that of the start and 10 u |start|, with
/// room for 1.74^2, as the components of a cross product have each their own error.
template <class Arch>
struct TriangleFinisher {
    TriangleLanes<Arch> triangle;

    template <class Reader>
    explicit TriangleFinisher(Reader reader) : triangle(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] Finished<Arch> finish(const Rays<Arch>& rays,
                                                 const Starts<Arch>& starts) const {
        const LocalRays<Arch> local(rays, triangle.a);
        const Vectors<Arch> to_b = triangle.b - triangle.a, to_c = triangle.c - triangle.a;
        const F U = sum_of_sizes(to_b), V = sum_of_sizes(to_c);
        const Vectors<Arch> normal = cross(to_b, to_c);
        const F determinant = dot(normal, local.direction);
        const F inverse = F(1.0) / determinant;
        const F s = negated(dot(normal, local.start)) * inverse;
        const F error_s = F(1.25) * (U * V) * local.error_at(s, 12.0) * abs(inverse);

        // The coordinates, times the determinant: of one sign within the triangle.
        const Vectors<Arch> moment = cross(local.start, local.direction);
        const F at_c = dot(moment, to_b), at_b = negated(dot(moment, to_c));
        const F at_a = determinant - at_b - at_c;
        const F moment_error = F(2.0) * local.error_at(zero<Arch>(), 12.0);
        const F b_error = V * moment_error, c_error = U * moment_error;
        const F a_error = b_error + c_error + F(0x1p-48) * (U * V);
        const Mask<Arch> positive[] = {at_a > a_error, at_b > b_error, at_c > c_error};
        const Mask<Arch> negative[] = {at_a < negated(a_error), at_b < negated(b_error),
                                       at_c < negated(c_error)};
        const Mask<Arch> inside =
            (positive[0] & positive[1] & positive[2]) | (negative[0] & negative[1] & negative[2]);
        const Mask<Arch> outside =
            (positive[0] | positive[1] | positive[2]) & (negative[0] | negative[1] | negative[2]);
        const Mask<Arch> clear = abs(determinant) > F(0x1p-44) * (U * V);
        const F t = local.shift + s;
        Finished<Arch> result =
            finish_flat<wanted, Arch>(clear, inside, outside, t, local.error_of_t(t, s, error_s),
                                      determinant, unit<Arch>(normal), starts);
        if constexpr (wanted == Wanted::all) {
            result.misses = result.misses | is_parallel(local.direction, to_b, to_c);
            result.normal_error =
                error_of_unit<Arch>(result.normal, normal_error(to_b, to_c, normal),
                                    F(1.0) / sqrt(squared_length(normal)));
        }
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;

    /// Where that shows: of direction . (to_b x to_c), each term has a factor 0. Differences of
    /// floats are 0 only where they are so truly.
    static M is_parallel(const Vectors<Arch>& direction, const Vectors<Arch>& to_b,
                         const Vectors<Arch>& to_c) {
        const F o = zero<Arch>();
        const auto vanishes = [&](const F& along, const F& b, const F& c, const F& d, const F& e) {
            return (along == o) | (((b == o) | (c == o)) & ((d == o) | (e == o)));
        };
        return vanishes(direction.x, to_b.y, to_c.z, to_b.z, to_c.y) &
               vanishes(direction.y, to_b.z, to_c.x, to_b.x, to_c.z) &
               vanishes(direction.z, to_b.x, to_c.y, to_b.y, to_c.x);
    }

    /// Of to_b x to_c: what was lost of the products, and of the edges where these were rounded.
    /// Corners are floats, so as a rule nothing was.
    Vectors<Arch> normal_error(const Vectors<Arch>& to_b, const Vectors<Arch>& to_c,
                               const Vectors<Arch>& normal) const {
        // What a difference of floats loses in double is more than the less of them could.
        const auto is_exact = [](const F& difference, const F& from, const F& to) {
            const F back = difference + from;
            return (back == to) & (back - difference == from);
        };
        const auto all_exact = [&](const Vectors<Arch>& edge, const Vectors<Arch>& to) {
            return is_exact(edge.x, triangle.a.x, to.x) & is_exact(edge.y, triangle.a.y, to.y) &
                   is_exact(edge.z, triangle.a.z, to.z);
        };
        const F rounded = select(all_exact(to_b, triangle.b) & all_exact(to_c, triangle.c),
                                 zero<Arch>(), F(0x1p-51));
        const auto lost = [](const F& a, const F& b) {
            return abs(Lanes<Arch>::product_error(a, b, a * b));
        };
        const auto component = [&](const F& a, const F& b, const F& c, const F& d, const F& of) {
            return F(1.0 + 0x1p-50) * (lost(a, b) + lost(c, d)) + F(0x1p-53) * abs(of) +
                   rounded * (abs(a * b) + abs(c * d));
        };
        return {component(to_b.y, to_c.z, to_b.z, to_c.y, normal.x),
                component(to_b.z, to_c.x, to_b.x, to_c.z, normal.y),
                component(to_b.x, to_c.y, to_b.y, to_c.x, normal.z)};
    }
};

template <class Arch>
struct SmoothTriangleFinisher : TriangleFinisher<Arch> {
    CornerNormals<Arch> normals;

    template <class Reader>
    explicit SmoothTriangleFinisher(Reader reader)
        : TriangleFinisher<Arch>(PassOn<Arch, Reader>{reader}), normals(reader) {}

    Vectors<Arch> shading_normal(const Vectors<Arch>& point, const Vectors<Arch>& unit_flat) const {
        return normals.interpolated(this->triangle, point, unit_flat);
    }
};

} // namespace raylane::simd
