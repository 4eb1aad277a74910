#pragma once

// xsimd 8.1's AVX-512 header calls an intrinsic that no compiler provides.
#if defined(__AVX512F__) && !defined(_mm512_rsqrt23_ps)
#define _mm512_rsqrt23_ps _mm512_rsqrt14_ps
#endif
#include "simd/isa/isa_name.hpp"
#include "simd/kernel/lanes/portable.hpp"

#include <xsimd/xsimd.hpp>

#include <array>
#include <cstdint>
#include <type_traits>
#ifdef __x86_64__
#include <immintrin.h>
#endif
#ifdef __aarch64__
#include "simd/kernel/lanes/neon/registers.hpp"
#endif

/// Vector registers, with the operations that xsimd lacks in some or all of its versions.
/// Everything in kernel/ is a template over the instruction set, so that two kernel units never
/// share an inline function. Otherwise the linker could keep the copy that an older processor
/// cannot run.
namespace raylane::simd {

using Sse42 = xsimd::sse4_2;
using Avx2 = xsimd::fma3<xsimd::avx2>;
using Avx512 = xsimd::avx512f;

namespace detail {

template <Isa isa>
struct ArchOf;
template <>
struct ArchOf<Isa::portable> {
    using Type = Portable;
};
template <>
struct ArchOf<Isa::sse42> {
    using Type = Sse42;
};
template <>
struct ArchOf<Isa::avx2> {
    using Type = Avx2;
};
template <>
struct ArchOf<Isa::avx512> {
    using Type = Avx512;
};
#ifdef __aarch64__
template <>
struct ArchOf<Isa::neon> {
    using Type = Neon;
};
#endif

} // namespace detail

template <Isa isa>
using ArchOf = typename detail::ArchOf<isa>::Type;

/// Names the same architecture as Arch, with lanes of doubles. Its Lanes are in doubles.hpp.
template <class Arch>
struct Double {};

template <class Arch>
struct Registers {
    using Floats = xsimd::batch<float, Arch>;
    using Mask = xsimd::batch_bool<float, Arch>;
};
template <class Arch>
struct Registers<Double<Arch>> {
    using Floats = xsimd::batch<double, Arch>;
    using Mask = xsimd::batch_bool<double, Arch>;
};
template <>
struct Registers<Portable> {
    using Floats = PortableBatch<float>;
    using Mask = PortableMask<float>;
};
template <>
struct Registers<Double<Portable>> {
    using Floats = PortableBatch<double>;
    using Mask = PortableMask<double>;
};

template <class Arch>
using Floats = typename Registers<Arch>::Floats;
template <class Arch>
using Mask = typename Registers<Arch>::Mask;

/// Returns the lanes in which two masks differ. With AVX-512, xsimd 8.1's operator ^ of masks is an
/// or.
template <class AnyMask>
AnyMask differ(const AnyMask& a, const AnyMask& b) {
    return (a & ~b) | (~a & b);
}

/// Returns the same bits as lanes of another type of the same size.
template <class To, class From, class Arch>
xsimd::batch<To, Arch> bits_as(const xsimd::batch<From, Arch>& from) {
#if XSIMD_VERSION_MAJOR < 11
    return xsimd::bitwise_cast<xsimd::batch<To, Arch>>(from);
#else
    return xsimd::bitwise_cast<To>(from);
#endif
}

#if XSIMD_VERSION_MAJOR >= 14
/// Returns b if an operand is NaN, and for two zeros, as SSE and older versions of xsimd do.
template <class Number, class Arch>
requires std::is_floating_point_v<Number> xsimd::batch<Number, Arch>
min(const xsimd::batch<Number, Arch>& a, const xsimd::batch<Number, Arch>& b) {
    return xsimd::min(b, a);
}
template <class Number, class Arch>
requires std::is_floating_point_v<Number> xsimd::batch<Number, Arch>
max(const xsimd::batch<Number, Arch>& a, const xsimd::batch<Number, Arch>& b) {
    return xsimd::max(b, a);
}
#endif

/// Operations of a register of floats. "Integers" are 32-bit integers in the bits of floats.
///   bits             lane i of a mask as bit i
///   compress_store   writes the wanted lanes, in their order, to `out`; may write a whole register
///   has_mul_add      true if mul_add is one instruction
///   mul_add          a * b + c, rounded once
///   least, greatest  the minimum and the maximum of all lanes
///   narrow           doubles from memory, rounded to float
///   gather           floats at the given indices
///   in_range         first <= id <= last, for integers
///   add              the sum of integers
///   unpack_24        24-bit integers from memory as integers; reads up to 64 bytes
///   look_up          floats at integer indices, of which only the lowest 4 bits count
template <class Arch>
struct Lanes;

/// Returns a + b in double, rounded to odd. Rounding the result to float gives the correctly
/// rounded sum (Boldo and Melquiond, "Emulation of FMA and correctly rounded sums: proved
/// algorithms using rounding to odd", 2008).
template <class Number>
Number sum_to_odd(const Number& a, const Number& b) {
    const Number sum = a + b;
    const Number part = sum - a;
    const Number error = (a - (sum - part)) + (b - part);
    const Number zero(0.0);
    using Bits = decltype(bits_as<std::uint64_t>(sum));
    const Bits bits = bits_as<std::uint64_t>(sum), one(std::uint64_t{1});
    // If the sum is even, its last bit moves by one towards the error.
    const Bits shrinks = (bits_as<std::uint64_t>(error) ^ bits) >> 63;
    const Bits from_even = shrinks ^ (shrinks & bits);
    const Bits odd = (bits | one) - (from_even << 1);
    // Only NaN differs from itself, and infinite sums have NaN errors.
    const auto inexact = (error < zero) | (error > zero);
    return select(inexact, bits_as<double>(odd), sum);
}

/// Lanes on any processor.
template <>
struct Lanes<Portable> {
    using F = Floats<Portable>;
    using M = Mask<Portable>;
    static constexpr bool has_mul_add = false;
    static std::uint32_t bits(const M& mask) { return mask.bits(); }
    static void compress_store(float* out, const F& values, std::uint32_t wanted) {
        for (std::size_t i = 0; i < F::size; ++i) {
            const float lane = values.lanes()[i];
            __builtin_memcpy(out, &lane, sizeof(lane)); // there may be integers at `out`
            out += wanted >> i & 1;
        }
    }
    static F mul_add(const F& a, const F& b, const F& c) {
        double sums[F::size];
        for (int half = 0; half < 2; ++half) {
            const auto product = widened(a, half) * widened(b, half);
            sum_to_odd(product, widened(c, half)).store_unaligned(sums + 2 * half);
        }
        return narrow(sums);
    }
    static float least(const F& values) { return most<true>(values.lanes()); }
    static float greatest(const F& values) { return most<false>(values.lanes()); }
    static F narrow(const double* from) {
        F::Lanes lanes;
        for (std::size_t i = 0; i < F::size; ++i)
            lanes[i] = static_cast<float>(from[i]);
        return F(lanes);
    }
    static F gather(const float* from, const std::uint32_t* places) {
        F::Lanes lanes;
        for (std::size_t i = 0; i < F::size; ++i)
            lanes[i] = from[places[i]];
        return F(lanes);
    }
    static F add(const F& a, const F& b) {
        return bits_as<float>(bits_as<std::uint32_t>(a) + bits_as<std::uint32_t>(b));
    }
    static F unpack_24(const std::uint8_t* from) {
        PortableBatch<std::uint32_t>::Lanes lanes;
        for (std::size_t i = 0; i < F::size; ++i)
            lanes[i] = from[3 * i] | std::uint32_t{from[3 * i + 1]} << 8 |
                       std::uint32_t{from[3 * i + 2]} << 16;
        return bits_as<float>(PortableBatch<std::uint32_t>(lanes));
    }
    static F look_up(const float* from, const F& places) {
        std::uint32_t numbers[F::size];
        bits_as<std::uint32_t>(places).store_unaligned(numbers);
        for (std::uint32_t& number : numbers)
            number &= 15;
        return gather(from, numbers);
    }
    static M in_range(const F& id, const F& first, const F& last) {
        const auto from = bits_as<std::uint32_t>(first);
        return M(
            (bits_as<std::uint32_t>(id) - from <= bits_as<std::uint32_t>(last) - from).lanes());
    }

