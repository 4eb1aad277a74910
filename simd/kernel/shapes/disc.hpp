#pragma once

#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/flat.hpp"

namespace raylane::simd {

template <class Arch>
struct DiscNumbers {
    Vectors<Arch> center, normal;
    Floats<Arch> radius;

    template <class Reader>
    explicit DiscNumbers(Reader reader)
        : center(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)),
          radius(reader.next()) {}

    SphereAround<Arch> enclosing() const { return rounded_up<Arch>(center, radius); }
};

/// Filter of a disc, with u as in filter.hpp. The ray meets the plane within spread + 6 * u * |t|
/// of t, so the point at t is off by as much. With f = origin - center, where |f| <= |t| +
/// distance, that point is also off by
///   slack + u * |f|         for the origin relative to the centre,
///   u * |t|                 for the direction,
///   u * (|t| + distance)    for the rounding of the point itself.
/// Squaring and comparing matter only near the radius and add 4 * u * radius. Without slack and
/// spread, the sum is 9 * u * |t| + 6 * u * radius.
template <class Arch>
struct DiscFilter : DiscNumbers<Arch> {
    using Numbers = DiscNumbers<Arch>;
    using Numbers::Numbers, Numbers::center, Numbers::normal, Numbers::radius;
    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const Vectors<Arch> to_center = center - rays.origin;
        const FlatCrossing<Arch> crossing = cross_plane(to_center, normal, rays);
        const Vectors<Arch> point = fast_mul_add<Arch>(crossing.t, rays.direction, -to_center);
        const F distance_squared = fast_dot(point, point);
        const F error = fast_mul_add<Arch>(F(12 * half_ulp), abs(crossing.t) + radius,
                                           rays.slack + crossing.spread);
        const F outer = radius + error, inner = radius - error;
        const Mask<Arch> outside = crossing.clear & (distance_squared > outer * outer);
        const Mask<Arch> inside = (inner > zero<Arch>()) & (distance_squared < inner * inner);
        return {is_number<Arch>(to_center.x) & ~crossing.behind & ~outside,
                positive_part<Arch>(crossing.lower), crossing.ahead & inside, crossing.upper};
    }
};

template <class Arch, bool>
struct DiscSolver : DiscNumbers<Arch> {
    using Numbers = DiscNumbers<Arch>;
    using Numbers::Numbers, Numbers::center, Numbers::normal, Numbers::radius;
    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> to_center = center - rays.origin;
        Crossing<Arch> crossing = cross_plane(to_center, normal, rays.direction);
        const Vectors<Arch> from_center = mul_add<Arch>(crossing.t, rays.direction, -to_center);
        const Mask<Arch> outside = radius * radius < squared_length(from_center);
        crossing.exists = crossing.exists & ~outside & ~starts.on_surface;
        return only(crossing);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>&) const {
        return normalized(normal);
    }
};

/// CertifiedSolver of a disc, with u as in certified solver.hpp. Let approach be normal .
/// direction, and N a bound on |normal|. The product normal . at(s) is off by N times
/// local.error_at(s, 8), which is the error of the position, plus 6 * u * (|start| + |s|) for the
/// roundings of the product. approach is off by 5 * u * N, which is less than a fifth of |approach|
/// where `clear`. So the true divisor is at least 4/5 * |approach|, and s is off by at most
///   5/4 * N * error_at(s, 8) / |approach|.
template <class Arch>
struct DiscCertifiedSolver {
    DiscNumbers<Arch> disc;

    template <class Reader>
    explicit DiscCertifiedSolver(Reader reader) : disc(reader) {}

    template <Wanted wanted>
    [[gnu::always_inline]] CertifiedCrossing<Arch> solve(const Rays<Arch>& rays,
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

        // p = at(s) is off by `off`. So where |p| <= radius, |p|^2 is off by 2 * radius * off +
        // off^2 and, by rounding, 6 * u * radius^2.
        const F off = position_error + error_s, reach = radius + off;
        const F squared = squared_length(local.at(s));
        const Mask<Arch> clear = abs(approach) > F(0x1p-44) * N;
        const Mask<Arch> inside =
            radius * radius - squared > radius * (F(3.0) * off + F(0x1p-49) * radius);
        const Mask<Arch> outside = squared > (reach * reach) * F(1.0 + 0x1p-48);
        const F t = local.shift + s;
        const Mask<Arch> passed = (clear & outside) | have_no_product(disc.normal, local.direction);
        return solve_flat<wanted, Arch>(clear, inside, passed, t, local.error_of_t(t, s, error_s),
                                        approach, unit<Arch>(disc.normal), starts);
    }
};

template <>
struct ShapeKernels<core::Disc>
    : ShapeKernelsOf<DiscNumbers, DiscFilter, DiscSolver, DiscCertifiedSolver> {};

} // namespace raylane::simd
