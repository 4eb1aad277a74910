#pragma once

#include "core/numbers/elementary.hpp"

#include <cstdint>

/// Formulas of colours, compiled to straight programs: plain data, and the operations, which are
/// written once for scalars and for registers. The bits are therefore the same in both.
namespace raylane::core {

enum class FormulaOperation : std::uint8_t {
    add,
    subtract,
    multiply,
    divide,
    power,
    less,     ///< 1 or 0, as all comparisons; 0 if a side is undefined
    not_more, ///< <=
    equal,
    unequal, ///< 1 if a side is undefined
    choose,  ///< c where a is 0 or undefined, otherwise b
    min,
    max,
    abs,
    floor,
    mod, ///< a - b floor(a / b)
    sqrt,
    sin,
    cos,
    exp,
    log,
    noise,
};

/// A formula for each channel of a colour, as a list of instructions without jumps. Values have
/// numbers: first the inputs, then the constants, then the results of the instructions.
struct FormulaProgram {
    static constexpr int inputs = 5; ///< x, y, z, u, v
    static constexpr int max_constants = 64, max_instructions = 64;
    static constexpr int max_values = inputs + max_constants + max_instructions;

    struct Instruction {
        FormulaOperation operation;
        std::uint8_t a, b, c; ///< values; operands that the operation lacks repeat a
    };

    std::uint8_t constant_count = 0, instruction_count = 0;
    std::uint8_t channels[3] = {}; ///< the values that are red, green and blue
    bool needs_shape = false;      ///< true if u or v is used
    double constants[max_constants] = {};
    Instruction instructions[max_instructions] = {};
};

/// The operations of `Number`, a double or a register of doubles. Arithmetic is that of IEEE 754.
/// NaN stands for an undefined number, such as sqrt(-1), 0 / 0 or sin(1 / 0).
template <class Number>
struct FormulaOperations {
    /// Calls run(f) with the function f(a, b, c) of an operation.
    template <class Run>
    [[gnu::always_inline]] static inline void with(FormulaOperation operation, const Run& run);

    /// Returns a channel: the number from 0 to 1e10 that is nearest to a result, or 0 for an
    /// undefined one.
    static Number channel(const Number& x) {
        const Number most(1e10);
        return P::select(x > Number(0.0), P::select(x < most, x, most), Number(0.0));
    }

    /// Rounds the coordinates of a point to multiples of 2^-28 of the largest one, as checkers do:
    /// a plane along the axes then has one coordinate that is exact, and no noise from last bits.
    static void round_coordinates(Number& x, Number& y, Number& z);
    static Number power(const Number& x, const Number& y);
    static Number abs(const Number& x) { return P::number(P::bits(x) & Bits(~sign_bit)); }
    static Number floor(const Number& x);
    /// Gradient noise (Perlin 1985): smooth, 0 where all of x, y and z are whole, from -1 to 1. The
    /// gradients at whole points are the eight directions (+-1, +-1, +-1), times 2/3. Weights of
    /// the fifth degree: Perlin, "Improving noise" (2002).
    static Number noise(const Number& x, const Number& y, const Number& z);

  private:
    using P = Primitives<Number>;
    using E = Elementary<Number>;
    using Bits = typename P::Bits;
    using Mask = typename P::Mask;
    static constexpr std::uint64_t sign_bit = std::uint64_t(1) << 63;

