#pragma once

#include "simd/kernel/trace/rays.hpp"

namespace raylane::simd {

/// A ray against boxes.
///
/// The boxes' planes are shifted by the slack of the origin, away from the box; a quotient is then
/// off by 3 u and the direction by u more, relative to itself, which `allowance` grants.
struct BoxRay {
    static constexpr float allowance = 1 + 16 * half_ulp;

    float near_origin[3], far_origin[3], inverse[3];
    std::int32_t near_row[3], far_row[3]; ///< where the planes are in a node, in floats

    /// The boxes that are entered before t_most, as bits, and where. `near` is 0 going in.
    template <class Arch>
    [[gnu::always_inline]] std::uint32_t
    enter(const NodeView& node, int from, const Floats<Arch>& t_most, Floats<Arch>& near) const {
        using F = Floats<Arch>;
        const float* rows = node.lower[0] + from;
        F far = t_most;
        for (int axis = 0; axis < 3; ++axis) {
            const F at_near = (F::load_unaligned(rows + near_row[axis]) - F(near_origin[axis])) *
                              F(inverse[axis]);
            const F at_far =
                (F::load_unaligned(rows + far_row[axis]) - F(far_origin[axis])) * F(inverse[axis]);
            near = xsimd::max(at_near, near);
            far = xsimd::min(at_far, far);
        }
        return Lanes<Arch>::bits(near <= far * F(allowance)) & Streams<Arch>::filled(node, from);
    }
};

/// 16 of them from a stream.
template <class Arch>
struct BoxRays {
    using S = Streams<Arch>;
    using F = Floats<Arch>;
    float near_origin[3][16], far_origin[3][16], inverse[3][16];

    void load(const RoundedRays& rays, std::size_t begin) {
        for (std::size_t from = 0; from < 16; from += F::size) {
            const std::size_t i = begin + from;
            const F slack = F(2.0F) * S::load(rays.slack + i);
            for (int axis = 0; axis < 3; ++axis) {
                // A component of 0 is as good as one that leads nowhere: no 0 * infinity then.
                const F tiny(0x1p-100F);
                const F given = S::load(rays.direction[axis] + i);
                const F d = xsimd::select(xsimd::abs(given) > tiny, given, tiny);
                const F o = S::load(rays.origin[axis] + i);
                const F signed_slack = slack ^ (d & F(-0.0F));
                (F(1.0F) / d).store_unaligned(inverse[axis] + from);
                (o + signed_slack).store_unaligned(near_origin[axis] + from);
                (o - signed_slack).store_unaligned(far_origin[axis] + from);
            }
        }
    }

    BoxRay get(int lane) const {
        BoxRay ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.near_origin[axis] = near_origin[axis][lane];
            ray.far_origin[axis] = far_origin[axis][lane];
            ray.inverse[axis] = inverse[axis][lane];
            const int falls = __builtin_bit_cast(std::int32_t, ray.inverse[axis]) < 0 ? 48 : 0;
            ray.near_row[axis] = 16 * axis + falls;
            ray.far_row[axis] = 16 * axis + 48 - falls;
        }
        return ray;
    }
};

} // namespace raylane::simd
