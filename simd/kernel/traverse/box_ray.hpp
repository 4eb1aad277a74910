#pragma once

#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// A ray to be tested against boxes.
///
/// It meets a plane across an axis at (plane - o) / d, or, where mul_add is one instruction, at
/// plane / d - o / d. The planes are shifted away from the box by the slack of the origin, and by
/// 3 u |o| for the rounding of their sum and of o / d. The result is off by 3 u, and by another u
/// for the direction, relative to itself. `allowance` covers this.
struct BoxRay {
    static constexpr float allowance = 1 + 16 * half_ulp;

    float near_offset[3], far_offset[3]; ///< -o, or -o / d
    float inverse[3];                    ///< 1 / d

    /// True if the ray goes from a box's upper plane to its lower one.
    template <class Arch>
    bool falls(int axis) const {
        return __builtin_bit_cast(std::int32_t, inverse[axis]) < 0;
    }

    /// Offsets in a node, in floats, of the planes that the ray meets first and last.
    struct Rows {
        std::int32_t near[3], far[3];
    };
    template <class Arch>
    Rows rows() const {
        Rows rows;
        for (int axis = 0; axis < 3; ++axis) {
            const int shift = falls<Arch>(axis) ? 48 : 0;
            rows.near[axis] = 16 * axis + shift;
            rows.far[axis] = 16 * axis + 48 - shift;
        }
        return rows;
    }

    /// Returns the boxes that are entered before t_limit, and in `near` where they are entered.
    /// `near` must be 0 on input. NaN, as of infinity - infinity, bounds nothing.
    template <class Arch>
    [[gnu::always_inline]] Mask<Arch>
    entered(const Floats<Arch> (&near_planes)[3], const Floats<Arch> (&far_planes)[3],
            const Floats<Arch>& t_limit, Floats<Arch>& near) const {
        using F = Floats<Arch>;
        const auto at = [&](const F& plane, int axis, float offset) {
            if constexpr (Lanes<Arch>::has_mul_add)
                return Lanes<Arch>::mul_add(plane, F(inverse[axis]), F(offset));
            else
                return (plane + F(offset)) * F(inverse[axis]);
        };
        F far = t_limit;
        for (int axis = 0; axis < 3; ++axis) {
            near = max(at(near_planes[axis], axis, near_offset[axis]), near);
            far = min(at(far_planes[axis], axis, far_offset[axis]), far);
        }
        return near <= far * F(allowance);
    }
    /// Returns the same as bits.
    template <class Arch>
    [[gnu::always_inline]] std::uint32_t
    enter(const Floats<Arch> (&near_planes)[3], const Floats<Arch> (&far_planes)[3],
          const Floats<Arch>& t_limit, Floats<Arch>& near) const {
        return Lanes<Arch>::bits(entered<Arch>(near_planes, far_planes, t_limit, near));
    }

    /// Same for the entries of a node from `from` on.
    template <class Arch>
    [[gnu::always_inline]] Mask<Arch> entered(const NodeView& node, const Rows& rows, int from,
                                              const Floats<Arch>& t_limit,
                                              Floats<Arch>& near) const {
        using F = Floats<Arch>;
        const float* const planes = node.lower[0] + from;
        const F near_planes[] = {F::load_unaligned(planes + rows.near[0]),
                                 F::load_unaligned(planes + rows.near[1]),
                                 F::load_unaligned(planes + rows.near[2])};
        const F far_planes[] = {F::load_unaligned(planes + rows.far[0]),
                                F::load_unaligned(planes + rows.far[1]),
                                F::load_unaligned(planes + rows.far[2])};
        return entered<Arch>(near_planes, far_planes, t_limit, near) &
               Streams<Arch>::filled(Streams<Arch>::load_bits(node.children + from));
    }
    template <class Arch>
    [[gnu::always_inline]] std::uint32_t enter(const NodeView& node, const Rows& rows, int from,
                                               const Floats<Arch>& t_limit,
                                               Floats<Arch>& near) const {
        return Lanes<Arch>::bits(entered<Arch>(node, rows, from, t_limit, near));
    }
};

/// 16 rays of a stream in the layout of BoxRay.
template <class Arch>
struct BoxRays {
    using S = Streams<Arch>;
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    float near_offset[3][16], far_offset[3][16], inverse[3][16];

    void load(const SceneView& scene, const RoundedRays& rays, std::size_t begin,
              std::size_t count = 16) {
        for (std::size_t from = 0; from < count; from += F::size) {
            const std::size_t i = begin + from;
            const F slack = S::load(rays.slack + i);
            F reach(scene.reach); // a ray goes no further than 2^30 times this
            for (const float* const origin : rays.origin)
                reach = reach + abs(S::load(origin + i));
            const F drift = reach * F(0x1p-50F);
            for (int axis = 0; axis < 3; ++axis) {
                // A component near 0 is replaced by a tiny one, which moves the ray by at most
                // `drift`. So 0 * infinity cannot occur.
                const F tiny(0x1p-80F);
                const F given = S::load(rays.direction[axis] + i);
                const M leads = abs(given) > tiny;
                const F d = select(leads, given, tiny);
                const F o = S::load(rays.origin[axis] + i);
                const F shift = fast_mul_add<Arch>(F(3 * half_ulp), abs(o), slack) +
                                select(leads, zero<Arch>(), drift);
                const F signed_shift = shift ^ (d & F(-0.0F));
                F slope = F(1.0F) / d;
                F at_near = negated(o + signed_shift), at_far = negated(o - signed_shift);
                if constexpr (Lanes<Arch>::has_mul_add) {
                    at_near = at_near * slope;
                    at_far = at_far * slope;
                    // If float overflows, the axis bounds nothing.
                    const auto fits = abs(at_near) + abs(at_far) < S::infinity();
                    slope = select(fits, slope, zero<Arch>());
                    at_near = select(fits, at_near, zero<Arch>());
                    at_far = select(fits, at_far, S::infinity());
                }
                slope.store_unaligned(inverse[axis] + from);
                at_near.store_unaligned(near_offset[axis] + from);
                at_far.store_unaligned(far_offset[axis] + from);
            }
        }
    }

    BoxRay get(int lane) const {
        BoxRay ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.near_offset[axis] = near_offset[axis][lane];
            ray.far_offset[axis] = far_offset[axis][lane];
            ray.inverse[axis] = inverse[axis][lane];
        }
        return ray;
    }
};

} // namespace raylane::simd
