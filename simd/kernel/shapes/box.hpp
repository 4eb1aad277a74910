#pragma once

#include "simd/kernel/shapes/certified_solver.hpp"
#include "simd/kernel/shapes/enclosing.hpp"
#include "simd/kernel/shapes/slab.hpp"

namespace raylane::simd {

template <class Arch>
struct BoxNumbers {
    Vectors<Arch> corner, edge_u, edge_v, edge_w;

    template <class Reader>
    explicit BoxNumbers(Reader reader)
        : corner(next_vector<Arch>(reader)), edge_u(next_vector<Arch>(reader)),
          edge_v(next_vector<Arch>(reader)), edge_w(next_vector<Arch>(reader)) {}

    SphereAround<Arch> enclosing() const {
        const Vectors<Arch> u = half<Arch>(edge_u), v = half<Arch>(edge_v), w = half<Arch>(edge_w);
        const Floats<Arch> longest = max(max(length<Arch>(u + v + w), length<Arch>(u + v - w)),
                                         max(length<Arch>(u - v + w), length<Arch>(u - v - w)));
        return rounded_up<Arch>(corner + u + v + w, longest);
    }
};

/// Filter of a box: three slabs |n . f - volume / 2| <= |volume| / 2 for f = origin - corner, the
/// normals n = v x w, w x u, u x v, and volume = n . u.
///
/// A normal is off by 2 u of absolute_cross(), n . f by 6 u of the sum of the absolute products,
/// and half the volume by 5 u of its sum. The last counts twice: in the position and in the width.
/// The roundings that cross_slab() leaves to `error`, and that of the sum, add 3 u of n . f and 5 u
/// of half the volume. n . d is off by 6 u. Subnormal components of d were rounded by 2^-150, which
/// is u 2^-126. Sums are computed doubled or eightfold, so that they overflow before the values
/// that they bound.
template <class Arch>
struct BoxFilter {
    static constexpr bool is_costly = true;
    Vectors<Arch> corner;
    Vectors<Arch> normals[3], normal_sizes[3];
    Floats<Arch> middle, middle_error;

    template <class Reader>
    explicit BoxFilter(Reader reader) : corner(next_vector<Arch>(reader)) {
        const Floats<Arch> tiny(underflow);
        const Vectors<Arch> u = next_vector<Arch>(reader), v = next_vector<Arch>(reader),
                            w = next_vector<Arch>(reader);
        normals[0] = fast_cross(v, w);
        normals[1] = fast_cross(w, u);
        normals[2] = fast_cross(u, v);
        normal_sizes[0] = absolute_cross(v, w, tiny);
        normal_sizes[1] = absolute_cross(w, u, tiny);
        normal_sizes[2] = absolute_cross(u, v, tiny);
        middle = Floats<Arch>(0.5F) * fast_dot(normals[0], u);
        const Floats<Arch> size = fast_dot(normal_sizes[0], absolute(u));
        middle_error =
            fast_mul_add<Arch>(Floats<Arch>(0.75F * half_ulp), Floats<Arch>(8.0F) * size, tiny);
    }
    template <class Reader>
    explicit BoxFilter(Derived<Reader> reader)
        : corner(next_vector<Arch>(reader)), normals{next_vector<Arch>(reader),
                                                     next_vector<Arch>(reader),
                                                     next_vector<Arch>(reader)},
          normal_sizes{next_vector<Arch>(reader), next_vector<Arch>(reader),
                       next_vector<Arch>(reader)},
          middle(reader.next()), middle_error(reader.next()) {}
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, corner, normals[0], normals[1], normals[2], normal_sizes[0],
                   normal_sizes[1], normal_sizes[2], middle, middle_error);
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        using F = Floats<Arch>;
        const F o = zero<Arch>();
        const Vectors<Arch> from_corner = rays.origin - corner;
        const Vectors<Arch> doubled = absolute(from_corner + from_corner),
                            d = error_of<Arch>(1.0F, rays.direction, F(0x1p-126F));
        const F middle_size = abs(middle);
        const auto stay_between = [&](int i) __attribute__((always_inline)) {
            const Vectors<Arch>& size = normal_sizes[i];
            const F error = fast_mul_add<Arch>(
                F(5 * half_ulp), fast_dot(size, doubled, middle_size),
                fast_mul_add<Arch>(size.x + size.y + size.z, rays.slack, middle_error));
            const F slope_error =
                fast_mul_add<Arch>(F(7 * half_ulp), fast_dot(size, d), F(underflow));
            return cross_slab<Arch>(fast_dot(normals[i], from_corner) - middle, middle_size, error,
                                    fast_dot(normals[i], rays.direction), slope_error);
        };
        const Stay<Arch> stay = stay_between(0) & stay_between(1) & stay_between(2);
        const F lower = positive_part<Arch>(stay.in_low);
        const Mask<Arch> outside = stay.in_low > o;
        return {is_number<Arch>(from_corner.x) & ~(stay.out_high < lower),
                select(stay.inside, positive_part<Arch>(stay.out_low), lower),
                stay.definite & (stay.in_high <= stay.out_low) & (stay.out_low > o),
                select(outside, stay.in_high, stay.out_high)};
    }
};

