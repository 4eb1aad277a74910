#pragma once

#include "simd/kernel/lanes/elementary.hpp"

namespace raylane::bench {

/// The elementary functions of arrays of `count` doubles, a multiple of 8. Functions of one
/// argument ignore y.
struct ElementaryUnit {
    using Function = void (*)(const double* x, const double* y, double* out, int count);
    Function exp, expm1, pow, sin, atan;
};

template <class Arch>
struct ElementaryArrays {
    using Number = simd::Floats<simd::Double<Arch>>;
    using Functions = core::Elementary<Number>;
    static constexpr int lanes = static_cast<int>(Number::size);

    template <Number (*function)(const Number&)>
    static void of_one(const double* x, const double*, double* out, int count) {
        for (int i = 0; i < count; i += lanes)
            function(Number::load_unaligned(x + i)).store_unaligned(out + i);
    }

    template <Number (*function)(const Number&, const Number&)>
    static void of_two(const double* x, const double* y, double* out, int count) {
        for (int i = 0; i < count; i += lanes)
            function(Number::load_unaligned(x + i), Number::load_unaligned(y + i))
                .store_unaligned(out + i);
    }

    static constexpr ElementaryUnit unit = {of_one<Functions::exp>, of_one<Functions::expm1>,
                                            of_two<Functions::pow>, of_one<Functions::sin>,
                                            of_one<Functions::atan>};
};

/// Defined in the kernel unit of each instruction set.
template <simd::Isa isa>
ElementaryUnit elementary();

} // namespace raylane::bench
