#pragma once

// Included by simd/kernel/lanes/doubles.hpp.

namespace raylane::simd {

template <>
struct DoubleLanes<Neon> {
    using F = Floats<Double<Neon>>;
    using M = Mask<Double<Neon>>;

    static std::uint32_t bits(const M& mask) {
        return static_cast<std::uint32_t>(vaddvq_u64(vandq_u64(mask, lane_bits())));
    }
    static M from_bits(std::uint32_t bits) { return vtstq_u64(vdupq_n_u64(bits), lane_bits()); }
    static M in_range(const std::uint32_t* value, const std::uint32_t* first,
                      const std::uint32_t* last) {
        return in_range(vld1_u32(value), vld1_u32(first), vld1_u32(last));
    }
    static M in_range(const std::uint32_t* value, std::uint32_t first, std::uint32_t last) {
        return in_range(vld1_u32(value), vdup_n_u32(first), vdup_n_u32(last));
    }
    static F from_numbers(const std::uint32_t* from, std::uint32_t kept) {
        const uint32x2_t numbers = vand_u32(vld1_u32(from), vdup_n_u32(kept));
        return vcvtq_f64_s64(vmovl_s32(vreinterpret_s32_u32(numbers)));
    }
    static void to_numbers(std::uint32_t* out, const F& values) {
        vst1_u32(out, vreinterpret_u32_s32(vmovn_s64(vcvtq_s64_f64(values))));
    }
    static F gather(const Spots<Neon>& spots, int row) {
        const float* const from = spots.base + row;
        return vcvt_f64_f32(float32x2_t{from[spots.offsets[0]], from[spots.offsets[1]]});
    }

    static F widen(const Floats<Neon>& values, int half) {
        return half == 0 ? vcvt_f64_f32(vget_low_f32(values)) : vcvt_high_f64_f32(values);
    }
    static F product_error(const F& a, const F& b, const F& product) {
        return vfmaq_f64(vnegq_f64(product), a, b);
    }
    static M round_alike(const F& a, const F& b) {
        return widened(vceq_f32(vcvt_f32_f64(a), vcvt_f32_f64(b)));
    }
    static F pick(const double* from, const std::uint32_t* places) {
        return float64x2_t{from[places[0]], from[places[1]]};
    }
    static void compress_store(double* out, const F& values, std::uint32_t wanted) {
        const float64x2_t lanes = values;
        vst1q_f64(out, wanted == 2 ? vdupq_laneq_f64(lanes, 1) : lanes);
    }

  private:
    static uint64x2_t lane_bits() { return uint64x2_t{1, 2}; }
    static M widened(uint32x2_t mask) {
        return vreinterpretq_u64_s64(vmovl_s32(vreinterpret_s32_u32(mask)));
    }
    static M in_range(uint32x2_t value, uint32x2_t first, uint32x2_t last) {
        return widened(vcle_u32(vsub_u32(value, first), vsub_u32(last, first)));
    }
};

} // namespace raylane::simd
