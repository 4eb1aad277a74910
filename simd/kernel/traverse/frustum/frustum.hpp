#pragma once

#include "simd/kernel/traverse/block_spheres.hpp"
#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// Frustum: bounds of up to 256 rays through one point, or in one direction.
///
/// Coordinate k counts along the rays. With w = p - apex, a point on a ray has w_a - u w_k = offset
/// for each other coordinate a, where u and offset are the ray's slope and offset for a. Rays
/// through a point have offset 0, and rays in one direction have equal slopes. The frustum lies
/// between the smallest and the largest of these. So does each of its sixteen packets of 16
/// consecutive rays, which are lanes here.
///
/// Roundings are a few u of |w_a| + |u w_k| + |offset|. `tolerance` allows 16 u of the sizes of w
/// and, as slopes are at most 4, twice that of the rest.
template <class Arch>
struct Frustum : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    static constexpr std::size_t max_rays = 256;
    static constexpr float steepest = 4.0F;

    /// One side of the frustum: w_a - slope w_k > offset is outside, or < offset for the opposite
    /// side.
    struct Side {
        float slope, offset, norm;
        alignas(64) float slopes[16], offsets[16], norms[16]; // of the packets
    };

    float apex[3];
    float slack;
    int along;          ///< k
    int across[2];      ///< the other coordinates
    float sense;        ///< sign of the rays along k: 1 or -1
    float min_w;        ///< of sense * w_k: anything before is behind all rays
    float greatest_w;   ///< of sense * w_k: anything after is beyond all rays
    float fastest;      ///< the largest |d_k|
    float t_per_w;      ///< less than 1 / fastest
    float latest_start; ///< sense * w_k of the last origin
    Side above[2], below[2];
    std::size_t packets;

    /// Encloses rays that start or end at `apex`, which for rays in one direction is any point near
    /// them. Returns whether the rays are coherent enough.
    bool enclose(const RoundedRays& rays, std::size_t begin, std::size_t end, Coherence coherence,
                 const float* t_limit) {
        packets = (end - begin + 15) / 16;
        choose_apex(rays, begin, coherence);
        choose_axes(rays, begin, end, coherence.converging);
        pad(rays, end);

        Extent extent;
        for (std::size_t packet = 0; packet < packets; ++packet)
            enclose_packet(rays, packet, begin, end, coherence, t_limit, extent);
        for (std::size_t packet = packets; packet < 16; ++packet)
            leave_out(packet);

        bound_along(extent, coherence, t_limit != nullptr);
        slack += Lanes<Arch>::greatest(extent.slack);
        for (int side = 0; side < 2; ++side)
            enclose_packets(side);
        return Lanes<Arch>::least(extent.slowest) > 0.0F && is_slender();
    }

    /// Returns the tolerance for all roundings, at a distance of w along and across the rays.
    F tolerance(const F& w_along, const F& w_across) const {
        return F(tolerance_factor) * (abs(w_along) + abs(w_across)) + F(8 * steepest * slack);
    }

    /// Returns the boxes of a node that the frustum may meet, as bits, and in `near` the smallest t
    /// at which it does.
    std::uint32_t enter(const NodeView& node, int from, const F& t_limit, F& near) const {
        const F apex_along(apex[along]);
        const F lower_k = S::load(node.lower[along] + from) - apex_along;
        const F upper_k = S::load(node.upper[along] + from) - apex_along;
        const F reach_k = max(abs(lower_k), abs(upper_k));
        const F first_w = sense > 0.0F ? lower_k : negated(upper_k);
        const F last_w = sense > 0.0F ? upper_k : negated(lower_k);
        const F tolerance_k = tolerance(reach_k, zero<Arch>());
        M meets = (last_w + tolerance_k >= F(min_w)) & (first_w - tolerance_k <= F(greatest_w));
        for (int side = 0; side < 2; ++side) {
            const int a = across[side];
            const F apex_across(apex[a]);
            const F lower = S::load(node.lower[a] + from) - apex_across;
            const F upper = S::load(node.upper[a] + from) - apex_across;
            const F room = tolerance(reach_k, max(abs(lower), abs(upper)));
            const Side &high = above[side], &low = below[side];
            const F min_above = lower - F(high.slope) * (high.slope > 0.0F ? upper_k : lower_k);
            const F max_below = upper - F(low.slope) * (low.slope > 0.0F ? lower_k : upper_k);
            meets =
                meets & (min_above - room <= F(high.offset)) & (max_below + room >= F(low.offset));
        }
        near = near_t(first_w - tolerance_k);
        return Lanes<Arch>::bits(meets & (near <= t_limit)) & S::filled(node, from);
    }

    /// Returns a lower bound of t at the distance w along the rays.
    F near_t(const F& w) const { return max((w - F(latest_start)) * F(t_per_w), zero<Arch>()); }

    /// The plane of one side: of all rays, or of each packet.
    struct Plane {
        F slope, norm, offset;

        explicit Plane(const Side& of_all)
            : slope(of_all.slope), norm(of_all.norm), offset(of_all.offset) {}
        Plane(const Side& of_packets, std::size_t from)
            : slope(S::load(of_packets.slopes + from)), norm(S::load(of_packets.norms + from)),
              offset(S::load(of_packets.offsets + from)) {}

        /// Returns w_across - slope w_along + radius norm.
        F outmost(const F& w_along, const F& w_across, const F& radius) const {
            return fast_mul_add<Arch>(radius, norm,
                                      fast_mul_add<Arch>(negated(w_along), slope, w_across));
        }
    };

    /// The half-spaces that a shape between two spheres may reach: those that at least one of the
    /// spheres reaches. The half-spaces are those in front of both ends and inside of the four
    /// sides.
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

    /// A block's spheres, or those around one end of its shapes, in coordinates of the frustum.
    struct alignas(64) Seen {
        float near[16];                ///< the smallest t
        float along[16];               ///< w_k
        float low[2][16], high[2][16]; ///< w_a less and plus `tolerance`
        float radius[16];
    };
    struct SeenBlock {
        Seen end[2];
        int ends;
    };

    /// Sets the sides of `reach`: for spheres and all rays, or for one sphere and the rays of
    /// packets.
    template <class Load, class PlaneOf>
    [[gnu::always_inline]] void reach_sides(const Seen& seen, const Load& load,
                                            const PlaneOf& plane_of, Reach& reach) const {
        for (int side = 0; side < 2; ++side) {
            const Plane high = plane_of(above[side]), low = plane_of(below[side]);
            const F w_along = load(seen.along), radius = load(seen.radius);
            reach.inside_high[side] =
                high.outmost(w_along, load(seen.low[side]), negated(radius)) <= high.offset;
            reach.inside_low[side] =
                low.outmost(w_along, load(seen.high[side]), radius) >= low.offset;
        }
    }

    /// Returns the shapes that reach all half-spaces, as bits. reach_of() returns the Reach of one
    /// end.
    template <class ReachOf>
    [[gnu::always_inline]] static std::uint32_t reached(int ends, const ReachOf& reach_of) {
        Reach reach = reach_of(0);
        if (ends == 1) [[likely]]
            return reach.all();
        reach |= reach_of(1);
        return reach.all();
    }

    /// Returns the largest w of a ray at t_limit. Inverse of near_t().
    float furthest_w(float t_limit) const {
        const float way = t_limit * fastest;
        const float w = latest_start + way + 16 * half_ulp * (size(latest_start) + way);
        return least(greatest_w, w == w ? w : __builtin_inff());
    }

    /// Fills `seen` from `from` on. Returns the shapes that the frustum may meet and that are not
    /// beyond `furthest`, as bits.
    [[gnu::always_inline]] std::uint32_t meet(const BlockSpheres<Arch>& spheres, int from,
                                              float furthest, SeenBlock& seen) const {
        const F tolerance_apart(8 * steepest * slack), factor(tolerance_factor);
        seen.ends = spheres.ends;
        const auto reach_of = [&](int end) __attribute__((always_inline)) {
            Seen& to = seen.end[end];
            const auto& center = spheres.center[end];
            const F radius = S::load(spheres.radius[end] + from);
            const F w_along = S::load(center[along] + from) - F(apex[along]);
            const F w = F(sense) * w_along;
            const F tolerance_along = fast_mul_add<Arch>(factor, abs(w_along), tolerance_apart);
            const F room = tolerance_along + radius;
            Reach reach;
            reach.along[0] = w + room >= F(min_w);
            reach.along[1] = w - room <= F(furthest);
            near_t(w - room).store_unaligned(to.near + from);
            w_along.store_unaligned(to.along + from);
            radius.store_unaligned(to.radius + from);
            for (int side = 0; side < 2; ++side) {
                const F w_across = S::load(center[across[side]] + from) - F(apex[across[side]]);
                const F room_across = fast_mul_add<Arch>(factor, abs(w_across), tolerance_along);
                (w_across - room_across).store_unaligned(to.low[side] + from);
                (w_across + room_across).store_unaligned(to.high[side] + from);
            }
            reach_sides(
                to, [&](const float* column) { return S::load(column + from); },
                [](const Side& side) { return Plane(side); }, reach);
            return reach;
        };
        return reached(spheres.ends, reach_of);
    }

    /// Returns the packets, from `from` on, that may meet one shape before t_limit, as bits.
    [[gnu::always_inline]] std::uint32_t
    packets_that_meet(const SeenBlock& seen, int lane, std::size_t from, const F& t_limit) const {
        const auto reach_of = [&](int end) __attribute__((always_inline)) {
            Reach reach;
            reach.along[0] = reach.along[1] = F(seen.end[end].near[lane]) <= t_limit;
            reach_sides(
                seen.end[end], [&](const float* column) { return F(column[lane]); },
                [&](const Side& side) { return Plane(side, from); }, reach);
            return reach;
        };
        return reached(seen.ends, reach_of);
    }

  private:
    /// Extent of all rays along k, collected while they are read. Each lane holds that of its share
    /// of the rays.
    struct Extent {
        F slowest = S::infinity(),
          fastest = zero<Arch>(); ///< d_k, positive in the direction of the rays
        F first_start = S::infinity(), last_start = negated(S::infinity()); ///< sense * w_k
        /// for rays with limits
        F last_end = zero<Arch>();
        F slack = zero<Arch>();
    };

    /// True if the rays' starts have to be read: for rays in one direction, and for rays that start
    /// beyond the apex.
    static bool start_anywhere(const Coherence& coherence) {
        return coherence.parallel || coherence.beyond;
    }

    void choose_apex(const RoundedRays& rays, std::size_t begin, const Coherence& coherence) {
        for (int axis = 0; axis < 3; ++axis)
            apex[axis] = coherence.parallel ? rays.origin[axis][begin] : coherence.apex[axis];
        slack = half_ulp * (size(apex[0]) + size(apex[1]) + size(apex[2])) + coherence.spread;
    }

    [[gnu::always_inline]] void enclose_packet(const RoundedRays& rays, std::size_t packet,
                                               std::size_t begin, std::size_t end,
                                               const Coherence& coherence, const float* t_limit,
                                               Extent& extent) {
        const std::size_t from = begin + 16 * packet;
        F low_slope[2] = {S::infinity(), S::infinity()}, high_slope[2];
        F low_offset[2] = {S::infinity(), S::infinity()}, high_offset[2];
        for (int side = 0; side < 2; ++side)
            high_slope[side] = high_offset[side] = negated(S::infinity());
        for (std::size_t i = from; i < from + 16; i += F::size) {
            const F direction = S::load(rays.direction[along] + i);
            const F w = S::load(rays.origin[along] + i) - F(apex[along]);
            extend(extent, rays, i, end, coherence, t_limit, direction, w);
            for (int side = 0; side < 2; ++side) {
                const int a = across[side];
                const F slope = S::load(rays.direction[a] + i) / direction;
                low_slope[side] = min(low_slope[side], slope);
                high_slope[side] = max(high_slope[side], slope);
                if (!coherence.parallel) continue;
                const F offset = (S::load(rays.origin[a] + i) - F(apex[a])) - slope * w;
                low_offset[side] = min(low_offset[side], offset);
                high_offset[side] = max(high_offset[side], offset);
            }
        }
        for (int side = 0; side < 2; ++side) {
            const float low = Lanes<Arch>::least(low_slope[side]);
            const float high = Lanes<Arch>::greatest(high_slope[side]);
            // If `sense` is -1, the larger slope is the lower bound.
            set(above[side], packet, sense > 0.0F ? high : low,
                coherence.parallel ? Lanes<Arch>::greatest(high_offset[side]) : 0.0F);
            set(below[side], packet, sense > 0.0F ? low : high,
                coherence.parallel ? Lanes<Arch>::least(low_offset[side]) : 0.0F);
        }
    }

    /// Extends the extent by the lanes from ray i on.
    [[gnu::always_inline]] void extend(Extent& extent, const RoundedRays& rays, std::size_t i,
                                       std::size_t end, const Coherence& coherence,
                                       const float* t_limit, const F& direction, const F& w) const {
        extent.slack = max(extent.slack, S::load(rays.slack + i));
        const F d = F(coherence.converging ? -sense : sense) * direction;
        extent.slowest = min(extent.slowest, d);
        extent.fastest = max(extent.fastest, d);
        if (start_anywhere(coherence)) {
            extent.first_start = min(extent.first_start, F(sense) * w);
            extent.last_start = max(extent.last_start, F(sense) * w);
        }
        if (t_limit != nullptr && coherence.converging && i < end)
            extent.last_end = max(extent.last_end, select(S::first_lanes(end - i),
                                                          d * S::load(t_limit + i), zero<Arch>()));
    }

    /// Sets the sides of an absent packet so that it meets only infinite spheres.
    void leave_out(std::size_t packet) {
        for (int side = 0; side < 2; ++side) {
            set(above[side], packet, above[side].slopes[0], -__builtin_inff());
            set(below[side], packet, below[side].slopes[0], __builtin_inff());
        }
    }

    /// Bounds the rays along k from the first start to the last end, as far as these are known. If
    /// the rays go towards the apex, points far from it are near the rays' starts.
    void bound_along(const Extent& extent, const Coherence& coherence, bool have_limits) {
        const bool anywhere = start_anywhere(coherence);
        min_w = coherence.converging || !anywhere ? 0.0F : __builtin_inff();
        latest_start = coherence.converging && !anywhere ? __builtin_inff() : 0.0F;
        if (anywhere) {
            min_w = least(min_w, Lanes<Arch>::least(extent.first_start));
            latest_start = Lanes<Arch>::greatest(extent.last_start);
        }
        greatest_w = coherence.converging && have_limits ? Lanes<Arch>::greatest(extent.last_end)
                                                         : __builtin_inff();
        fastest = Lanes<Arch>::greatest(extent.fastest);
        t_per_w = (1 - 8 * half_ulp) / fastest;
    }

    bool is_slender() const {
        bool slender = true;
        for (int side = 0; side < 2; ++side)
            slender =
                slender && size(above[side].slope) < steepest && size(below[side].slope) < steepest;
        return slender;
    }

    /// Fills the unused lanes of the last packet with copies of the last ray.
    static void pad(const RoundedRays& rays, std::size_t end) {
        for (std::size_t i = end; i % 16 != 0; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                rays.origin[axis][i] = rays.origin[axis][end - 1];
                rays.direction[axis][i] = rays.direction[axis][end - 1];
            }
            rays.slack[i] = rays.slack[end - 1];
        }
    }

    static float least(float a, float b) { return a < b ? a : b; }
    static float greatest(float a, float b) { return a > b ? a : b; }
    static float size(float a) { return __builtin_fabsf(a); }

    /// Chooses k as the largest component of the middle ray's direction.
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

    static void set(Side& side, std::size_t packet, float slope, float offset) {
        side.slopes[packet] = slope;
        side.offsets[packet] = offset;
        side.norms[packet] = norm_above(slope);
    }

    /// Returns a number that is at least sqrt(1 + slope^2).
    static float norm_above(float slope) { return 1.0F + 0.5F * slope * slope; }

    void enclose_packets(int side) {
        Side &high = above[side], &low = below[side];
        const bool forwards = sense > 0.0F;
        high.slope = forwards ? S::greatest_of_16(high.slopes) : S::min_of_16(high.slopes);
        low.slope = forwards ? S::min_of_16(low.slopes) : S::greatest_of_16(low.slopes);
        high.offset = S::greatest_of_16(high.offsets);
        low.offset = S::min_of_16(low.offsets);
        high.norm = norm_above(high.slope);
        low.norm = norm_above(low.slope);
    }

    static constexpr float tolerance_factor = 2 * steepest * 16 * half_ulp;
};

} // namespace raylane::simd
