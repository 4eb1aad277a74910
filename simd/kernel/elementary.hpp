#pragma once

#include "core/elementary.hpp"
#include "simd/kernel/lanes.hpp"

/// `core::Elementary` of registers of doubles: the scalar functions' bits in every lane.
namespace raylane::core {

template <class Arch>
struct Primitives<xsimd::batch<double, Arch>> {
    using Number = xsimd::batch<double, Arch>;
    using Bits = xsimd::batch<std::uint64_t, Arch>;
    using Mask = xsimd::batch_bool<double, Arch>;
    static constexpr int lanes = static_cast<int>(Number::size);
    static Bits bits(const Number& x) { return simd::bits_as<std::uint64_t>(x); }
    static Number number(const Bits& bits) { return simd::bits_as<double>(bits); }
    static Number select(const Mask& mask, const Number& a, const Number& b) {
        return xsimd::select(mask, a, b);
    }
    static bool any(const Mask& mask) { return xsimd::any(mask); }
    static Number load(const double* from) { return Number::load_unaligned(from); }
    static void store(const Number& x, double* to) { x.store_unaligned(to); }
};

} // namespace raylane::core