    static Number undefined() { return Number(__builtin_nan("")); }
    static Number flag(const Mask& mask) { return P::select(mask, Number(1.0), Number(0.0)); }
    static Mask is_finite(const Number& x) { return abs(x) < Number(__builtin_inf()); }
    /// Returns the bits of a whole number below 2^51 in size, in two's complement, plus a constant.
    static Bits bits_of_whole(const Number& x) { return P::bits(x + Number(0x1.8p52)); }
    static Bits mixed(Bits key);
    static Number slope(const Bits& hash, const Number& x, const Number& y, const Number& z);
    static Number weight(const Number& t);
    static Number between(const Number& a, const Number& b, const Number& weight) {
        return a + weight * (b - a);
    }
};

template <class Number>
void FormulaOperations<Number>::round_coordinates(Number& x, Number& y, Number& z) {
    const auto larger = [](const Number& a, const Number& b) { return P::select(a < b, b, a); };
    const Number size = larger(larger(abs(x), abs(y)), abs(z));
    constexpr std::uint64_t exponent = std::uint64_t(0x7ff) << 52;
    const Number to_round = P::number(P::bits(size) & Bits(exponent)) * Number(0x1.8p24);
    for (Number* coordinate : {&x, &y, &z})
        *coordinate = (*coordinate + to_round) - to_round;
}

/// Negative bases have powers by whole exponents only. 0 has no negative powers: they are infinite.
template <class Number>
Number FormulaOperations<Number>::power(const Number& x, const Number& y) {
    const Number base = abs(x), half = Number(0.5) * y;
    const Number of_positive = P::select((base == Number(0.0)) & (y < Number(0.0)),
                                         Number(__builtin_inf()), E::pow(base, y));
    const Number of_odd = P::select(floor(half) == half, of_positive, Number(0.0) - of_positive);
    const Number of_negative = P::select(floor(y) == y, of_odd, undefined());
    const Number result = P::select(x < Number(0.0), of_negative, of_positive);
    return P::select(is_finite(x), P::select(is_finite(y), result, undefined()), undefined());
}

template <class Number>
Number FormulaOperations<Number>::floor(const Number& x) {
    const Number nearest = (x + Number(0x1.8p52)) - Number(0x1.8p52);
    const Number below = P::select(nearest > x, nearest - Number(1.0), nearest);
    return P::select(abs(x) < Number(0x1p51), below, x); // larger numbers are whole
}

/// Mixes 64 bits, so that each bit of a key changes half of the bits of the result. Source: Wang,
/// "Integer hash function" (2007).
template <class Number>
typename FormulaOperations<Number>::Bits FormulaOperations<Number>::mixed(Bits key) {
    key = (key << 21) - key - Bits(1);
    key = key ^ (key >> 24);
    key = key + (key << 3) + (key << 8);
    key = key ^ (key >> 14);
    key = key + (key << 2) + (key << 4);
    key = key ^ (key >> 28);
    return key + (key << 31);
}

/// Returns the product of (x, y, z) with the gradient that a hash selects.
template <class Number>
Number FormulaOperations<Number>::slope(const Bits& hash, const Number& x, const Number& y,
                                        const Number& z) {
    const auto signed_by = [&](const Number& v, const Bits& bit) {
        return P::number(P::bits(v) ^ (bit & Bits(sign_bit)));
    };
    return (signed_by(x, hash) + signed_by(y, hash << 1)) + signed_by(z, hash << 2);
}

/// Returns 6 t^5 - 15 t^4 + 10 t^3.
template <class Number>
Number FormulaOperations<Number>::weight(const Number& t) {
    return t * t * t * (t * (t * Number(6.0) - Number(15.0)) + Number(10.0));
}

template <class Number>
Number FormulaOperations<Number>::noise(const Number& x, const Number& y, const Number& z) {
    const Number x0 = floor(x), y0 = floor(y), z0 = floor(z), one(1.0);
    const Number u = x - x0, v = y - y0, w = z - z0;
    const Bits key = bits_of_whole(x0) + (bits_of_whole(y0) << 21) + (bits_of_whole(z0) << 42);
    const Number along_x = weight(u), along_y = weight(v);
    const auto in_plane = [&](const Bits& plane, const Number& depth) {
        const auto on_line = [&](const Bits& line, const Number& height) {
            return between(slope(mixed(line), u, height, depth),
                           slope(mixed(line + Bits(1)), u - one, height, depth), along_x);
        };
        return between(on_line(plane, v), on_line(plane + Bits(1U << 21), v - one), along_y);
    };
    const Number sum =
        between(in_plane(key, w), in_plane(key + Bits(std::uint64_t(1) << 42), w - one), weight(w));
    return sum * Number(2.0 / 3.0);
}

template <class Number>
template <class Run>
void FormulaOperations<Number>::with(FormulaOperation operation, const Run& run) {
    using N = const Number&;
    switch (operation) {
    case FormulaOperation::add:
        return run([](N a, N b, N) { return a + b; });
    case FormulaOperation::subtract:
        return run([](N a, N b, N) { return a - b; });
    case FormulaOperation::multiply:
        return run([](N a, N b, N) { return a * b; });
    case FormulaOperation::divide:
        return run([](N a, N b, N) { return a / b; });
    case FormulaOperation::power:
        return run([](N a, N b, N) { return power(a, b); });
    case FormulaOperation::less:
        return run([](N a, N b, N) { return flag(a < b); });
    case FormulaOperation::not_more:
        return run([](N a, N b, N) { return flag((a < b) | (a == b)); });
    case FormulaOperation::equal:
        return run([](N a, N b, N) { return flag(a == b); });
    case FormulaOperation::unequal:
        return run([](N a, N b, N) { return P::select(a == b, Number(0.0), Number(1.0)); });
    case FormulaOperation::choose:
        return run([](N a, N b, N c) { return P::select(abs(a) > Number(0.0), b, c); });
    case FormulaOperation::min:
        return run([](N a, N b, N) { return P::select(b < a, b, a); });
    case FormulaOperation::max:
        return run([](N a, N b, N) { return P::select(b > a, b, a); });
    case FormulaOperation::abs:
        return run([](N a, N, N) { return abs(a); });
    case FormulaOperation::floor:
        return run([](N a, N, N) { return floor(a); });
    case FormulaOperation::mod:
        return run([](N a, N b, N) { return a - b * floor(a / b); });
    case FormulaOperation::sqrt:
        return run([](N a, N, N) { return P::sqrt(a); });
    case FormulaOperation::sin:
        return run([](N a, N, N) { return P::select(is_finite(a), E::sin(a), undefined()); });
    case FormulaOperation::cos:
        return run([](N a, N, N) { return P::select(is_finite(a), E::cos(a), undefined()); });
    case FormulaOperation::exp:
        return run([](N a, N, N) { return P::select(a == a, E::exp(a), a); });
    case FormulaOperation::log:
        return run([](N a, N, N) { return E::log(a); });
    case FormulaOperation::noise:
        return run([](N a, N b, N c) { return noise(a, b, c); });
    }
    __builtin_unreachable();
}

} // namespace raylane::core
