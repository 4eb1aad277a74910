#pragma once

#include "simd/kernel/lanes/vectors.hpp"

/// Lanes of doubles, half as many as of floats, with the operations that fill them from arrays of
/// floats and of 32-bit integers.
///
/// No multiply-add is fused, so every instruction set, and any scalar code, gives the same bits.
namespace raylane::simd {

/// Numbers of a table, one per lane: base[offsets[lane]], or the same of `doubles` if it is not
/// null.
template <class Arch>
struct Spots {
    const float* base;
    const double* doubles;
    long long offsets[Floats<Double<Arch>>::size];
};

/// Operations of a register of doubles:
///   bits, from_bits           lane i of a mask as bit i
///   in_range                  first <= value <= last, for unsigned integers in memory
///   from_numbers, to_numbers  convert integers below 2^31 in memory
///   gather                    the floats at some spots, `row` further on
///   pick                      from[places[lane]]
///   widen                     half of a packet of floats, the lower (0) or the upper one (1)
///   product_error             a b - product, exactly, for the rounded product of a and b
///   round_alike               whether a and b are the same when rounded to float
///   compress_store            writes the wanted lanes, in their order, to `out`; may write a whole
///                             register
template <class Arch>
struct DoubleLanes;

/// Returns product_error without fused operations, for operands below 2^995 (Dekker 1971).
template <class Number>
Number product_error_by_halves(const Number& a, const Number& b, const Number& product) {
    const Number split(0x1p27 + 1.0), scaled_a = split * a, scaled_b = split * b;
    const Number a_high = scaled_a - (scaled_a - a), b_high = scaled_b - (scaled_b - b);
    const Number a_low = a - a_high, b_low = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

template <>
struct DoubleLanes<Portable> {
    using F = Floats<Double<Portable>>;
    using M = Mask<Double<Portable>>;

    static std::uint32_t bits(const M& mask) { return mask.bits(); }
    static M from_bits(std::uint32_t bits) { return mask((bits & 1) != 0, (bits & 2) != 0); }
    static M in_range(const std::uint32_t* value, const std::uint32_t* first,
                      const std::uint32_t* last) {
        return mask(value[0] - first[0] <= last[0] - first[0],
                    value[1] - first[1] <= last[1] - first[1]);
    }
    static M in_range(const std::uint32_t* value, std::uint32_t first, std::uint32_t last) {
        return mask(value[0] - first <= last - first, value[1] - first <= last - first);
    }
    static F from_numbers(const std::uint32_t* from, std::uint32_t kept) {
        return pair(static_cast<std::int32_t>(from[0] & kept),
                    static_cast<std::int32_t>(from[1] & kept));
    }
    static void to_numbers(std::uint32_t* out, const F& values) {
        for (int lane = 0; lane < 2; ++lane)
            out[lane] = static_cast<std::uint32_t>(static_cast<std::int32_t>(values.lanes()[lane]));
    }
    static F gather(const Spots<Portable>& spots, int row) {
        const float* const from = spots.base + row;
        return pair(static_cast<double>(from[spots.offsets[0]]),
                    static_cast<double>(from[spots.offsets[1]]));
    }

    static F widen(const Floats<Portable>& values, int half) { return widened(values, half); }
    static F product_error(const F& a, const F& b, const F& product) {
        return product_error_by_halves(a, b, product);
    }
    static M round_alike(const F& a, const F& b) {
        return mask(in_float(a, 0) == in_float(b, 0), in_float(a, 1) == in_float(b, 1));
    }
    static F pick(const double* from, const std::uint32_t* places) {
        return pair(from[places[0]], from[places[1]]);
    }
    static void compress_store(double* out, const F& values, std::uint32_t wanted) {
        out[0] = values.lanes()[wanted == 2 ? 1 : 0];
        out[1] = values.lanes()[1];
    }

  private:
    static M mask(bool first, bool second) { return M(M::Lanes{first ? -1 : 0, second ? -1 : 0}); }
    static F pair(double first, double second) { return F(F::Lanes{first, second}); }
    static float in_float(const F& values, int lane) {
        return static_cast<float>(values.lanes()[lane]);
    }
};

#ifdef __SSE4_2__
template <>
struct DoubleLanes<Sse42> {
    using F = Floats<Double<Sse42>>;
    using M = Mask<Double<Sse42>>;

    static std::uint32_t bits(const M& mask) {
        return static_cast<std::uint32_t>(_mm_movemask_pd(mask));
    }
    static M from_bits(std::uint32_t bits) {
        const __m128i lane = _mm_set_epi64x(2, 1);
        const __m128i wanted = _mm_and_si128(_mm_set1_epi64x(bits), lane);
        return M(_mm_castsi128_pd(_mm_cmpeq_epi64(wanted, lane)));
    }
    static M in_range(const std::uint32_t* value, const std::uint32_t* first,
                      const std::uint32_t* last) {
        return in_range(load(value), load(first), load(last));
    }
    static M in_range(const std::uint32_t* value, std::uint32_t first, std::uint32_t last) {
        return in_range(load(value), _mm_set1_epi32(static_cast<int>(first)),
                        _mm_set1_epi32(static_cast<int>(last)));
    }
    static F from_numbers(const std::uint32_t* from, std::uint32_t kept) {
        return F(
            _mm_cvtepi32_pd(_mm_and_si128(load(from), _mm_set1_epi32(static_cast<int>(kept)))));
    }
    static void to_numbers(std::uint32_t* out, const F& values) {
        _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_cvttpd_epi32(values));
    }
    static F gather(const Spots<Sse42>& spots, int row) {
        const float* const from = spots.base + row;
        return F(
            _mm_cvtps_pd(_mm_setr_ps(from[spots.offsets[0]], from[spots.offsets[1]], 0.0F, 0.0F)));
    }

    static F widen(const Floats<Sse42>& values, int half) {
        const __m128 lanes = values;
        return F(_mm_cvtps_pd(half == 0 ? lanes : _mm_movehl_ps(lanes, lanes)));
    }
    static F product_error(const F& a, const F& b, const F& product) {
        return product_error_by_halves(a, b, product);
    }
    static M round_alike(const F& a, const F& b) {
        const __m128 same = _mm_cmpeq_ps(_mm_cvtpd_ps(a), _mm_cvtpd_ps(b));
        return M(_mm_castsi128_pd(_mm_cvtepi32_epi64(_mm_castps_si128(same))));
    }
    static F pick(const double* from, const std::uint32_t* places) {
        return F(_mm_setr_pd(from[places[0]], from[places[1]]));
    }
    static void compress_store(double* out, const F& values, std::uint32_t wanted) {
        const __m128d lanes = values;
        _mm_storeu_pd(out, wanted == 2 ? _mm_unpackhi_pd(lanes, lanes) : lanes);
    }

  private:
    static __m128i load(const std::uint32_t* from) {
        return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
    }
    static M in_range(__m128i value, __m128i first, __m128i last) {
        const __m128i offset = _mm_sub_epi32(value, first), most = _mm_sub_epi32(last, first);
        const __m128i within = _mm_cmpeq_epi32(_mm_min_epu32(offset, most), offset);
        return M(_mm_castsi128_pd(_mm_cvtepi32_epi64(within)));
    }
};
#endif

#if defined(__AVX2__) && defined(__FMA__)
template <>
struct DoubleLanes<Avx2> {
    using F = Floats<Double<Avx2>>;
    using M = Mask<Double<Avx2>>;

