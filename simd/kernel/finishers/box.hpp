#pragma once

#include "simd/kernel/finishers/finisher.hpp"
#include "simd/kernel/solvers/box.hpp"

namespace raylane::simd {

/// Three slabs 0 <= normal . p <= volume. The ray crosses the boundary of a convex solid just once
/// in each direction; so where it crosses the plane of a face in one direction, certainly within
/// the other two slabs, that is where it enters, or leaves.
///
/// With N = |v|_1 |w|_1 >= |v x w|, normal . at(s) errs by N times the error of the position and 10
/// u
/// (|start| + |s|), normal . direction by 8 u N, the volume by 12 u |u|_1 |v|_1 |w|_1.
template <class Arch>
struct BoxFinisher {
    BoxLanes<Arch> box;

    template <class Reader>
    explicit BoxFinisher(Reader reader) : box(reader) {}

    template <Wanted wanted>
    Finished<Arch> finish(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Slabs slabs(box, rays);
        Finished<Arch> result = slabs.pass(starts.on_surface, starts);
        const Mask<Arch> behind =
            result.certain & ~starts.on_surface & (result.t < negated(result.error));
        if (any<Arch>(behind))
            result = select(behind, slabs.pass(starts.on_surface | behind, starts), result);
        result.certain = result.certain & (~starts.on_surface | starts.inward) &
                         is_result<Arch>(result.t, result.error);
        if constexpr (wanted == Wanted::all) {
            // Edges are floats, so their products are exact and the normal is rounded once.
            result.normal_error = error_of_unit<Arch>(result.normal);
            const Mask<Arch> uncertain = ~result.certain & ~starts.on_surface;
            if (any<Arch>(uncertain)) result.misses = uncertain & slabs.passed(starts);
        }
        return result;
    }

  private:
    using F = Floats<Arch>;
    using M = Mask<Arch>;

    struct Slabs {
        LocalRays<Arch> local;
        Vectors<Arch> normals[3]; ///< outward at the far faces
        F sizes[3];               ///< N
        F position[3], slope[3];
        F volume, volume_error;
        M left_handed;

        Slabs(const BoxLanes<Arch>& box, const Rays<Arch>& rays) : local(rays, box.corner) {
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

        /// Whether the line surely leaves one slab before it enters another, or all of them before
        /// it starts.
        M passed(const Starts<Arch>& starts) const {
            M in_known, out_known;
            const Finished<Arch> in = pass(none<Arch>(), starts, &in_known),
                                 out = pass(all<Arch>(), starts, &out_known);
            return (in_known & out_known & (in.t - in.error > out.t + out.error)) |
                   (out_known & (out.t < negated(out.error)));
        }

        /// Where the ray leaves, or else enters. `known`: where its t is that of the slab which is
        /// the last to be entered, or the first to be left, whether or not it is inside of the
        /// others.
        Finished<Arch> pass(const M& leaves, const Starts<Arch>& starts, M* known = nullptr) const {
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
                const M departed = starts.on_surface & (at_face == starts.face);
                const M sooner = (leaves & (at < s)) | (~leaves & (at > s));
                chosen[i] = (rises | falls) & ~departed & (sooner | ~any_yet);
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

} // namespace raylane::simd
