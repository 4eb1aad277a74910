#pragma once

#include "simd/kernel/lanes/doubles.hpp"
#include "simd/kernel/lanes/short_lanes.hpp"

/// Compares `Lanes` and registers with loops over numbers. Units for one instruction set include
/// this header, so it must not have inline functions that other units share.
namespace raylane::simd {

template <class Arch>
struct LanesCheck {
    static constexpr int size = static_cast<int>(Floats<Arch>::size);

    std::uint64_t state = 1;

    std::uint32_t random() {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::uint32_t>(state >> 32);
    }

    /// Returns a float of any bit pattern, including NaN and denormal numbers, or (`tame`) one with
    /// few exponents, for sums that cancel.
    float random_float(bool tame) {
        std::uint32_t bits = random();
        if (tame) bits = (bits & 0x83FFFFFF) | 0x3C000000;
        return __builtin_bit_cast(float, bits);
    }

    static bool same(float a, float b) {
        return (a != a && b != b) ||
               __builtin_bit_cast(std::uint32_t, a) == __builtin_bit_cast(std::uint32_t, b);
    }
    static bool same(double a, double b) {
        return (a != a && b != b) ||
               __builtin_bit_cast(std::uint64_t, a) == __builtin_bit_cast(std::uint64_t, b);
    }

    /// Returns a number that may be a zero, an infinity or NaN. Equal numbers are frequent.
    template <class Number>
    Number random_number() {
        constexpr float special[] = {0.0F, 1.0F, -1.5F, __builtin_inff(), __builtin_nanf("")};
        const std::uint32_t choice = random() >> 28;
        if (choice < 5)
            return static_cast<Number>(random() >> 31 == 0 ? special[choice] : -special[choice]);
        return static_cast<Number>(random_float(choice % 2 == 0)) / 3;
    }

    /// Checks each lane of registers of floats or doubles against C++, and against SSE where C++
    /// does not define the result.
    template <class F>
    int operation_failures(int rounds) {
        using Number = typename F::value_type;
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            Number a[F::size], b[F::size];
            for (std::size_t i = 0; i < F::size; ++i) {
                a[i] = random_number<Number>();
                b[i] = random_number<Number>();
            }
            const F x = F::load_unaligned(a), y = F::load_unaligned(b);
            const auto check = [&](const F& found, const auto& expected) {
                Number lanes[F::size];
                found.store_unaligned(lanes);
                for (std::size_t i = 0; i < F::size; ++i)
                    failures += same(lanes[i], expected(a[i], b[i])) ? 0 : 1;
            };
            check(x + y, [](Number p, Number q) { return p + q; });
            check(x - y, [](Number p, Number q) { return p - q; });
            check(x * y, [](Number p, Number q) { return p * q; });
            check(x / y, [](Number p, Number q) { return p / q; });
            check(min(x, y), [](Number p, Number q) { return p < q ? p : q; });
            check(max(x, y), [](Number p, Number q) { return p > q ? p : q; });
            check(negated(x), [](Number p, Number) { return -p; });
            check(abs(x), [](Number p, Number) { return __builtin_signbit(p) ? -p : p; });
            check(sqrt(abs(x)), [](Number p, Number) {
                return static_cast<Number>(__builtin_sqrt(__builtin_fabs(static_cast<double>(p))));
            });
            check(floor(x), [](Number p, Number) {
                return static_cast<Number>(__builtin_floor(static_cast<double>(p)));
            });
            check(select(x < y, x, y), [](Number p, Number q) { return p < q ? p : q; });
            check(select(x <= y, x, y), [](Number p, Number q) { return p <= q ? p : q; });
            check(select(x > y, x, y), [](Number p, Number q) { return p > q ? p : q; });
            check(select(x >= y, x, y), [](Number p, Number q) { return p >= q ? p : q; });
            check(select(x == y, x, y), [](Number p, Number q) { return p == q ? p : q; });
            check(select(~(x < y) & (x == x), x, y),
                  [](Number p, Number q) { return !(p < q) && p == p ? p : q; });
            check(select((x < y) | ~(y == y), x, y),
                  [](Number p, Number q) { return p < q || q != q ? p : q; });
            check(select(differ(x < y, y == y), x, y),
                  [](Number p, Number q) { return (p < q) != (q == q) ? p : q; });
            // Only for SSE does xsimd 8.1 say that NaN is unequal.
            check(select((x != y) & (x == x) & (y == y), x, y),
                  [](Number p, Number q) { return p == p && q == q && p != q ? p : q; });
            check((x & F(Number(-0.0))) ^ abs(y), [](Number p, Number q) {
                return __builtin_signbit(p) == __builtin_signbit(q) ? q : -q;
            });
        }
        return failures;
    }

