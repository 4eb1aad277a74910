#pragma once

#include "core/numbers/elementary.hpp"

#include <cmath>

namespace raylane::core {

/// Primitives of scalars, for formulas that are written once for scalars and registers.
template <>
struct Primitives<double> {
    using Bits = std::uint64_t;
    using Mask = bool;
    static constexpr int lanes = 1;
    static Bits bits(double x) { return __builtin_bit_cast(Bits, x); }
    static double number(Bits bits) { return __builtin_bit_cast(double, bits); }
    static double select(Mask mask, double a, double b) { return mask ? a : b; }
    static bool any(Mask mask) { return mask; }
    static double sqrt(double x) { return std::sqrt(x); }
    static double load(const double* from) { return *from; }
    static void store(double x, double* to) { *to = x; }
};

} // namespace raylane::core