  private:
    template <bool is_least>
    static float most(const F::Lanes& lanes) {
        float result = lanes[0];
        for (std::size_t i = 1; i < F::size; ++i)
            result = (is_least ? lanes[i] < result : lanes[i] > result) ? lanes[i] : result;
        return result;
    }
};

#ifdef __SSE4_2__
template <>
struct Lanes<Sse42> {
    static constexpr bool has_mul_add = false;
    static std::uint32_t bits(const Mask<Sse42>& mask) {
        return static_cast<std::uint32_t>(_mm_movemask_ps(mask));
    }

    static void compress_store(float* out, const Floats<Sse42>& values, std::uint32_t wanted) {
        const __m128i order = _mm_load_si128(reinterpret_cast<const __m128i*>(&orders[wanted]));
        const __m128i bytes = _mm_castps_si128(values);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(bytes, order));
    }

    /// Computes the product in double, where it is exact.
    ///
    /// The solvers need this to have the scalar reference's bits, and are therefore as slow as the
    /// reference here. The engine's filters and double arithmetic need no fused operations. They
    /// give the same bits in images, at half of AVX2's speed.
    static Floats<Sse42> mul_add(const Floats<Sse42>& a, const Floats<Sse42>& b,
                                 const Floats<Sse42>& c) {
        const __m128 low = by_double(a, b, c);
        const __m128 high =
            by_double(_mm_movehl_ps(a, a), _mm_movehl_ps(b, b), _mm_movehl_ps(c, c));
        return _mm_movelh_ps(low, high);
    }

