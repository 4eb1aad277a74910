#pragma once

#include "simd/kernel/lanes/bounded.hpp"

/// Operations of bounded numbers, in lanes. Units for one instruction set include this header, so
/// it must not have inline functions that other units share.
namespace raylane::simd {

struct BoundedColumns {
    double high[8], low[8], error[8];
};

/// `operation` is a tests::Operation, counted from 0. Returns the number of lanes.
using BoundedOperation = int (*)(int operation, const BoundedColumns& a, const BoundedColumns& b,
                                 BoundedColumns& result);

template <class Arch>
struct BoundedCheck {
    static int operate(int operation, const BoundedColumns& a, const BoundedColumns& b,
                       BoundedColumns& result) {
        using C = Certified<Wide<Double<Arch>>>;
        using F = simd::Floats<Double<Arch>>;
        const auto load = [](const BoundedColumns& from) {
            return simd::Floats<C>(DoubleDoubles<Double<Arch>>(F::load_unaligned(from.high),
                                                               F::load_unaligned(from.low)),
                                   F::load_unaligned(from.error));
        };
        const simd::Floats<C> x = load(a), y = load(b);
        const simd::Floats<C> found = operation == 0   ? x + y
                                      : operation == 1 ? x * y
                                      : operation == 2 ? x / y
                                                       : sqrt(x);
        found.value.high.store_unaligned(result.high);
        found.value.low.store_unaligned(result.low);
        found.error.store_unaligned(result.error);
        return static_cast<int>(F::size);
    }
};

/// Runs BoundedCheck; defined in the kernel unit of each instruction set.
template <Isa isa>
int bounded_operation(int operation, const BoundedColumns& a, const BoundedColumns& b,
                      BoundedColumns& result);

} // namespace raylane::simd
