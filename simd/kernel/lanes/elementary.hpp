#pragma once

#include "core/numbers/elementary.hpp"
#include "simd/kernel/lanes/doubles.hpp"

/// `core::Elementary` for registers of doubles. Each lane of a result has the bits of the scalar
/// function's result.
namespace raylane::simd {

/// select() and sqrt(), for classes whose members of these names hide them.
template <class Mask, class Number>
Number selected(const Mask& mask, const Number& a, const Number& b) {
    return select(mask, a, b);
}
template <class Number>
Number root_of(const Number& x) {
    return sqrt(x);
}

template <class Arch>
struct DoublePrimitives {
    using Number = Floats<Double<Arch>>;
    using Bits = decltype(bits_as<std::uint64_t>(Number(0.0)));
    using Mask = simd::Mask<Double<Arch>>;
    static constexpr int lanes = static_cast<int>(Number::size);
    static Bits bits(const Number& x) { return bits_as<std::uint64_t>(x); }
    static Number number(const Bits& bits) { return bits_as<double>(bits); }
    static Number select(const Mask& mask, const Number& a, const Number& b) {
        return selected(mask, a, b);
    }
    static bool any(const Mask& mask) { return DoubleLanes<Arch>::bits(mask) != 0; }
    static Number sqrt(const Number& x) { return root_of(x); }
    static Number load(const double* from) { return Number::load_unaligned(from); }
    static void store(const Number& x, double* to) { x.store_unaligned(to); }
};

} // namespace raylane::simd

namespace raylane::core {

template <class Arch>
struct Primitives<xsimd::batch<double, Arch>> : simd::DoublePrimitives<Arch> {};
template <>
struct Primitives<simd::PortableBatch<double>> : simd::DoublePrimitives<simd::Portable> {};

} // namespace raylane::core
