#pragma once

#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/flat.hpp"

namespace raylane::simd {

template <class Arch>
struct TriangleNumbers {
    Vectors<Arch> a, b, c;

    template <class Reader>
    explicit TriangleNumbers(Reader reader)
        : a(next_vector<Arch>(reader)), b(next_vector<Arch>(reader)), c(next_vector<Arch>(reader)) {
    }

    SphereAround<Arch> enclosing() const {
        const Vectors<Arch> center = half<Arch>(a + half<Arch>(b + c));
        return rounded_up<Arch>(center, max(max(length<Arch>(a - center), length<Arch>(b - center)),
                                            length<Arch>(c - center)));
    }
};

/// Corner normals of a smooth triangle.
template <class Arch>
struct CornerNormals {
    Vectors<Arch> a, b, c;

    template <class Reader>
    explicit CornerNormals(Reader& reader)
        : a(next_vector<Arch>(reader)), b(next_vector<Arch>(reader)), c(next_vector<Arch>(reader)) {
    }

    /// Same as core::shading_normal, per lane.
    Vectors<Arch> interpolated(const TriangleNumbers<Arch>& triangle, const Vectors<Arch>& point,
                               const Vectors<Arch>& unit_flat) const {
        const Vectors<Arch> to_a = triangle.a - point, to_b = triangle.b - point,
                            to_c = triangle.c - point;
        const auto share = [&](const Vectors<Arch>& p, const Vectors<Arch>& q,
                               const Vectors<Arch>& normal) {
            return scaled(dot(unit_flat, cross(p, q)), unit(normal));
        };
        const Vectors<Arch> sum =
            share(to_b, to_c, a) + share(to_c, to_a, b) + share(to_a, to_b, c);
        const Floats<Arch> square = squared_length(sum);
        return select<Arch>(square > zero<Arch>(), sum / sqrt(square), unit_flat);
    }
};

/// Filter of a triangle, with u as in filter.hpp. Let e = b - a and g = c - a be edges, n = e x g
/// the normal, s = a - origin, and d the direction. The ray meets the point a + v * e + w * g at t
/// if t * d = s + v * e + w * g. So (Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle
/// Intersection", 1997)
///   t * (n . d) = n . s,  v * (n . d) = g . (s x d),  w * (n . d) = -e . (s x d).
///
/// n is off by 4 * u * absolute_cross(e, g). So n . s and n . d are off by 8 * u times the sum of
/// the absolute products. s x d is off by 4 * u * absolute_cross(s, d), and its products with edges
/// by 8 * u times the sum of theirs. If the origin is off by slack, the products with an edge are
/// off by at most slack * |edge|. Taking 11 * u instead of 8 * u also covers the sum 1 - v - w.
/// Subnormal components of d were rounded by 2^-150, which is u * 2^-126.
template <class Arch>
struct TriangleFilter {
    Vectors<Arch> a, edge_e, edge_g, normal, normal_size;