    static float least(const Floats<Sse42>& values) {
        const __m128 two = _mm_min_ps(values, _mm_movehl_ps(values, values));
        return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
    }
    static float greatest(const Floats<Sse42>& values) {
        const __m128 two = _mm_max_ps(values, _mm_movehl_ps(values, values));
        return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
    }

    static Floats<Sse42> narrow(const double* from) {
        return _mm_movelh_ps(_mm_cvtpd_ps(_mm_loadu_pd(from)),
                             _mm_cvtpd_ps(_mm_loadu_pd(from + 2)));
    }

    static Floats<Sse42> gather(const float* from, const std::uint32_t* places) {
        return _mm_setr_ps(from[places[0]], from[places[1]], from[places[2]], from[places[3]]);
    }

    static Floats<Sse42> add(const Floats<Sse42>& a, const Floats<Sse42>& b) {
        return _mm_castsi128_ps(_mm_add_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
    }
    static Floats<Sse42> unpack_24(const std::uint8_t* from) {
        const __m128i packed = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
        return _mm_castsi128_ps(_mm_shuffle_epi8(
            packed, _mm_setr_epi8(0, 1, 2, -1, 3, 4, 5, -1, 6, 7, 8, -1, 9, 10, 11, -1)));
    }
    static Floats<Sse42> look_up(const float* from, const Floats<Sse42>& places) {
        const __m128i at = _mm_and_si128(_mm_castps_si128(places), _mm_set1_epi32(15));
        return _mm_setr_ps(from[_mm_cvtsi128_si32(at)], from[_mm_extract_epi32(at, 1)],
                           from[_mm_extract_epi32(at, 2)], from[_mm_extract_epi32(at, 3)]);
    }

    static Mask<Sse42> in_range(const Floats<Sse42>& id, const Floats<Sse42>& first,
                                const Floats<Sse42>& last) {
        const __m128i from = _mm_castps_si128(first);
        const __m128i offset = _mm_sub_epi32(_mm_castps_si128(id), from);
        const __m128i most = _mm_sub_epi32(_mm_castps_si128(last), from);
        return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_min_epu32(offset, most), offset));
    }

  private:
    static __m128 by_double(__m128 a, __m128 b, __m128 c) {
        using Number = Floats<Double<Sse42>>;
        const Number product = Number(_mm_cvtps_pd(a)) * Number(_mm_cvtps_pd(b));
        return _mm_cvtpd_ps(sum_to_odd(product, Number(_mm_cvtps_pd(c))));
    }

    struct alignas(16) Order {
        std::uint8_t bytes[16];
    };
    static constexpr std::array<Order, 16> orders = [] {
        std::array<Order, 16> orders{};
        for (unsigned wanted = 0; wanted < 16; ++wanted) {
            unsigned to = 0;
            for (unsigned lane = 0; lane < 4; ++lane) {
                if ((wanted >> lane & 1) == 0) continue;
                for (unsigned byte = 0; byte < 4; ++byte)
                    orders[wanted].bytes[4 * to + byte] =
                        static_cast<std::uint8_t>(4 * lane + byte);
                ++to;
            }
        }
        return orders;
    }();
};
#endif

