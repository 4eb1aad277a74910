#pragma once

#include "simd/kernel/lanes/elementary.hpp"

/// Elementary functions of arrays, for units that are built for one instruction set.
namespace raylane::simd {

/// Values of x and y in, results of each function out; `count` is a multiple of 8.
struct ElementaryArrays {
    const double* x;
    const double* y;
    double* exp;
    double* expm1;
    double* pow;
    double* sin;
    double* cos;
    double* atan;
    int count;
};

template <class Arch>
struct ElementaryCheck {
    static void fill(const ElementaryArrays& arrays) {
        using Number = Floats<Double<Arch>>;
        using Functions = core::Elementary<Number>;
        for (int i = 0; i < arrays.count; i += static_cast<int>(Number::size)) {
            const auto x = Number::load_unaligned(arrays.x + i);
            const auto y = Number::load_unaligned(arrays.y + i);
            Functions::exp(x).store_unaligned(arrays.exp + i);
            Functions::expm1(x).store_unaligned(arrays.expm1 + i);
            Functions::pow(abs(x), abs(y)).store_unaligned(arrays.pow + i);
            const auto both = Functions::sin_cos(x);
            both.sine.store_unaligned(arrays.sin + i);
            both.cosine.store_unaligned(arrays.cos + i);
            Functions::atan(x).store_unaligned(arrays.atan + i);
        }
    }
};

/// Runs ElementaryCheck; defined in the kernel unit of each instruction set.
template <Isa isa>
void elementary(const ElementaryArrays& arrays);

} // namespace raylane::simd
