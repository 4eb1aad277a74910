#pragma once

#include "simd/kernel/trace/rays.hpp"
#include "simd/kernel/trace/spheres_around.hpp"

namespace raylane::simd {

/// Up to 256 rays through one point, or in one direction, and what surely misses all of them.
///
/// One coordinate k counts along the rays. With w = p - apex, a point on a ray has w_a - u w_k =
/// offset, for each other coordinate a, with slopes u and offsets of the ray's: through a point,
/// the offsets are 0, in one direction, the slopes are the same. The group is what lies between the
/// least and the greatest of these; so is each of its sixteen bunches of 16 consecutive rays, which
/// are lanes here.
///
/// Roundings are a few u of |w_a| + |u w_k| + |offset|; `grace` grants 16 u of the sizes of w, and
/// as slopes are at most 4, twice that of the rest.
template <class Arch>
struct Group : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    static constexpr std::size_t most_rays = 256;
    static constexpr float steepest = 4.0F;

    /// A side of the group in all lanes, or of bunches, one per lane.
    struct SideLanes {
        F slope, offset, norm;
    };

    /// Of the rays on one side: w_a - slope w_k > offset is outside, or < for the other side.
    struct Side {
        float slope, offset, norm;
        float slopes[16], offsets[16], norms[16]; // of the bunches

        SideLanes of_group() const { return {F(slope), F(offset), F(norm)}; }
        SideLanes of_bunches(std::size_t from) const {
            return {S::load(slopes + from), S::load(offsets + from), S::load(norms + from)};
        }
    };

    float apex[3];
    float slack;
    int along;          ///< k
    int across[2];      ///< the other coordinates
    float sense;        ///< of the rays along k: 1 or -1
    float least_w;      ///< of sense * w_k: what comes before is behind all rays
    float greatest_w;   ///< and what comes after this is beyond them
    float fastest;      ///< the largest |d_k|
    float latest_start; ///< sense * w_k of the last origin
    Side above[2], below[2];
    std::size_t bunches;

