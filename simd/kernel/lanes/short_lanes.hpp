#pragma once

#include "simd/kernel/lanes/lanes.hpp"

/// Lanes of 16 and of 8 bits: ray numbers, sets of children, distances to sort by, states.
namespace raylane::simd {

/// Operations of short lanes:
///   pick            writes those of `count` numbers whose masks have a bit to `out`, in their
///                   order; returns how many; may read and write 16 more
///   compress_keys   writes bits 15 to 30 of the wanted lanes, in their order, to `out`; they sort
///                   like the values where these are positive; may write as many numbers as there
///                   are lanes, and at least 8
///   min_of_16     the first index of the minimum of 16 numbers; and, 16 bits higher, the minimum
///   equal_16        bit i is set if byte i of 16 equals the value
///   raise_16        raises the bytes whose bits are set, of 16, to the value if they are less
template <class Arch>
struct ShortLanes;

/// Short lanes implemented by loops over memory.
template <>
struct ShortLanes<Portable> {
    static int pick(const std::uint16_t* numbers, const std::uint16_t* masks, int count,
                    unsigned bit, std::uint16_t* out) {
        int picked = 0;
        for (int k = 0; k < count; ++k) {
            out[picked] = numbers[k];
            picked += masks[k] >> bit & 1;
        }
        return picked;
    }
    static void compress_keys(std::uint16_t* out, const Floats<Portable>& values,
                              std::uint32_t wanted) {
        const auto keys = bits_as<std::uint32_t>(values) >> 15;
        for (std::size_t i = 0; i < keys.size; ++i)
            if ((wanted >> i & 1) != 0) *out++ = static_cast<std::uint16_t>(keys.lanes()[i]);
    }
    static std::uint32_t min_of_16(const std::uint16_t* keys) {
        std::uint32_t least = 0;
        for (std::uint32_t i = 1; i < 16; ++i)
            least = keys[i] < keys[least] ? i : least;
        return std::uint32_t{keys[least]} << 16 | least;
    }
    static std::uint32_t equal_16(const std::uint8_t* bytes, std::uint8_t value) {
        std::uint32_t equal = 0;
        for (std::uint32_t i = 0; i < 16; ++i)
            equal |= static_cast<std::uint32_t>(bytes[i] == value) << i;
        return equal;
    }
    static void raise_16(std::uint8_t* bytes, std::uint32_t which, std::uint8_t least) {
        for (std::uint32_t i = 0; i < 16; ++i)
            if ((which >> i & 1) != 0 && bytes[i] < least) bytes[i] = least;
    }
};

#ifdef __SSE4_2__
/// Eight lanes by SSE4 instructions, which AVX2 and AVX-512 include.
template <class Arch>
struct EightLanes {
    static __m128i load(const std::uint16_t* from) {
        return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    }

