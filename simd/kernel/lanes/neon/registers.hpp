#pragma once

#include <xsimd/xsimd.hpp>

#include <array>
#include <cstdint>

/// What xsimd does by NEON, where that differs in its bits from what it does by SSE. Not templates,
/// so that they are taken before xsimd's own.
namespace raylane::simd {

using Neon = xsimd::neon64;

} // namespace raylane::simd

namespace xsimd {

/// xsimd 8.1 has a reciprocal here that is refined twice, as 32-bit processors need it: it is off
/// in the last bits, and NaN for divisors that are infinite or whose reciprocal is.
template <>
inline batch<float, neon64>& batch<float, neon64>::operator/=(const batch& other) noexcept {
    return *this = vdivq_f32(*this, other);
}

} // namespace xsimd

namespace raylane::simd {

/// xsimd 8.1 looks these two up in tables of functions, some of which the compiler leaves in place.
template <class To, class From>
xsimd::batch<To, Neon> bits_as(const xsimd::batch<From, Neon>& from) {
    using Result = typename xsimd::batch<To, Neon>::register_type;
    using Given = typename xsimd::batch<From, Neon>::register_type;
    return __builtin_bit_cast(Result, static_cast<Given>(from));
}
inline xsimd::batch<float, Neon> select(const xsimd::batch_bool<float, Neon>& mask,
                                        const xsimd::batch<float, Neon>& a,
                                        const xsimd::batch<float, Neon>& b) {
    return vbslq_f32(mask, a, b);
}
inline xsimd::batch<double, Neon> select(const xsimd::batch_bool<double, Neon>& mask,
                                         const xsimd::batch<double, Neon>& a,
                                         const xsimd::batch<double, Neon>& b) {
    return vbslq_f64(mask, a, b);
}

/// SSE's: b where one is not a number, and of two zeros. NEON's are NaN there, and the lesser zero
/// is the negative one.
inline xsimd::batch<float, Neon> min(const xsimd::batch<float, Neon>& a,
                                     const xsimd::batch<float, Neon>& b) {
    return vbslq_f32(vcltq_f32(a, b), a, b);
}
inline xsimd::batch<double, Neon> min(const xsimd::batch<double, Neon>& a,
                                      const xsimd::batch<double, Neon>& b) {
    return vbslq_f64(vcltq_f64(a, b), a, b);
}
inline xsimd::batch<float, Neon> max(const xsimd::batch<float, Neon>& a,
                                     const xsimd::batch<float, Neon>& b) {
    return vbslq_f32(vcgtq_f32(a, b), a, b);
}
inline xsimd::batch<double, Neon> max(const xsimd::batch<double, Neon>& a,
                                      const xsimd::batch<double, Neon>& b) {
    return vbslq_f64(vcgtq_f64(a, b), a, b);
}

/// Correctly rounded, as xsimd 8.1's is in double alone.
inline xsimd::batch<float, Neon> sqrt(const xsimd::batch<float, Neon>& a) {
    return vsqrtq_f32(a);
}
/// Not the approximation that it is elsewhere: NEON's has 8 bits, and filters count on SSE's 11.
inline xsimd::batch<float, Neon> rsqrt(const xsimd::batch<float, Neon>& a) {
    return vdivq_f32(vdupq_n_f32(1.0F), vsqrtq_f32(a));
}

/// -0 of -0, which xsimd 8.1 makes a whole number, and so 0.
inline xsimd::batch<float, Neon> floor(const xsimd::batch<float, Neon>& a) {
    return vrndmq_f32(a);
}
inline xsimd::batch<double, Neon> floor(const xsimd::batch<double, Neon>& a) {
    return vrndmq_f64(a);
}

/// Where each byte of the wanted lanes comes from, for all sets of `lanes` lanes of 16 bytes.
template <class Arch, unsigned lanes>
struct Orders {
    struct alignas(16) Order {
        std::uint8_t bytes[16];
    };
    static constexpr std::array<Order, 1U << lanes> all = [] {
        constexpr unsigned size = 16 / lanes;
        std::array<Order, 1U << lanes> orders{};
        for (unsigned wanted = 0; wanted < 1U << lanes; ++wanted) {
            unsigned to = 0;
            for (unsigned byte = 0; byte < 16; ++byte)
                if ((wanted >> byte / size & 1) != 0)
                    orders[wanted].bytes[to++] = static_cast<std::uint8_t>(byte);
        }
        return orders;
    }();

    /// In their order, to `out`.
    static void compress_store(void* out, uint8x16_t register_, std::uint32_t wanted) {
        vst1q_u8(static_cast<std::uint8_t*>(out),
                 vqtbl1q_u8(register_, vld1q_u8(all[wanted].bytes)));
    }
};

} // namespace raylane::simd
