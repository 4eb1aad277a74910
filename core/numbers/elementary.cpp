#include "core/numbers/elementary.hpp"

namespace raylane::core {

template <>
struct Primitives<double> {
    using Bits = std::uint64_t;
    using Mask = bool;
    static constexpr int lanes = 1;
    static Bits bits(double x) { return __builtin_bit_cast(Bits, x); }
    static double number(Bits bits) { return __builtin_bit_cast(double, bits); }
    static double select(Mask mask, double a, double b) { return mask ? a : b; }
    static bool any(Mask mask) { return mask; }
    static double load(const double* from) { return *from; }
    static void store(double x, double* to) { *to = x; }
};

double exp(double x) {
    return Elementary<double>::exp(x);
}
float exp(float x) {
    return static_cast<float>(exp(static_cast<double>(x)));
}

double expm1(double x) {
    return Elementary<double>::expm1(x);
}
float expm1(float x) {
    return static_cast<float>(expm1(static_cast<double>(x)));
}

double pow(double x, double y) {
    return Elementary<double>::pow(x, y);
}
float pow(float x, float y) {
    return static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y)));
}

double sin(double x) {
    return Elementary<double>::sin(x);
}
float sin(float x) {
    return static_cast<float>(sin(static_cast<double>(x)));
}

double cos(double x) {
    return Elementary<double>::cos(x);
}
float cos(float x) {
    return static_cast<float>(cos(static_cast<double>(x)));
}

} // namespace raylane::core