    static std::uint32_t min_of_16(const std::uint16_t* keys) {
        const __m128i low = _mm_minpos_epu16(load(keys)), high = _mm_minpos_epu16(load(keys + 8));
        // _mm_minpos_epu16 returns the index above the minimum. This swaps them.
        const __m128i low_first = _mm_shufflelo_epi16(low, 1);
        const __m128i high_first = _mm_add_epi32(_mm_shufflelo_epi16(high, 1), _mm_set1_epi32(8));
        return static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_min_epu32(low_first, high_first)));
    }

    static std::uint32_t equal_16(const std::uint8_t* bytes, std::uint8_t value) {
        const __m128i row = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
        const __m128i equal = _mm_cmpeq_epi8(row, _mm_set1_epi8(static_cast<char>(value)));
        return static_cast<std::uint32_t>(_mm_movemask_epi8(equal));
    }

    static void raise_16(std::uint8_t* bytes, std::uint32_t which, std::uint8_t least) {
        auto* const place = reinterpret_cast<__m128i*>(bytes);
        // The low half of `which` eight times, then the high half; then one bit of each copy.
        const __m128i halves = _mm_shuffle_epi8(_mm_cvtsi32_si128(static_cast<int>(which)),
                                                _mm_set_epi32(0x01010101, 0x01010101, 0, 0));
        const __m128i bits = _mm_set1_epi64x(static_cast<long long>(0x8040201008040201ULL));
        const __m128i wanted = _mm_cmpeq_epi8(_mm_and_si128(halves, bits), bits);
        const __m128i value = _mm_set1_epi8(static_cast<char>(least));
        _mm_storeu_si128(place, _mm_max_epu8(_mm_loadu_si128(place), _mm_and_si128(wanted, value)));
    }

    /// Writes the wanted numbers, in their order.
    static void compress_store(std::uint16_t* out, __m128i eight, std::uint32_t wanted) {
        const __m128i order =
            _mm_load_si128(reinterpret_cast<const __m128i*>(orders[wanted].bytes));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(eight, order));
    }

    static int pick(const std::uint16_t* numbers, const std::uint16_t* masks, int count,
                    unsigned bit, std::uint16_t* out) {
        const __m128i wanted = _mm_set1_epi16(static_cast<short>(1U << bit));
        int picked = 0;
        for (int k = 0; k < count; k += 8) {
            const __m128i has = _mm_cmpeq_epi16(_mm_and_si128(load(masks + k), wanted), wanted);
            auto bits = static_cast<std::uint32_t>(
                _mm_movemask_epi8(_mm_packs_epi16(has, _mm_setzero_si128())));
            if (count - k < 8) bits &= (1U << (count - k)) - 1;
            compress_store(out + picked, load(numbers + k), bits);
            picked += __builtin_popcount(bits);
        }
        return picked;
    }

  private:
    struct alignas(16) Order {
        std::uint8_t bytes[16];
    };
    static constexpr std::array<Order, 256> orders = [] {
        std::array<Order, 256> orders{};
        for (unsigned wanted = 0; wanted < 256; ++wanted) {
            unsigned to = 0;
            for (unsigned lane = 0; lane < 8; ++lane)
                if ((wanted >> lane & 1) != 0)
                    for (unsigned byte = 0; byte < 2; ++byte)
                        orders[wanted].bytes[to++] = static_cast<std::uint8_t>(2 * lane + byte);
        }
        return orders;
    }();
};

template <>
struct ShortLanes<Sse42> : EightLanes<Sse42> {
    static void compress_keys(std::uint16_t* out, const Floats<Sse42>& values,
                              std::uint32_t wanted) {
        const __m128i keys = _mm_srli_epi32(_mm_slli_epi32(_mm_castps_si128(values), 1), 16);
        compress_store(out, _mm_packus_epi32(keys, keys), wanted);
    }
};
#endif

#if defined(__AVX2__) && defined(__FMA__)
template <>
struct ShortLanes<Avx2> : EightLanes<Avx2> {
    static void compress_keys(std::uint16_t* out, const Floats<Avx2>& values,
                              std::uint32_t wanted) {
        const __m256i keys =
            _mm256_srli_epi32(_mm256_slli_epi32(_mm256_castps_si256(values), 1), 16);
        compress_store(
            out, _mm_packus_epi32(_mm256_castsi256_si128(keys), _mm256_extracti128_si256(keys, 1)),
            wanted);
    }
};
#endif

#ifdef __AVX512F__
template <>
struct ShortLanes<Avx512> : EightLanes<Avx512> {
    static void compress_keys(std::uint16_t* out, const Floats<Avx512>& values,
                              std::uint32_t wanted) {
        const __m512i chosen = _mm512_maskz_compress_epi32(static_cast<__mmask16>(wanted),
                                                           _mm512_castps_si512(values));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                            _mm512_cvtepi32_epi16(_mm512_srli_epi32(chosen, 15)));
    }

    static int pick(const std::uint16_t* numbers, const std::uint16_t* masks, int count,
                    unsigned bit, std::uint16_t* out) {
        const __m256i wanted = _mm256_set1_epi16(static_cast<short>(1U << bit));
        int picked = 0;
        for (int k = 0; k < count; k += 16) {
            std::uint32_t has_bit = _mm256_test_epi16_mask(
                _mm256_loadu_si256(reinterpret_cast<const __m256i*>(masks + k)), wanted);
            if (count - k < 16) has_bit &= (1U << (count - k)) - 1;
            const __m512i chosen = _mm512_cvtepu16_epi32(
                _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers + k)));
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + picked),
                                _mm512_cvtepi32_epi16(_mm512_maskz_compress_epi32(
                                    static_cast<__mmask16>(has_bit), chosen)));
            picked += __builtin_popcount(has_bit);
        }
        return picked;
    }
};
#endif

} // namespace raylane::simd

#ifdef __aarch64__
#include "simd/kernel/lanes/neon/short_lanes.hpp"
#endif