    /// For rays from or to `apex`; of rays in one direction it is any point near them. Returns
    /// whether the rays are coherent enough.
    bool enclose(const RoundedRays& rays, std::size_t begin, std::size_t end, Bundle bundle,
                 const float* t_most) {
        bunches = (end - begin + 15) / 16;
        for (int axis = 0; axis < 3; ++axis)
            apex[axis] = bundle.parallel ? rays.origin[axis][begin] : bundle.apex[axis];
        slack = half_ulp * (size(apex[0]) + size(apex[1]) + size(apex[2]));
        F most_slack = zero<Arch>();
        choose_axes(rays, begin, end, bundle.towards);

        fastest = 0.0F;
        least_w = bundle.towards ? 0.0F : __builtin_inff();
        greatest_w = bundle.towards && t_most != nullptr ? 0.0F : __builtin_inff();
        // Towards the apex, what is far from it is near.
        const bool anywhere = bundle.parallel || bundle.beyond; // they start
        latest_start = anywhere ? -__builtin_inff() : bundle.towards ? __builtin_inff() : 0.0F;
        if (!bundle.towards && !anywhere) least_w = 0.0F;
        float slowest = 1.0F;
        for (int side = 0; side < 2; ++side) {
            above[side].slope = above[side].offset = -__builtin_inff();
            below[side].slope = below[side].offset = __builtin_inff();
        }
        for (std::size_t bunch = 0; bunch < 16; ++bunch) {
            const std::size_t from = begin + 16 * bunch;
            if (from >= end) {
                for (int side = 0; side < 2; ++side) {
                    above[side].slopes[bunch] = below[side].slopes[bunch] = 0.0F;
                    above[side].offsets[bunch] = -__builtin_inff(); // outside, whatever it is
                    below[side].offsets[bunch] = __builtin_inff();
                    above[side].norms[bunch] = below[side].norms[bunch] = 0.0F;
                }
                continue;
            }
            F low_slope[2] = {S::infinity(), S::infinity()}, high_slope[2];
            F low_offset[2] = {S::infinity(), S::infinity()}, high_offset[2];
            for (int side = 0; side < 2; ++side)
                high_slope[side] = high_offset[side] = negated(S::infinity());
            F speeds_low = S::infinity(), speeds_high = zero<Arch>();
            F starts_low = S::infinity(), starts_high = negated(S::infinity());
            F ends_high = zero<Arch>();
            for (std::size_t i = from; i < from + 16; i += F::size) {
                if (i >= end) break;
                const M here = S::first_lanes(end - i);
                most_slack = xsimd::max(most_slack,
                                        xsimd::select(here, S::load(rays.slack + i), zero<Arch>()));
                const F d = F(bundle.towards ? -sense : sense) * S::load(rays.direction[along] + i);
                speeds_low = xsimd::min(speeds_low, xsimd::select(here, d, S::infinity()));
                speeds_high = xsimd::max(speeds_high, xsimd::select(here, d, zero<Arch>()));
                const F start = F(sense) * (S::load(rays.origin[along] + i) - F(apex[along]));
                starts_low = xsimd::min(starts_low, xsimd::select(here, start, S::infinity()));
                starts_high =
                    xsimd::max(starts_high, xsimd::select(here, start, negated(S::infinity())));
                if (t_most != nullptr && bundle.towards)
                    ends_high = xsimd::max(
                        ends_high, xsimd::select(here, d * S::load(t_most + i), zero<Arch>()));
                for (int side = 0; side < 2; ++side) {
                    const int a = across[side];
                    const F slope =
                        S::load(rays.direction[a] + i) / S::load(rays.direction[along] + i);
                    low_slope[side] =
                        xsimd::min(low_slope[side], xsimd::select(here, slope, S::infinity()));
                    high_slope[side] = xsimd::max(
                        high_slope[side], xsimd::select(here, slope, negated(S::infinity())));
                    if (!bundle.parallel) continue;
                    const F offset = (S::load(rays.origin[a] + i) - F(apex[a])) -
                                     slope * (S::load(rays.origin[along] + i) - F(apex[along]));
                    low_offset[side] =
                        xsimd::min(low_offset[side], xsimd::select(here, offset, S::infinity()));
                    high_offset[side] = xsimd::max(
                        high_offset[side], xsimd::select(here, offset, negated(S::infinity())));
                }
            }
            slowest = least(slowest, Lanes<Arch>::least(speeds_low));
            fastest = greatest(fastest, Lanes<Arch>::greatest(speeds_high));
            if (anywhere) {
                least_w = least(least_w, Lanes<Arch>::least(starts_low));
                latest_start = greatest(latest_start, Lanes<Arch>::greatest(starts_high));
            }
            if (bundle.towards && t_most != nullptr)
                greatest_w = greatest(greatest_w, Lanes<Arch>::greatest(ends_high));
            for (int side = 0; side < 2; ++side) {
                const float low = Lanes<Arch>::least(low_slope[side]);
                const float high = Lanes<Arch>::greatest(high_slope[side]);
                // Seen against the coordinate's sense the greater slope bounds from below.
                set(above[side], bunch, sense > 0.0F ? high : low,
                    bundle.parallel ? Lanes<Arch>::greatest(high_offset[side]) : 0.0F);
                set(below[side], bunch, sense > 0.0F ? low : high,
                    bundle.parallel ? Lanes<Arch>::least(low_offset[side]) : 0.0F);
            }
        }
        slack += Lanes<Arch>::greatest(most_slack);
        for (int side = 0; side < 2; ++side)
            enclose_bunches(side);
        bool coherent = slowest > 0.0F;
        for (int side = 0; side < 2; ++side)
            coherent = coherent && size(above[side].slope) < steepest &&
                       size(below[side].slope) < steepest;
        return coherent;
    }

    static std::size_t lesser(std::size_t a, std::size_t b) { return a < b ? a : b; }
    static float least(float a, float b) { return a < b ? a : b; }
    static float greatest(float a, float b) { return a > b ? a : b; }
    static float size(float a) { return __builtin_fabsf(a); }