/// Same formulas as core/shapes/box.hpp, per lane.
template <class Arch, bool>
struct BoxSolver {
    Vectors<Arch> corner, normals[3]; ///< outward where the edge coordinate is 1
    Floats<Arch> volume;              ///< > 0

    template <class Reader>
    explicit BoxSolver(Reader reader) : BoxSolver(BoxNumbers<Arch>(reader)) {}
    template <class Reader>
    explicit BoxSolver(Derived<Reader> reader)
        : corner(next_vector<Arch>(reader)), normals{next_vector<Arch>(reader),
                                                     next_vector<Arch>(reader),
                                                     next_vector<Arch>(reader)},
          volume(reader.next()) {}
    explicit BoxSolver(const BoxNumbers<Arch>& box)
        : corner(box.corner), normals{cross(box.edge_v, box.edge_w), cross(box.edge_w, box.edge_u),
                                      cross(box.edge_u, box.edge_v)},
          volume(dot(normals[0], box.edge_u)) {
        const Mask<Arch> left_handed = volume < zero<Arch>();
        for (Vectors<Arch>& normal : normals)
            normal = select(left_handed, -normal, normal);
        volume = select(left_handed, negated(volume), volume);
    }
    template <class Visit>
    void derived(const Visit& visit) const {
        visit_each(visit, corner, normals[0], normals[1], normals[2], volume);
    }

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> from_corner = rays.origin - corner;
        ClipInterval<Arch> interval;
        for (int i = 0; i < 3; ++i) {
            const Floats<Arch> position = dot(normals[i], from_corner);
            const Floats<Arch> slope = dot(normals[i], rays.direction);
            const float low = static_cast<float>(2 * i), high = static_cast<float>(2 * i + 1);
            interval.clip_slab(~starts.on_surface, position, slope, volume, low, high);
            const Mask<Arch> rises =
                starts.on_surface & (slope > zero<Arch>()) & (starts.face != constant<Arch>(high));
            const Mask<Arch> falls =
                starts.on_surface & (slope < zero<Arch>()) & (starts.face != constant<Arch>(low));
            interval.clip_back(rises, (volume - position) / slope, constant<Arch>(high));
            interval.clip_back(falls, negated(position) / slope, constant<Arch>(low));
        }
        return inward_only(interval.crossings(starts.on_surface), starts);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>& face) const {
        const auto is = [&](float f) { return face == constant<Arch>(f); };
        const Vectors<Arch> unit = normalized(
            select(is(0) | is(1), normals[0], select(is(2) | is(3), normals[1], normals[2])));
        const Mask<Arch> through_corner = is(0) | is(2) | is(4);
        return select(through_corner, -unit, unit);
    }
};

/// CertifiedSolver of a box: three slabs 0 <= normal . p <= volume. A ray crosses the boundary of a
/// convex solid only once in each direction. So if it crosses the plane of a face in one direction,
/// certainly within the other two slabs, it enters or leaves the box there.
///
/// With N = |v|_1 |w|_1 >= |v x w|, normal . at(s) errs by N times the error of the position and
/// 10 u (|start| + |s|), normal . direction by 8 u N, and the volume by 12 u |u|_1 |v|_1 |w|_1.
template <class Arch>
struct BoxCertifiedSolver {
    BoxNumbers<Arch> box;

    template <class Reader>
    explicit BoxCertifiedSolver(Reader reader) : box(reader) {}