#if defined(__AVX2__) && defined(__FMA__)
template <>
struct Lanes<Avx2> {
    static constexpr bool has_mul_add = true;
    static std::uint32_t bits(const Mask<Avx2>& mask) {
        return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
    }

    static void compress_store(float* out, const Floats<Avx2>& values, std::uint32_t wanted) {
        const __m128i packed = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&orders[wanted]));
        _mm256_storeu_ps(out, _mm256_permutevar8x32_ps(values, _mm256_cvtepu8_epi32(packed)));
    }

    static Floats<Avx2> mul_add(const Floats<Avx2>& a, const Floats<Avx2>& b,
                                const Floats<Avx2>& c) {
        return _mm256_fmadd_ps(a, b, c);
    }

    static float least(const Floats<Avx2>& values) {
        const __m128 four =
            _mm_min_ps(_mm256_castps256_ps128(values), _mm256_extractf128_ps(values, 1));
        const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
        return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
    }
    static float greatest(const Floats<Avx2>& values) {
        const __m128 four =
            _mm_max_ps(_mm256_castps256_ps128(values), _mm256_extractf128_ps(values, 1));
        const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
        return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
    }

    static Floats<Avx2> narrow(const double* from) {
        return _mm256_set_m128(_mm256_cvtpd_ps(_mm256_loadu_pd(from + 4)),
                               _mm256_cvtpd_ps(_mm256_loadu_pd(from)));
    }

    // Faster than the gather instruction where that is microcode.
    static Floats<Avx2> gather(const float* from, const std::uint32_t* places) {
        const auto at = [&](int i) { return from[places[i]]; };
        return _mm256_setr_ps(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7));
    }

    static Floats<Avx2> add(const Floats<Avx2>& a, const Floats<Avx2>& b) {
        return _mm256_castsi256_ps(
            _mm256_add_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
    }
    static Floats<Avx2> unpack_24(const std::uint8_t* from) {
        const __m256i packed = _mm256_loadu2_m128i(reinterpret_cast<const __m128i*>(from + 12),
                                                   reinterpret_cast<const __m128i*>(from));
        const __m128i order = _mm_setr_epi8(0, 1, 2, -1, 3, 4, 5, -1, 6, 7, 8, -1, 9, 10, 11, -1);
        return _mm256_castsi256_ps(_mm256_shuffle_epi8(packed, _mm256_broadcastsi128_si256(order)));
    }
    static Floats<Avx2> look_up(const float* from, const Floats<Avx2>& places) {
        const __m256i at = _mm256_castps_si256(places);
        const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(from), at);
        const __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(from + 8), at);
        return _mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32(at, 28)));
    }

    static Mask<Avx2> in_range(const Floats<Avx2>& id, const Floats<Avx2>& first,
                               const Floats<Avx2>& last) {
        const __m256i from = _mm256_castps_si256(first);
        const __m256i offset = _mm256_sub_epi32(_mm256_castps_si256(id), from);
        const __m256i most = _mm256_sub_epi32(_mm256_castps_si256(last), from);
        return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_min_epu32(offset, most), offset));
    }

  private:
    static constexpr std::array<std::array<std::uint8_t, 8>, 256> orders = [] {
        std::array<std::array<std::uint8_t, 8>, 256> orders{};
        for (unsigned wanted = 0; wanted < 256; ++wanted) {
            unsigned to = 0;
            for (unsigned lane = 0; lane < 8; ++lane)
                if ((wanted >> lane & 1) != 0)
                    orders[wanted][to++] = static_cast<std::uint8_t>(lane);
        }
        return orders;
    }();
};
#endif