    template <class Reader>
    explicit TriangleFilter(Reader reader) : a(next_vector<Arch>(reader)) {
        edge_e = next_vector<Arch>(reader) - a;
        edge_g = next_vector<Arch>(reader) - a;
        normal = fast_cross(edge_e, edge_g);
        normal_size = absolute_cross(edge_e, edge_g, Floats<Arch>(underflow));
    }
    template <class Reader>
    explicit TriangleFilter(Derived<Reader> reader)
        : a(next_vector<Arch>(reader)), edge_e(next_vector<Arch>(reader)),
          edge_g(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)),
          normal_size(next_vector<Arch>(reader)) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, a, edge_e, edge_g, normal, normal_size);
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F tiny(underflow);
        const Vectors<Arch> to_a = a - rays.origin;
        const F relative(11 * half_ulp);
        const Vectors<Arch> d_size = error_of<Arch>(1.0F, rays.direction, F(0x1p-126F));
        const F height = fast_dot(normal, to_a);
        const F height_error = fast_mul_add<Arch>(
            relative, fast_dot(normal_size, absolute(to_a)),
            fast_mul_add<Arch>(normal_size.x + normal_size.y + normal_size.z, rays.slack, tiny));
        const F approach = fast_dot(normal, rays.direction);
        const F approach_error = fast_mul_add<Arch>(relative, fast_dot(normal_size, d_size), tiny);
        const FlatCrossing<Arch> crossing(height, height_error, approach, approach_error);

        // v, w and -(1 - v - w), times |approach| = |n . d|.
        const Vectors<Arch> moment = fast_cross(to_a, rays.direction);
        const Vectors<Arch> moment_size = absolute_cross(to_a, d_size, zero<Arch>());
        const auto error_along = [&](const Vectors<Arch>& edge) __attribute__((always_inline)) {
            const Vectors<Arch> e = absolute(edge);
            return fast_mul_add<Arch>(relative, fast_dot(e, moment_size),
                                      fast_mul_add<Arch>(e.x + e.y + e.z, rays.slack, tiny));
        };
        const F flip = sign_bit<Arch>(approach);
        const F v = fast_dot(edge_g, moment) ^ flip;
        const F w = negated(fast_dot(edge_e, moment)) ^ flip;
        const F v_error = error_along(edge_g);
        const F w_error = error_along(edge_e);
        const F steepness = abs(approach);
        const F beyond = (v + w) - steepness;
        const F beyond_error = v_error + w_error + approach_error;

        const Mask<Arch> faces = steepness > approach_error;
        const Mask<Arch> outside =
            faces & ((v < negated(v_error)) | (w < negated(w_error)) | (beyond > beyond_error));
        const Mask<Arch> inside = (v > v_error) & (w > w_error) & (beyond < negated(beyond_error));
        return {is_number<Arch>(to_a.x) & ~crossing.behind & ~outside,
                positive_part<Arch>(crossing.lower), crossing.ahead & inside, crossing.upper};
    }
};

template <class Arch, bool>
struct TriangleSolver : TriangleNumbers<Arch> {
    using Numbers = TriangleNumbers<Arch>;
    using Numbers::Numbers, Numbers::a, Numbers::b, Numbers::c;
    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> to_a = a - rays.origin, to_b = b - rays.origin, to_c = c - rays.origin;
        const Floats<Arch> u = dot(rays.direction, cross(to_c, to_b));
        const Floats<Arch> v = dot(rays.direction, cross(to_a, to_c));
        const Floats<Arch> w = dot(rays.direction, cross(to_b, to_a));
        const Floats<Arch> o = zero<Arch>();
        const Mask<Arch> some_negative = (u < o) | (v < o) | (w < o);
        const Mask<Arch> some_positive = (u > o) | (v > o) | (w > o);
        const Mask<Arch> inside =
            (some_negative & ~some_positive) | (some_positive & ~some_negative);
        Crossing<Arch> crossing =
            cross_plane(to_a, cross(to_b - to_a, to_c - to_a), rays.direction);
        crossing.exists = crossing.exists & inside & ~starts.on_surface;
        return only(crossing);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>&) const {
        return normalized(cross(b - a, c - a));
    }
};

template <class Arch, bool>
struct SmoothTriangleSolver : TriangleSolver<Arch, false> {
    CornerNormals<Arch> normals;

    template <class Reader>
    explicit SmoothTriangleSolver(Reader reader)
        : TriangleSolver<Arch, false>(PassOn<Arch, Reader>{reader}), normals(reader) {}

    Vectors<Arch> shading_normal(const Vectors<Arch>& point, const Vectors<Arch>& unit_flat) const {
        return normals.interpolated(*this, point, unit_flat);
    }
};

/// CertifiedSolver of a triangle, with u as in certified solver.hpp. The barycentric coordinates,
/// multiplied by the determinant normal . direction, follow from one cross product of start and
/// direction (Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997). Let U
/// and V be bounds on |b - a| and |c - a|. The normal is off by 5 * u * U * V, and its product with
/// a vector by 10 * u * U * V times the length of that vector. The coordinates of c and b are off
/// by U and V times the sum of the error of the start and 10 * u * |start|. The code doubles that
/// sum as a margin.
template <class Arch>
struct TriangleCertifiedSolver {
    TriangleNumbers<Arch> triangle;