    static std::uint32_t bits(const M& mask) {
        return static_cast<std::uint32_t>(_mm256_movemask_pd(mask));
    }
    static M from_bits(std::uint32_t bits) {
        const __m256i lane = _mm256_set_epi64x(8, 4, 2, 1);
        const __m256i wanted = _mm256_and_si256(_mm256_set1_epi64x(bits), lane);
        return M(_mm256_castsi256_pd(_mm256_cmpeq_epi64(wanted, lane)));
    }
    static M in_range(const std::uint32_t* value, const std::uint32_t* first,
                      const std::uint32_t* last) {
        return in_range(load(value), load(first), load(last));
    }
    static M in_range(const std::uint32_t* value, std::uint32_t first, std::uint32_t last) {
        return in_range(load(value), _mm_set1_epi32(static_cast<int>(first)),
                        _mm_set1_epi32(static_cast<int>(last)));
    }
    static F from_numbers(const std::uint32_t* from, std::uint32_t kept) {
        return F(
            _mm256_cvtepi32_pd(_mm_and_si128(load(from), _mm_set1_epi32(static_cast<int>(kept)))));
    }
    static void to_numbers(std::uint32_t* out, const F& values) {
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm256_cvttpd_epi32(values));
    }
    static F gather(const Spots<Avx2>& spots, int row) {
        const float* const from = spots.base + row;
        return F(_mm256_cvtps_pd(_mm_setr_ps(from[spots.offsets[0]], from[spots.offsets[1]],
                                             from[spots.offsets[2]], from[spots.offsets[3]])));
    }