    template <Wanted wanted>
    CertifiedCrossing<Arch> solve(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Slabs slabs(box, rays);
        CertifiedCrossing<Arch> result = slabs.pass(starts.on_surface, starts);
        const Mask<Arch> behind =
            result.certain & ~starts.on_surface & (result.t < negated(result.error));
        if (any<Arch>(behind))
            result = select(behind, slabs.pass(starts.on_surface | behind, starts), result);
        result.certain = result.certain & (~starts.on_surface | starts.inward) &
                         is_result<Arch>(result.t, result.error);
        if constexpr (wanted == Wanted::all) {
            result.normal_error = normal_error(result);
            const Mask<Arch> uncertain = ~result.certain & ~starts.on_surface;
            if (any<Arch>(uncertain)) result.misses = uncertain & slabs.passed(starts);
        }
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;

    Vectors<Arch> normal_error(const CertifiedCrossing<Arch>& result) const {
        const M first = result.face<F(2.0), last = result.face> F(3.0);
        const Vectors<Arch> one =
            select<Arch>(first, box.edge_v, select<Arch>(last, box.edge_u, box.edge_w));
        const Vectors<Arch> other =
            select<Arch>(first, box.edge_w, select<Arch>(last, box.edge_v, box.edge_u));
        const Vectors<Arch> normal = cross(one, other);
        return error_of_unit<Arch>(result.normal, error_of_cross<Arch>(one, other, normal),
                                   F(1.0) / sqrt(squared_length(normal)));
    }

    struct Slabs {
        LocalRays<Arch> local;
        Vectors<Arch> normals[3]; ///< outward at the far faces
        F sizes[3];               ///< N
        F position[3], slope[3];
        F volume, volume_error;
        M left_handed;

        Slabs(const BoxNumbers<Arch>& box, const Rays<Arch>& rays) : local(rays, box.corner) {
            const F U = sum_of_sizes(box.edge_u), V = sum_of_sizes(box.edge_v),
                    W = sum_of_sizes(box.edge_w);
            normals[0] = cross(box.edge_v, box.edge_w);
            normals[1] = cross(box.edge_w, box.edge_u);
            normals[2] = cross(box.edge_u, box.edge_v);
            sizes[0] = V * W;
            sizes[1] = W * U;
            sizes[2] = U * V;
            const F signed_volume = dot(normals[0], box.edge_u);
            volume = abs(signed_volume);
            volume_error = F(0x1p-49) * (U * sizes[0]);
            left_handed = signed_volume < zero<Arch>();
            for (int i = 0; i < 3; ++i) {
                normals[i] = negated_where<Arch>(left_handed, normals[i]);
                position[i] = dot(normals[i], local.start);
                slope[i] = dot(normals[i], local.direction);
            }
        }

        /// True where the line certainly leaves one slab before it enters another, or before the
        /// ray starts.
        M passed(const Starts<Arch>& starts) const {
            M in_known, out_known;
            const CertifiedCrossing<Arch> in = pass(none<Arch>(), starts, &in_known),
                                          out = pass(all<Arch>(), starts, &out_known);
            return (in_known & out_known & (in.t - in.error > out.t + out.error)) |
                   (out_known & (out.t < negated(out.error)));
        }

        /// Returns the crossing where the ray leaves, in lanes of `leaves`, and where it enters, in
        /// the others. `known`: lanes whose t is that of the slab which is the last to be entered,
        /// or the first to be left, even if this crossing is not inside the others.
        CertifiedCrossing<Arch> pass(const M& leaves, const Starts<Arch>& starts,
                                     M* known = nullptr) const {
            // The last plane to be entered, or the first to be left.
            F s(0.0), face(0.0);
            F best_slope(0.0), best_size(0.0);
            Vectors<Arch> normal = normals[0];
            M any_yet = none<Arch>();
            M chosen[3];
            for (int i = 0; i < 3; ++i) {
                const M rises = slope[i] > zero<Arch>(), falls = slope[i] < zero<Arch>();
                const M is_far = (rises & leaves) | (falls & ~leaves);
                const F plane = select(is_far, volume, zero<Arch>());
                const F at = (plane - position[i]) / slope[i];
                const F at_face = select(is_far, F(2.0 * i + 1.0), F(2.0 * i));
                const M left_behind = starts.on_surface & (at_face == starts.face);
                const M sooner = (leaves & (at < s)) | (~leaves & (at > s));
                chosen[i] = (rises | falls) & ~left_behind & (sooner | ~any_yet);
                any_yet = any_yet | chosen[i];
                s = select(chosen[i], at, s);
                face = select(chosen[i], at_face, face);
                best_slope = select(chosen[i], slope[i], best_slope);
                best_size = select(chosen[i], sizes[i], best_size);
                normal = select<Arch>(chosen[i], negated_where<Arch>(~is_far, normals[i]), normal);
            }
            chosen[1] = chosen[1] & ~chosen[2];
            chosen[0] = chosen[0] & ~chosen[1] & ~chosen[2];

            const F position_error = local.error_at(s, 16.0);
            const F error_s =
                F(1.25) * (best_size * position_error + volume_error) / abs(best_slope);
            M within = any_yet;
            for (int i = 0; i < 3; ++i) {
                const F at = mul_add<Arch>(s, slope[i], position[i]);
                const F margin = sizes[i] * (position_error + error_s) + volume_error;
                within = within & (chosen[i] | ((at > margin) & (volume - at > margin)));
            }
            const F t = local.shift + s;
            const M clear =
                (volume > F(4.0) * volume_error) & (abs(best_slope) > F(0x1p-44) * best_size);
            if (known != nullptr) *known = any_yet & clear;
            return {within & clear, t,       local.error_of_t(t, s, error_s),
                    face,           ~leaves, unit<Arch>(normal)};
        }
    };
};

template <>
struct ShapeKernels<core::Box>
    : ShapeKernelsOf<BoxNumbers, BoxFilter, BoxSolver, BoxCertifiedSolver> {};

} // namespace raylane::simd