    /// The largest component of the first direction that all rays share.
    void choose_axes(const RoundedRays& rays, std::size_t begin, std::size_t end, bool towards) {
        const std::size_t middle = begin + (end - begin) / 2;
        along = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (size(rays.direction[axis][middle]) > size(rays.direction[along][middle]))
                along = axis;
        across[0] = (along + 1) % 3;
        across[1] = (along + 2) % 3;
        sense = (rays.direction[along][middle] > 0.0F) != towards ? 1.0F : -1.0F;
    }

    static void set(Side& side, std::size_t bunch, float slope, float offset) {
        side.slopes[bunch] = slope;
        side.offsets[bunch] = offset;
        side.norms[bunch] = norm_above(slope);
    }

    /// At least sqrt(1 + slope^2).
    static float norm_above(float slope) { return 1.0F + 0.5F * slope * slope; }

    void enclose_bunches(int side) {
        Side &high = above[side], &low = below[side];
        const bool forwards = sense > 0.0F;
        high.slope = low.slope = high.slopes[0];
        high.offset = high.offsets[0];
        low.slope = low.slopes[0];
        low.offset = low.offsets[0];
        for (std::size_t bunch = 1; bunch < bunches; ++bunch) {
            high.slope = forwards ? greatest(high.slope, high.slopes[bunch])
                                  : least(high.slope, high.slopes[bunch]);
            low.slope = forwards ? least(low.slope, low.slopes[bunch])
                                 : greatest(low.slope, low.slopes[bunch]);
            high.offset = greatest(high.offset, high.offsets[bunch]);
            low.offset = least(low.offset, low.offsets[bunch]);
        }
        high.norm = norm_above(high.slope);
        low.norm = norm_above(low.slope);
    }

    /// What roundings may add up to at a distance of w along and across.
    F grace(const F& w_along, const F& w_across) const {
        return F(2 * steepest * 16 * half_ulp) * (xsimd::abs(w_along) + xsimd::abs(w_across)) +
               F(8 * steepest * slack);
    }

    /// The boxes of a node that the group may meet, and the least t at which.
    std::uint32_t enter(const NodeView& node, int from, const F& t_most, F& near) const {
        const F apex_along(apex[along]);
        const F lower_k = S::load(node.lower[along] + from) - apex_along;
        const F upper_k = S::load(node.upper[along] + from) - apex_along;
        const F reach_k = xsimd::max(xsimd::abs(lower_k), xsimd::abs(upper_k));
        const F first_w = sense > 0.0F ? lower_k : negated(upper_k);
        const F last_w = sense > 0.0F ? upper_k : negated(lower_k);
        const F grace_k = grace(reach_k, zero<Arch>());
        M meets = (last_w + grace_k >= F(least_w)) & (first_w - grace_k <= F(greatest_w));
        for (int side = 0; side < 2; ++side) {
            const int a = across[side];
            const F apex_across(apex[a]);
            const F lower = S::load(node.lower[a] + from) - apex_across;
            const F upper = S::load(node.upper[a] + from) - apex_across;
            const F room = grace(reach_k, xsimd::max(xsimd::abs(lower), xsimd::abs(upper)));
            const Side &high = above[side], &low = below[side];
            const F least_above = lower - F(high.slope) * (high.slope > 0.0F ? upper_k : lower_k);
            const F most_below = upper - F(low.slope) * (low.slope > 0.0F ? lower_k : upper_k);
            meets = meets & (least_above - room <= F(high.offset)) &
                    (most_below + room >= F(low.offset));
        }
        near = near_t(first_w - grace_k);
        return Lanes<Arch>::bits(meets & (near <= t_most)) & S::filled(node, from);
    }

    /// From how far along to a lower bound of t.
    F near_t(const F& w) const {
        const F beyond = (w - F(latest_start)) * F((1 - 8 * half_ulp) / fastest);
        return xsimd::max(beyond, zero<Arch>());
    }