#ifdef __AVX512F__
template <>
struct Lanes<Avx512> {
    static constexpr bool has_mul_add = true;
    static std::uint32_t bits(const Mask<Avx512>& mask) {
        return static_cast<std::uint32_t>(static_cast<__mmask16>(mask));
    }

    static void compress_store(float* out, const Floats<Avx512>& values, std::uint32_t wanted) {
        // Compressing directly to memory takes several times as long.
        _mm512_storeu_ps(out, _mm512_maskz_compress_ps(static_cast<__mmask16>(wanted), values));
    }

    static Floats<Avx512> mul_add(const Floats<Avx512>& a, const Floats<Avx512>& b,
                                  const Floats<Avx512>& c) {
        return _mm512_fmadd_ps(a, b, c);
    }

    static float least(const Floats<Avx512>& values) { return _mm512_reduce_min_ps(values); }
    static float greatest(const Floats<Avx512>& values) { return _mm512_reduce_max_ps(values); }

    static Floats<Avx512> narrow(const double* from) {
        const __m256 low = _mm512_cvtpd_ps(_mm512_loadu_pd(from));
        const __m256 high = _mm512_cvtpd_ps(_mm512_loadu_pd(from + 8));
        return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
    }

    static Floats<Avx512> gather(const float* from, const std::uint32_t* places) {
        const auto at = [&](int i) { return from[places[i]]; };
        return _mm512_setr_ps(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9),
                              at(10), at(11), at(12), at(13), at(14), at(15));
    }

    static Floats<Avx512> add(const Floats<Avx512>& a, const Floats<Avx512>& b) {
        return _mm512_castsi512_ps(
            _mm512_add_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
    }
    static Floats<Avx512> unpack_24(const std::uint8_t* from) {
        const __m512i quarters = _mm512_permutexvar_epi32(
            _mm512_setr_epi32(0, 1, 2, 3, 3, 4, 5, 6, 6, 7, 8, 9, 9, 10, 11, 12),
            _mm512_loadu_si512(from));
        const __m128i order = _mm_setr_epi8(0, 1, 2, -1, 3, 4, 5, -1, 6, 7, 8, -1, 9, 10, 11, -1);
        return _mm512_castsi512_ps(_mm512_shuffle_epi8(quarters, _mm512_broadcast_i32x4(order)));
    }
    static Floats<Avx512> look_up(const float* from, const Floats<Avx512>& places) {
        return _mm512_permutexvar_ps(_mm512_castps_si512(places), _mm512_loadu_ps(from));
    }

    static Mask<Avx512> in_range(const Floats<Avx512>& id, const Floats<Avx512>& first,
                                 const Floats<Avx512>& last) {
        const __m512i from = _mm512_castps_si512(first);
        const __m512i offset = _mm512_sub_epi32(_mm512_castps_si512(id), from);
        const __m512i most = _mm512_sub_epi32(_mm512_castps_si512(last), from);
        return _mm512_cmple_epu32_mask(offset, most);
    }
};
#endif

} // namespace raylane::simd

#ifdef __aarch64__
#include "simd/kernel/lanes/neon/lanes.hpp"
#endif
