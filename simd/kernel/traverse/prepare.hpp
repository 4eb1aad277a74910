#pragma once

#include "simd/kernel/lanes/short_lanes.hpp"
#include "simd/kernel/shapes/filter.hpp"
#include "simd/kernel/traverse/rays.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// Implements RayKernels.
template <class Arch>
struct Prepare : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    /// Same as core::CameraRays, in double.
    static void camera_rays(const CameraView& camera, std::size_t count, const double* across,
                            const double* upward, const double* lens_right, const double* lens_up,
                            double* const origin[3], double* const direction[3]) {
        const auto broadcast = [](const double(&v)[3]) {
            return Vectors<D>{Number(v[0]), Number(v[1]), Number(v[2])};
        };
        const Vectors<D> from = broadcast(camera.from), forward = broadcast(camera.forward);
        const Vectors<D> right = broadcast(camera.right), up = broadcast(camera.up);
        for (std::size_t i = 0; i < count; i += Number::size) {
            const Number x = Number::load_unaligned(across + i);
            const Number y = Number::load_unaligned(upward + i);
            const Vectors<D> offset{x * right.x + y * up.x, x * right.y + y * up.y,
                                    x * right.z + y * up.z};
            Vectors<D> o = camera.orthographic ? from + offset : from;
            Vectors<D> d = camera.orthographic ? forward : normalized<D>(forward + offset);
            if (lens_right != nullptr) {
                const Vectors<D> aside = mul_add<D>(
                    Number::load_unaligned(lens_right + i), broadcast(camera.lens_right),
                    scaled(Number::load_unaligned(lens_up + i), broadcast(camera.lens_up)));
                const Vectors<D> sharp = camera.orthographic ? forward : forward + offset;
                o = o + aside;
                d = normalized<D>(mul_add<D>(Number(camera.focus), sharp, -aside));
            }
            const Number* const values[] = {&o.x, &o.y, &o.z, &d.x, &d.y, &d.z};
            double* const columns[] = {origin[0],    origin[1],    origin[2],
                                       direction[0], direction[1], direction[2]};
            for (int k = 0; k < 6; ++k)
                values[k]->store_unaligned(columns[k] + i);
        }
    }

    static void round_rays(std::size_t count, const RoundedRays& rays, float rounding) {
        const float least = least_slack(rounding);
        for (std::size_t i = 0; i < count; i += F::size) {
            if (rays.before != nullptr)
                round_packet<true>(rays, i, least);
            else
                round_packet<false>(rays, i, least);
        }
    }

    static std::size_t list_uncertain(std::size_t count, const Candidates& candidates,
                                      const double* t, const double* error,
                                      const std::uint32_t* hit, const std::uint8_t* doubtful,
                                      float least, std::uint32_t* lanes) {
        const F none = S::broadcast_bits(no_slot);
        const F unsolved = S::broadcast_bits(hit_doubtful | hit_none), nothing = zero<Arch>();
        std::size_t listed = 0;
        std::uint32_t asked = 0; // doubtful ones of 16 lanes
        for (std::size_t i = 0; i < count; i += F::size) {
            // Rounding to float costs each of these half an ulp, and their sum and the product half
            // an ulp more, unless they are subnormal.
            const F last =
                (Lanes<Arch>::narrow(t + i) + Lanes<Arch>::narrow(error + i)) * F(1 + 0x1p-21F);
            const F most = min(S::load(candidates.second + i),
                               S::load(candidates.first + i) * F(culling_slack));
            const M solved =
                Lanes<Arch>::in_range(S::load_bits(hit + i) & unsolved, nothing, nothing);
            const M missed = Lanes<Arch>::in_range(S::load_bits(candidates.slot + i), none, none);
            const M first = (last <= most) & (most >= F(least));
            std::uint32_t uncertain = Lanes<Arch>::bits(~(missed | (solved & first)));
            if (i % 16 == 0) asked = ~ShortLanes<Arch>::equal_16(doubtful + i, 0) & 0xFFFF;
            uncertain |= asked >> i % 16 & ((1U << F::size) - 1);
            if (uncertain == 0) continue;
            if (count - i < F::size) uncertain &= (1U << (count - i)) - 1;
            for (; uncertain != 0; uncertain &= uncertain - 1)
                lanes[listed++] =
                    static_cast<std::uint32_t>(i) + static_cast<unsigned>(__builtin_ctz(uncertain));
        }
        return listed;
    }

    static constexpr RayKernels table() { return {camera_rays, round_rays, list_uncertain}; }

  private:
    using D = Double<Arch>;
    using Number = Floats<D>;

    /// Rounds a packet of rays. The slack covers the errors of moving rays further along in double,
    /// and then those of rounding to float.
    template <bool moves>
    [[gnu::always_inline]] static void round_packet(const RoundedRays& rays, std::size_t i,
                                                    float least) {
        double moved[F::size] = {}; // sum over the coordinates
        if constexpr (moves)
            for (std::size_t k = 0; k < F::size; k += Number::size) {
                const Number before = Number::load_unaligned(rays.before + i + k);
                Number size = before;
                for (const double* const meant : rays.exact_origin)
                    size = size + abs(Number::load_unaligned(meant + i + k));
                select(before > zero<D>(), Number(0x1p-50) * size, zero<D>())
                    .store_unaligned(moved + k);
            }
        for (int axis = 0; axis < 3; ++axis) {
            const double* meant = rays.exact_origin[axis] + i;
            double values[F::size];
            if constexpr (moves) {
                for (std::size_t k = 0; k < F::size; k += Number::size)
                    mul_add<D>(Number::load_unaligned(rays.before + i + k),
                               Number::load_unaligned(rays.exact_direction[axis] + i + k),
                               Number::load_unaligned(meant + k))
                        .store_unaligned(values + k);
                meant = values;
            }
            const F o = Lanes<Arch>::narrow(meant);
            o.store_unaligned(rays.origin[axis] + i);
            for (int half = 0; half < 2; ++half) {
                double* const sum = moved + half * Number::size;
                const Number off =
                    Lanes<D>::widen(o, half) - Number::load_unaligned(meant + half * Number::size);
                (Number::load_unaligned(sum) + abs(off)).store_unaligned(sum);
            }
            Lanes<Arch>::narrow(rays.exact_direction[axis] + i)
                .store_unaligned(rays.direction[axis] + i);
        }
        // FilterRays requires this.
        (Lanes<Arch>::narrow(moved) * F(1 + 0x1p-15F) + F(least)).store_unaligned(rays.slack + i);
    }
};

} // namespace raylane::simd