    /// Of what is between two spheres a part may be on each side of a plane where one of them has
    /// some there. Here: in front of the ends, and inside of the four sides.
    struct Reach {
        M along[2], inside_high[2], inside_low[2];

        Reach& operator|=(const Reach& other) {
            for (int i = 0; i < 2; ++i) {
                along[i] = along[i] | other.along[i];
                inside_high[i] = inside_high[i] | other.inside_high[i];
                inside_low[i] = inside_low[i] | other.inside_low[i];
            }
            return *this;
        }
        std::uint32_t all() const {
            return Lanes<Arch>::bits(along[0] & along[1] & inside_high[0] & inside_high[1] &
                                     inside_low[0] & inside_low[1]);
        }
    };

    /// What has a part everywhere, as bits, by the Reach of each end.
    template <class ReachOf>
    [[gnu::always_inline]] static std::uint32_t reached(const BlockSpheres<Arch>& spheres,
                                                        const ReachOf& reach_of) {
        Reach reach = reach_of(0);
        if (spheres.ends == 1) [[likely]]
            return reach.all();
        reach |= reach_of(1);
        return reach.all();
    }

    /// Fills in `inside_high` and `inside_low`.
    [[gnu::always_inline]] void reach_inside(const SideLanes (&high)[2], const SideLanes (&low)[2],
                                             const F& w_along, const F (&center)[2],
                                             const F& radius, Reach& reach) const {
        for (int side = 0; side < 2; ++side) {
            const F w_across = center[side] - F(apex[across[side]]);
            const F room = grace(w_along, w_across);
            reach.inside_high[side] =
                w_across - high[side].slope * w_along - (room + radius * high[side].norm) <=
                high[side].offset;
            reach.inside_low[side] =
                w_across - low[side].slope * w_along + (room + radius * low[side].norm) >=
                low[side].offset;
        }
    }

    /// The shapes that the group may meet, from one on, as bits.
    [[gnu::always_inline]] std::uint32_t meet(const BlockSpheres<Arch>& spheres, int from) const {
        const SideLanes high[] = {above[0].of_group(), above[1].of_group()};
        const SideLanes low[] = {below[0].of_group(), below[1].of_group()};
        const auto reach_of = [&](int end) {
            const auto& center = spheres.center[end];
            const F radius = S::load(spheres.radius[end] + from);
            const F w_along = S::load(center[along] + from) - F(apex[along]);
            const F w = F(sense) * w_along;
            const F room = grace(w_along, zero<Arch>()) + radius;
            Reach reach;
            reach.along[0] = w + room >= F(least_w);
            reach.along[1] = w - room <= F(greatest_w);
            reach_inside(high, low, w_along,
                         {S::load(center[across[0]] + from), S::load(center[across[1]] + from)},
                         radius, reach);
            return reach;
        };
        return reached(spheres, reach_of);
    }

    /// The bunches, from one on, that one shape may meet, as bits.
    [[gnu::always_inline]] std::uint32_t bunches_that_meet(const BlockSpheres<Arch>& spheres,
                                                           int lane, std::size_t from,
                                                           const F& t_most) const {
        const SideLanes high[] = {above[0].of_bunches(from), above[1].of_bunches(from)};
        const SideLanes low[] = {below[0].of_bunches(from), below[1].of_bunches(from)};
        const auto reach_of = [&](int end) {
            const auto& center = spheres.center[end];
            const F radius(spheres.radius[end][lane]);
            const F w_along = F(center[along][lane]) - F(apex[along]);
            Reach reach;
            reach.along[0] = reach.along[1] =
                near_t(F(sense) * w_along - grace(w_along, zero<Arch>()) - radius) <= t_most;
            reach_inside(high, low, w_along,
                         {F(center[across[0]][lane]), F(center[across[1]][lane])}, radius, reach);
            return reach;
        };
        return reached(spheres, reach_of);
    }
};

} // namespace raylane::simd
