#pragma once

// Included by simd/kernel/lanes/lanes.hpp.

namespace raylane::simd {

template <>
struct Lanes<Neon> {
    using F = Floats<Neon>;
    using M = Mask<Neon>;
    static constexpr bool has_mul_add = true;

    static std::uint32_t bits(const M& mask) {
        return vaddvq_u32(vandq_u32(mask, uint32x4_t{1, 2, 4, 8}));
    }
    static void compress_store(float* out, const F& values, std::uint32_t wanted) {
        Orders<Neon, 4>::compress_store(out, vreinterpretq_u8_f32(values), wanted);
    }
    static F mul_add(const F& a, const F& b, const F& c) { return vfmaq_f32(c, a, b); }

    static float least(const F& values) {
        const float32x4_t two = min(values, F(vextq_f32(values, values, 2)));
        const float first = vgetq_lane_f32(two, 0), second = vgetq_lane_f32(two, 1);
        return first < second ? first : second;
    }
    static float greatest(const F& values) {
        const float32x4_t two = max(values, F(vextq_f32(values, values, 2)));
        const float first = vgetq_lane_f32(two, 0), second = vgetq_lane_f32(two, 1);
        return first > second ? first : second;
    }

    static F narrow(const double* from) {
        return vcvt_high_f32_f64(vcvt_f32_f64(vld1q_f64(from)), vld1q_f64(from + 2));
    }
    static F gather(const float* from, const std::uint32_t* places) {
        return float32x4_t{from[places[0]], from[places[1]], from[places[2]], from[places[3]]};
    }
    static F add(const F& a, const F& b) {
        return vreinterpretq_f32_u32(vaddq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)));
    }
    static F unpack_24(const std::uint8_t* from) {
        constexpr std::uint8_t none = 0xFF;
        const uint8x16_t order = {0, 1, 2, none, 3, 4, 5, none, 6, 7, 8, none, 9, 10, 11, none};
        return vreinterpretq_f32_u8(vqtbl1q_u8(vld1q_u8(from), order));
    }
    static F look_up(const float* from, const F& places) {
        // Each index becomes four byte indices.
        const uint32x4_t at = vandq_u32(vreinterpretq_u32_f32(places), vdupq_n_u32(15));
        const uint32x4_t bytes = vmlaq_u32(vdupq_n_u32(0x03020100), at, vdupq_n_u32(0x04040404));
        const uint8x16x4_t table = vld1q_u8_x4(reinterpret_cast<const std::uint8_t*>(from));
        return vreinterpretq_f32_u8(vqtbl4q_u8(table, vreinterpretq_u8_u32(bytes)));
    }

    static M in_range(const F& id, const F& first, const F& last) {
        const uint32x4_t from = vreinterpretq_u32_f32(first);
        return vcleq_u32(vsubq_u32(vreinterpretq_u32_f32(id), from),
                         vsubq_u32(vreinterpretq_u32_f32(last), from));
    }
};

} // namespace raylane::simd
