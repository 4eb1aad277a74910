#pragma once

// Included by simd/kernel/lanes/short_lanes.hpp.

namespace raylane::simd {

template <>
struct ShortLanes<Neon> {
    static int pick(const std::uint16_t* numbers, const std::uint16_t* masks, int count,
                    unsigned bit, std::uint16_t* out) {
        const uint16x8_t wanted = vdupq_n_u16(static_cast<std::uint16_t>(1U << bit));
        const uint16x8_t lane = {1, 2, 4, 8, 16, 32, 64, 128};
        int picked = 0;
        for (int k = 0; k < count; k += 8) {
            const uint16x8_t has = vtstq_u16(vld1q_u16(masks + k), wanted);
            std::uint32_t bits = vaddvq_u16(vandq_u16(has, lane));
            if (count - k < 8) bits &= (1U << (count - k)) - 1;
            Orders<Neon, 8>::compress_store(out + picked,
                                            vreinterpretq_u8_u16(vld1q_u16(numbers + k)), bits);
            picked += __builtin_popcount(bits);
        }
        return picked;
    }

    static void compress_keys(std::uint16_t* out, const Floats<Neon>& values,
                              std::uint32_t wanted) {
        const uint16x4_t keys = vshrn_n_u32(vreinterpretq_u32_f32(values), 15);
        Orders<Neon, 8>::compress_store(out, vreinterpretq_u8_u16(vcombine_u16(keys, keys)),
                                        wanted);
    }

    static std::uint32_t min_of_16(const std::uint16_t* keys) {
        const uint16x8_t low = vld1q_u16(keys), high = vld1q_u16(keys + 8);
        const std::uint32_t least = vminvq_u16(vminq_u16(low, high));
        const uint16x8_t limits = vdupq_n_u16(static_cast<std::uint16_t>(least));
        // Each key has four bits.
        const uint8x16_t equal =
            vcombine_u8(vmovn_u16(vceqq_u16(low, limits)), vmovn_u16(vceqq_u16(high, limits)));
        const std::uint64_t fours =
            vget_lane_u64(vreinterpret_u64_u8(vshrn_n_u16(vreinterpretq_u16_u8(equal), 4)), 0);
        return least << 16 | static_cast<std::uint32_t>(__builtin_ctzll(fours)) / 4;
    }

    static std::uint32_t equal_16(const std::uint8_t* bytes, std::uint8_t value) {
        const uint8x16_t equal =
            vandq_u8(vceqq_u8(vld1q_u8(bytes), vdupq_n_u8(value)), lane_bits());
        return vaddv_u8(vget_low_u8(equal)) |
               static_cast<std::uint32_t>(vaddv_u8(vget_high_u8(equal))) << 8;
    }

    static void raise_16(std::uint8_t* bytes, std::uint32_t which, std::uint8_t least) {
        const uint8x16_t halves = vcombine_u8(vdup_n_u8(static_cast<std::uint8_t>(which)),
                                              vdup_n_u8(static_cast<std::uint8_t>(which >> 8)));
        const uint8x16_t wanted = vtstq_u8(halves, lane_bits());
        vst1q_u8(bytes, vmaxq_u8(vld1q_u8(bytes), vandq_u8(wanted, vdupq_n_u8(least))));
    }

  private:
    static uint8x16_t lane_bits() {
        return uint8x16_t{1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
    }
};

} // namespace raylane::simd