    template <class Reader>
    explicit TriangleCertifiedSolver(Reader reader) : triangle(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] CertifiedCrossing<Arch> solve(const Rays<Arch>& rays,
                                                         const Starts<Arch>& starts) const {
        const LocalRays<Arch> local(rays, triangle.a);
        const Vectors<Arch> to_b = triangle.b - triangle.a, to_c = triangle.c - triangle.a;
        const F U = sum_of_sizes(to_b), V = sum_of_sizes(to_c);
        const Vectors<Arch> normal = cross(to_b, to_c);
        const F determinant = dot(normal, local.direction);
        const F inverse = F(1.0) / determinant;
        const F s = negated(dot(normal, local.start)) * inverse;
        const F error_s = F(1.25) * (U * V) * local.error_at(s, 12.0) * abs(inverse);

        // The barycentric coordinates times the determinant. All three have the same sign inside of
        // the triangle.
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
        CertifiedCrossing<Arch> result =
            solve_flat<wanted, Arch>(clear, inside, outside, t, local.error_of_t(t, s, error_s),
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

    /// True where each term of direction . (to_b x to_c) has a factor 0. This proves that the ray
    /// is parallel to the plane of the triangle. Differences of floats are 0 only if they are
    /// exactly 0.
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

    /// Returns the error of to_b x to_c. It is the error of the products and, if the edges to_b and
    /// to_c were rounded, that of the edges. With corners that are floats, usually both errors are
    /// 0.
    Vectors<Arch> normal_error(const Vectors<Arch>& to_b, const Vectors<Arch>& to_c,
                               const Vectors<Arch>& normal) const {
        // The rounding error of a sum is a double, and Knuth's 2Sum computes it.
        const auto is_exact = [](const F& difference, const F& from, const F& to) {
            const F back = difference - to;
            return (to - (difference - back)) - (from + back) == zero<Arch>();
        };
        const auto all_exact = [&](const Vectors<Arch>& edge, const Vectors<Arch>& to) {
            return is_exact(edge.x, triangle.a.x, to.x) & is_exact(edge.y, triangle.a.y, to.y) &
                   is_exact(edge.z, triangle.a.z, to.z);
        };
        const F rounded = select(all_exact(to_b, triangle.b) & all_exact(to_c, triangle.c),
                                 zero<Arch>(), F(0x1p-51));
        const Vectors<Arch> lost = error_of_cross<Arch>(to_b, to_c, normal);
        const auto component = [&](const F& a, const F& b, const F& c, const F& d, const F& from) {
            return from + rounded * (abs(a * b) + abs(c * d));
        };
        return {component(to_b.y, to_c.z, to_b.z, to_c.y, lost.x),
                component(to_b.z, to_c.x, to_b.x, to_c.z, lost.y),
                component(to_b.x, to_c.y, to_b.y, to_c.x, lost.z)};
    }
};

template <class Arch>
struct SmoothTriangleCertifiedSolver : TriangleCertifiedSolver<Arch> {
    CornerNormals<Arch> normals;

    template <class Reader>
    explicit SmoothTriangleCertifiedSolver(Reader reader)
        : TriangleCertifiedSolver<Arch>(PassOn<Arch, Reader>{reader}), normals(reader) {}

    Vectors<Arch> shading_normal(const Vectors<Arch>& point, const Vectors<Arch>& unit_flat) const {
        return normals.interpolated(this->triangle, point, unit_flat);
    }
};

template <>
struct ShapeKernels<core::Triangle>
    : ShapeKernelsOf<TriangleNumbers, TriangleFilter, TriangleSolver, TriangleCertifiedSolver> {};

template <>
struct ShapeKernels<core::SmoothTriangle>
    : ShapeKernelsOf<TriangleNumbers, TriangleFilter, SmoothTriangleSolver,
                     SmoothTriangleCertifiedSolver> {};

} // namespace raylane::simd
