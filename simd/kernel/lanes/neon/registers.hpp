#pragma once

#include <xsimd/xsimd.hpp>

#include <array>
#include <cstdint>

/// Operations on NEON registers that replace xsimd's. Most of them give the bits of xsimd's SSE
/// implementations, from which xsimd's NEON implementations differ. Those that are not templates
/// win overload resolution against xsimd's templates.
namespace raylane::simd {

using Neon = xsimd::neon64;

} // namespace raylane::simd

namespace xsimd {

/// Divides by the NEON instruction. xsimd 8.1 multiplies by a twice refined reciprocal, as 32-bit
/// processors need. That result is off in the last bits. It is NaN if the divisor or its reciprocal
/// is infinite.
template <>
inline batch<float, neon64>& batch<float, neon64>::operator/=(const batch& other) noexcept {
    return *this = vdivq_f32(*this, other);
}

} // namespace xsimd

namespace raylane::simd {

/// bits_as() and select() replace functions that xsimd 8.1 looks up in tables of functions. The
/// compiler leaves some of these look-ups in place.
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

/// Returns b if an operand is NaN or both are zeros, as SSE does. NEON's minimum and maximum return
/// NaN for NaN, and treat -0 as less than 0.
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

/// Returns the correctly rounded root. xsimd 8.1 rounds correctly in double only.
inline xsimd::batch<float, Neon> sqrt(const xsimd::batch<float, Neon>& a) {
    return vsqrtq_f32(a);
}
/// Returns 1 / sqrt(a) by a root and a division, not by an approximation as for other instruction
/// sets. NEON's approximation has 8 bits, and filters rely on the 11 bits of SSE's.
inline xsimd::batch<float, Neon> rsqrt(const xsimd::batch<float, Neon>& a) {
    return vdivq_f32(vdupq_n_f32(1.0F), vsqrtq_f32(a));
}

/// Returns the floor of a, which is -0 for -0. xsimd 8.1 converts to an integer and so returns 0
/// for -0.
inline xsimd::batch<float, Neon> floor(const xsimd::batch<float, Neon>& a) {
    return vrndmq_f32(a);
}
inline xsimd::batch<double, Neon> floor(const xsimd::batch<double, Neon>& a) {
    return vrndmq_f64(a);
}

/// The source of each byte of the wanted lanes, for all sets of `lanes` lanes of a 16-byte
/// register.
template <class Arch, unsigned lanes>
struct Orders {
    struct alignas(16) Order {
        std::uint8_t bytes[16];
    };
    static constexpr std::array<Order, 1U << lanes> table = [] {
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

    /// Writes the wanted lanes, in their order, to `out`.
    static void compress_store(void* out, uint8x16_t register_, std::uint32_t wanted) {
        vst1q_u8(static_cast<std::uint8_t*>(out),
                 vqtbl1q_u8(register_, vld1q_u8(table[wanted].bytes)));
    }
};

} // namespace raylane::simd