    static F widen(const Floats<Avx2>& values, int half) {
        const __m256 lanes = values;
        return F(_mm256_cvtps_pd(half == 0 ? _mm256_castps256_ps128(lanes)
                                           : _mm256_extractf128_ps(lanes, 1)));
    }
    static F product_error(const F& a, const F& b, const F& product) {
        return F(_mm256_fmsub_pd(a, b, product));
    }
    static M round_alike(const F& a, const F& b) {
        const __m128 same = _mm_cmpeq_ps(_mm256_cvtpd_ps(a), _mm256_cvtpd_ps(b));
        return M(_mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm_castps_si128(same))));
    }
    static F pick(const double* from, const std::uint32_t* places) {
        return F(
            _mm256_setr_pd(from[places[0]], from[places[1]], from[places[2]], from[places[3]]));
    }
    static void compress_store(double* out, const F& values, std::uint32_t wanted) {
        const __m256i order =
            _mm256_load_si256(reinterpret_cast<const __m256i*>(orders[wanted].lanes));
        _mm256_storeu_ps(reinterpret_cast<float*>(out),
                         _mm256_permutevar8x32_ps(_mm256_castpd_ps(values), order));
    }

  private:
    /// Order of lanes, as pairs of 32-bit halves.
    struct alignas(32) Order {
        std::int32_t lanes[8];
    };
    static constexpr std::array<Order, 16> orders = [] {
        std::array<Order, 16> orders{};
        for (unsigned wanted = 0; wanted < 16; ++wanted) {
            int to = 0;
            for (int lane = 0; lane < 4; ++lane) {
                if ((wanted >> lane & 1) == 0) continue;
                orders[wanted].lanes[to++] = 2 * lane;
                orders[wanted].lanes[to++] = 2 * lane + 1;
            }
        }
        return orders;
    }();

    static __m128i load(const std::uint32_t* from) {
        return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    }
    static M in_range(__m128i value, __m128i first, __m128i last) {
        const __m128i offset = _mm_sub_epi32(value, first), most = _mm_sub_epi32(last, first);
        const __m128i within = _mm_cmpeq_epi32(_mm_min_epu32(offset, most), offset);
        return M(_mm256_castsi256_pd(_mm256_cvtepi32_epi64(within)));
    }
};
#endif

#ifdef __AVX512F__
template <>
struct DoubleLanes<Avx512> {
    using F = Floats<Double<Avx512>>;
    using M = Mask<Double<Avx512>>;

    static std::uint32_t bits(const M& mask) {
        return static_cast<std::uint32_t>(static_cast<__mmask8>(mask));
    }
    static M from_bits(std::uint32_t bits) { return M(static_cast<__mmask8>(bits)); }
    static M in_range(const std::uint32_t* value, const std::uint32_t* first,
                      const std::uint32_t* last) {
        return in_range(load(value), load(first), load(last));
    }
    static M in_range(const std::uint32_t* value, std::uint32_t first, std::uint32_t last) {
        return in_range(load(value), _mm256_set1_epi32(static_cast<int>(first)),
                        _mm256_set1_epi32(static_cast<int>(last)));
    }
    static F from_numbers(const std::uint32_t* from, std::uint32_t kept) {
        return F(_mm512_cvtepi32_pd(
            _mm256_and_si256(load(from), _mm256_set1_epi32(static_cast<int>(kept)))));
    }
    static void to_numbers(std::uint32_t* out, const F& values) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm512_cvttpd_epi32(values));
    }
    static F gather(const Spots<Avx512>& spots, int row) {
        // Faster than the gather instruction where that is microcode.
        const float* const from = spots.base + row;
        const long long* const at = spots.offsets;
        return F(
            _mm512_cvtps_pd(_mm256_setr_ps(from[at[0]], from[at[1]], from[at[2]], from[at[3]],
                                           from[at[4]], from[at[5]], from[at[6]], from[at[7]])));
    }

    static F widen(const Floats<Avx512>& values, int half) {
        const __m512 lanes = values;
        return F(_mm512_cvtps_pd(half == 0 ? _mm512_castps512_ps256(lanes)
                                           : _mm512_extractf32x8_ps(lanes, 1)));
    }
    static F product_error(const F& a, const F& b, const F& product) {
        return F(_mm512_fmsub_pd(a, b, product));
    }
    static M round_alike(const F& a, const F& b) {
        return M(_mm256_cmp_ps_mask(_mm512_cvtpd_ps(a), _mm512_cvtpd_ps(b), _CMP_EQ_OQ));
    }
    static F pick(const double* from, const std::uint32_t* places) {
        return F(_mm512_i32gather_pd(load(places), from, 8));
    }
    static void compress_store(double* out, const F& values, std::uint32_t wanted) {
        // Compressing directly to memory takes several times as long.
        _mm512_storeu_pd(out, _mm512_maskz_compress_pd(static_cast<__mmask8>(wanted), values));
    }

  private:
    static __m256i load(const std::uint32_t* from) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    }
    static M in_range(__m256i value, __m256i first, __m256i last) {
        const __m256i offset = _mm256_sub_epi32(value, first), most = _mm256_sub_epi32(last, first);
        return M(_mm256_cmple_epu32_mask(offset, most));
    }
};
#endif

} // namespace raylane::simd

#ifdef __aarch64__
#include "simd/kernel/lanes/neon/doubles.hpp"
#endif

namespace raylane::simd {

template <class Arch>
struct Lanes<Double<Arch>> : DoubleLanes<Arch> {
    using F = Floats<Double<Arch>>;
    static F mul_add(const F& a, const F& b, const F& c) { return a * b + c; }
};

/// A reader of one half of the lanes of another reader, in double.
template <class Arch, class Reader>
class HalfReader {
  public:
    HalfReader(const Reader& reader, int half) : reader_(reader), half_(half) {}
    Floats<Double<Arch>> next() { return Lanes<Double<Arch>>::widen(reader_.next(), half_); }

  private:
    Reader reader_;
    int half_;
};

} // namespace raylane::simd