    int double_failures(int rounds) {
        using D = DoubleLanes<Arch>;
        using F = Floats<Double<Arch>>;
        constexpr std::uint32_t full_mask = (1U << F::size) - 1;
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            double a[F::size], b[F::size], lanes[F::size];
            std::uint32_t value[8], first[8], last[8], within = 0, within_first = 0, alike = 0;
            for (std::size_t i = 0; i < F::size; ++i) {
                a[i] = static_cast<double>(random_float(true)) / 3;
                b[i] = random() % 2 == 0 ? a[i] * (1 + 0x1p-40)
                                         : static_cast<double>(random_float(true)) / 7;
                alike |=
                    static_cast<std::uint32_t>(static_cast<float>(a[i]) == static_cast<float>(b[i]))
                    << i;
                first[i] = random();
                value[i] = first[i] + random() % 3 - 1;
                last[i] = first[i] + random() % 2;
                within |= static_cast<std::uint32_t>(value[i] - first[i] <= last[i] - first[i])
                          << i;
                within_first |=
                    static_cast<std::uint32_t>(value[i] - first[0] <= last[0] - first[0]) << i;
            }
            const F x = F::load_unaligned(a), y = F::load_unaligned(b);
            failures += D::bits(D::in_range(value, first, last)) == within ? 0 : 1;
            failures += D::bits(D::in_range(value, first[0], last[0])) == within_first ? 0 : 1;
            failures += D::bits(D::round_alike(x, y)) == alike ? 0 : 1;
            const std::uint32_t wanted = random() & full_mask;
            failures += D::bits(D::from_bits(wanted)) == wanted ? 0 : 1;
            const std::uint32_t others = random() & full_mask;
            failures +=
                D::bits(differ(D::from_bits(wanted), D::from_bits(others))) == (wanted ^ others)
                    ? 0
                    : 1;

            D::product_error(x, y, x * y).store_unaligned(lanes);
            for (std::size_t i = 0; i < F::size; ++i)
                failures += lanes[i] == __builtin_fma(a[i], b[i], -(a[i] * b[i])) ? 0 : 1;
            D::compress_store(lanes, x, wanted);
            int kept = 0;
            for (std::size_t i = 0; i < F::size; ++i)
                if ((wanted >> i & 1) != 0) failures += same(lanes[kept++], a[i]) ? 0 : 1;
            floor(x * F(1e3)).store_unaligned(lanes);
            for (std::size_t i = 0; i < F::size; ++i)
                failures += same(lanes[i], __builtin_floor(a[i] * 1e3)) ? 0 : 1;

            std::uint32_t numbers[8];
            D::to_numbers(numbers, D::from_numbers(value, 0x7FFFFFFF));
            for (std::size_t i = 0; i < F::size; ++i)
                failures += numbers[i] == (value[i] & 0x7FFFFFFF) ? 0 : 1;
        }
        return failures;
    }

    int mul_add_failures(int rounds) {
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            float a[size], b[size], c[size], native[size];
            for (int i = 0; i < size; ++i) {
                const bool tame = round % 2 == 0;
                a[i] = random_float(tame);
                b[i] = random_float(tame);
                c[i] = random_float(tame);
                // A product of about half an ulp of the sum: rounding twice goes wrong there.
                if (round % 4 == 0)
                    c[i] = a[i] * b[i] * 0x1p24F * (random() % 2 == 0 ? 1.0F : -1.0F);
            }
            const auto x = Floats<Arch>::load_unaligned(a), y = Floats<Arch>::load_unaligned(b),
                       z = Floats<Arch>::load_unaligned(c);
            Lanes<Arch>::mul_add(x, y, z).store_unaligned(native);
            for (int i = 0; i < size; ++i)
                failures += same(native[i], __builtin_fmaf(a[i], b[i], c[i])) ? 0 : 1;
        }
        return failures;
    }

    /// The error may be as large as SSE's, which filters rely on.
    int reciprocal_root_failures(int rounds) {
        constexpr double most = 1.5 * 0x1p-12;
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            float a[size], native[size];
            for (float& number : a) // from 2^-100 on
                number = __builtin_bit_cast(float, (random() & 0x3FFFFFFF) + 0x0D800000);
            rsqrt(Floats<Arch>::load_unaligned(a)).store_unaligned(native);
            for (int i = 0; i < size; ++i) {
                const double ratio =
                    static_cast<double>(native[i]) * __builtin_sqrt(static_cast<double>(a[i]));
                failures += ratio >= 1 - most && ratio <= 1 + most ? 0 : 1;
            }
        }
        return failures;
    }

    /// Checks operations that load from elsewhere or convert between types.
    int move_failures(int rounds) {
        using F = Floats<Arch>;
        using D = DoubleLanes<Arch>;
        constexpr int half = size / 2;
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            float table[16], found[size], wide[size];
            double wide_doubles[size];
            std::uint32_t places[size];
            std::uint8_t packed[64];
            for (float& number : table)
                number = random_float(false);
            for (std::uint8_t& byte : packed)
                byte = static_cast<std::uint8_t>(random() >> 24);
            for (int i = 0; i < size; ++i) {
                places[i] = random() >> 28;
                wide_doubles[i] = static_cast<double>(random_float(round % 2 == 0)) / 3;
                wide[i] = __builtin_bit_cast(float, random() << 4 | places[i]);
            }
            const auto check = [&](const F& lanes, const auto& expected) {
                lanes.store_unaligned(found);
                for (int i = 0; i < size; ++i)
                    failures += same(found[i], expected(i)) ? 0 : 1;
            };
            const F x = F::load_unaligned(wide), y = F::load_unaligned(table);
            check(Lanes<Arch>::gather(table, places), [&](int i) { return table[places[i]]; });
            check(Lanes<Arch>::look_up(table, x), [&](int i) { return table[places[i]]; });
            check(Lanes<Arch>::narrow(wide_doubles),
                  [&](int i) { return static_cast<float>(wide_doubles[i]); });
            check(Lanes<Arch>::add(x, y), [&](int i) {
                return __builtin_bit_cast(float, __builtin_bit_cast(std::uint32_t, wide[i]) +
                                                     __builtin_bit_cast(std::uint32_t, table[i]));
            });
            check(Lanes<Arch>::unpack_24(packed), [&](int i) {
                std::uint32_t number = 0;
                __builtin_memcpy(&number, packed + 3 * i, 3);
                return __builtin_bit_cast(float, number);
            });

            float least = table[0], greatest = table[0];
            for (int i = 0; i < size; ++i) {
                if (table[i] != table[i]) table[i] = 1;
                least = i == 0 || table[i] < least ? table[i] : least;
                greatest = i == 0 || table[i] > greatest ? table[i] : greatest;
            }
            const F numbers = F::load_unaligned(table);
            failures += Lanes<Arch>::least(numbers) == least ? 0 : 1;
            failures += Lanes<Arch>::greatest(numbers) == greatest ? 0 : 1;

            double lanes[half];
            Spots<Arch> spots{table, nullptr, {}};
            for (int i = 0; i < half; ++i)
                spots.offsets[i] = places[i] / 2;
            D::gather(spots, 8).store_unaligned(lanes);
            for (int i = 0; i < half; ++i)
                failures += same(static_cast<float>(lanes[i]), table[places[i] / 2 + 8]) ? 0 : 1;
            for (int part = 0; part < 2; ++part) {
                D::widen(x, part).store_unaligned(lanes);
                for (int i = 0; i < half; ++i)
                    failures += same(lanes[i], static_cast<double>(wide[part * half + i])) ? 0 : 1;
            }
            for (std::uint32_t& place : places)
                place %= static_cast<std::uint32_t>(size);
            D::pick(wide_doubles, places).store_unaligned(lanes);
            for (int i = 0; i < half; ++i)
                failures += same(lanes[i], wide_doubles[places[i]]) ? 0 : 1;
        }
        return failures;
    }

    int compress_failures() {
        int failures = 0;
        for (std::uint32_t wanted = 0; wanted < 1U << size; ++wanted) {
            float values[size], native[size] = {};
            for (float& value : values)
                value = random_float(false);
            const auto x = Floats<Arch>::load_unaligned(values);
            Lanes<Arch>::compress_store(native, x, wanted);
            const float* next = native;
            for (int i = 0; i < size; ++i)
                if ((wanted >> i & 1) != 0) failures += same(*next++, values[i]) ? 0 : 1;
        }
        return failures;
    }

    int mask_failures(int rounds) {
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            float id[size], first[size], last[size];
            std::uint32_t expected = 0;
            for (int i = 0; i < size; ++i) {
                const std::uint32_t from = round % 3 == 0 ? 0xFFFFFFFF : random();
                const std::uint32_t offset = random() % 3 - 1, most = random() % 2;
                id[i] = __builtin_bit_cast(float, from + offset);
                first[i] = __builtin_bit_cast(float, from);
                last[i] = __builtin_bit_cast(float, from + most);
                expected |= static_cast<std::uint32_t>(offset <= most) << i;
            }
            const auto x = Floats<Arch>::load_unaligned(id),
                       y = Floats<Arch>::load_unaligned(first),
                       z = Floats<Arch>::load_unaligned(last);
            const Mask<Arch> native = Lanes<Arch>::in_range(x, y, z);
            failures += Lanes<Arch>::bits(native) == expected ? 0 : 1;
        }
        return failures;
    }

    int pick_failures(int rounds) {
        constexpr int most = 70;
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            std::uint16_t numbers[most + 16], masks[most + 16];
            std::uint16_t native[most + 16] = {};
            for (int i = 0; i < most + 16; ++i) {
                numbers[i] = static_cast<std::uint16_t>(random());
                masks[i] = static_cast<std::uint16_t>(random());
            }
            const int count = round % (most + 1);
            const unsigned bit = random() % 16;
            const int picked = ShortLanes<Arch>::pick(numbers, masks, count, bit, native);
            int expected = 0;
            for (int i = 0; i < count; ++i)
                if ((masks[i] >> bit & 1) != 0)
                    failures += expected < picked && native[expected++] == numbers[i] ? 0 : 1;
            failures += picked == expected ? 0 : 1;
        }
        return failures;
    }

    int key_failures(int rounds) {
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            float values[size];
            for (float& value : values) // like distances: not negative, but perhaps -0
                value = round % 16 == 0 ? -0.0F : __builtin_fabsf(random_float(false));
            const std::uint32_t wanted = random() & ((1U << size) - 1);
            const auto x = Floats<Arch>::load_unaligned(values);
            std::uint16_t native[16] = {};
            ShortLanes<Arch>::compress_keys(native, x, wanted);
            const std::uint16_t* next = native;
            for (int i = 0; i < size; ++i)
                if ((wanted >> i & 1) != 0)
                    failures +=
                        *next++ == (__builtin_bit_cast(std::uint32_t, values[i]) >> 15 & 0xFFFF)
                            ? 0
                            : 1;

            std::uint16_t keys[16];
            for (std::uint16_t& key : keys)
                key = static_cast<std::uint16_t>(random() >> (round % 3 == 0 ? 30 : 16));
            const std::uint32_t least = ShortLanes<Arch>::min_of_16(keys), place = least & 0xFFFF;
            failures += place < 16 && keys[place] == least >> 16 ? 0 : 1;
            for (std::uint32_t i = 0; i < 16; ++i)
                failures += keys[i] < least >> 16 || (i < place && keys[i] == least >> 16) ? 1 : 0;
        }
        return failures;
    }

    int byte_failures(int rounds) {
        int failures = 0;
        for (int round = 0; round < rounds; ++round) {
            std::uint8_t bytes[16], native[16];
            for (int i = 0; i < 16; ++i)
                native[i] = bytes[i] =
                    static_cast<std::uint8_t>(random() >> (round % 2 == 0 ? 30 : 24));
            const auto value = static_cast<std::uint8_t>(random() >> (round % 2 == 0 ? 30 : 24));
            const std::uint32_t equal = ShortLanes<Arch>::equal_16(native, value);
            const std::uint32_t which = random() & 0xFFFF;
            ShortLanes<Arch>::raise_16(native, which, value);
            for (int i = 0; i < 16; ++i) {
                failures += (equal >> i & 1) == (bytes[i] == value ? 1U : 0U) ? 0 : 1;
                const bool rises = (which >> i & 1) != 0 && bytes[i] < value;
                failures += native[i] == (rises ? value : bytes[i]) ? 0 : 1;
            }
        }
        return failures;
    }

    static int failures() {
        LanesCheck check;
        return check.mul_add_failures(200000) + check.compress_failures() +
               check.reciprocal_root_failures(20000) + check.move_failures(10000) +
               check.template operation_failures<Floats<Arch>>(20000) +
               check.template operation_failures<Floats<Double<Arch>>>(20000) +
               check.double_failures(20000) + check.mask_failures(10000) +
               check.pick_failures(1000) + check.key_failures(10000) + check.byte_failures(10000);
    }
};

/// Runs LanesCheck; defined in the kernel unit of each instruction set.
template <Isa isa>
int lanes_failures();

} // namespace raylane::simd
