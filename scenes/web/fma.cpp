#include <cmath>
#include <cstdint>

/// Replacements of fma and fmaf. WebAssembly has no fused multiply-add, and the C library's, which
/// uses integers, takes a fifth of an image's time. The linker substitutes these (--wrap=fma,
/// --wrap=fmaf).
extern "C" {
double __wrap_fma(double a, double b, double c);
double __real_fma(double a, double b, double c); // the C library's
float __wrap_fmaf(float a, float b, float c);
}

namespace {

struct Pair {
    double high, low;
};

/// Returns a + b exactly (Knuth).
Pair two_sum(double a, double b) {
    const double sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

/// Returns a * b exactly if nothing over- or underflows (Dekker).
Pair two_product(double a, double b) {
    constexpr double split = 0x1p27 + 1.0;
    const double product = a * b, scaled_a = split * a, scaled_b = split * b;
    const double a_high = scaled_a - (scaled_a - a), b_high = scaled_b - (scaled_b - b);
    const double a_low = a - a_high, b_low = b - b_high;
    return {product,
            ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// Returns a + b rounded to odd.
double sum_to_odd(double a, double b) {
    const Pair sum = two_sum(a, b);
    if (sum.low == 0.0) return sum.high;
    const auto bits = __builtin_bit_cast(std::uint64_t, sum.high);
    if ((bits & 1) != 0) return sum.high;
    // One step of the last bit towards the error.
    const bool shrinks = std::signbit(sum.low) != std::signbit(sum.high);
    return __builtin_bit_cast(double, shrinks ? bits - 1 : bits + 1);
}

/// Returns true if no part of a product of two such numbers over- or underflows.
bool is_moderate(double number) {
    const double size = std::fabs(number);
    return size > 0x1p-400 && size < 0x1p400;
}

} // namespace

/// Returns a * b + c rounded once. Source: Boldo and Melquiond, "Emulation of FMA and correctly
/// rounded sums: proved algorithms using rounding to odd" (2008).
double __wrap_fma(double a, double b, double c) {
    if (!is_moderate(a) || !is_moderate(b) || !(is_moderate(c) || c == 0.0))
        return __real_fma(a, b, c);
    const Pair product = two_product(a, b);
    const Pair low = two_sum(c, product.low);
    const Pair high = two_sum(product.high, low.high);
    return high.high + sum_to_odd(low.low, high.low);
}

/// Returns a * b + c rounded once. The C library's changes the rounding mode where a sum is
/// halfway, but WebAssembly has only one mode.
float __wrap_fmaf(float a, float b, float c) {
    const double product = static_cast<double>(a) * static_cast<double>(b); // exactly
    const double sum = product + static_cast<double>(c);
    if (!std::isfinite(sum)) return static_cast<float>(sum);
    return static_cast<float>(sum_to_odd(product, static_cast<double>(c)));
}
