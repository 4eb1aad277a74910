#pragma once

#include "simd/isa/isa.hpp"
#include "simd/kernel/shade/formulas.hpp"

/// Colours of arrays of points by a formula, for units that are built for one instruction set.
namespace raylane::simd {

struct FormulaArrays {
    const core::FormulaProgram* program;
    const double* inputs[5];
    double* channels[3];
    std::size_t count; ///< a multiple of Formulas::chunk
};

template <class Arch>
struct FormulasCheck {
    static void fill(const FormulaArrays& arrays) {
        using F = Floats<Double<Arch>>;
        using Formulas = simd::Formulas<Double<Arch>>;
        Formulas formulas(*arrays.program);
        for (std::size_t first = 0; first < arrays.count; first += Formulas::chunk) {
            for (std::size_t k = 0; k < Formulas::chunk; k += F::size) {
                const auto input = [&](int number) {
                    return F::load_unaligned(arrays.inputs[number] + first + k);
                };
                formulas.set_point(k, input(0), input(1), input(2));
                formulas.set(3, k, input(3));
                formulas.set(4, k, input(4));
            }
            formulas.run(Formulas::chunk);
            for (int channel = 0; channel < 3; ++channel)
                for (std::size_t k = 0; k < Formulas::chunk; k += F::size)
                    formulas.channel(channel, k)
                        .store_unaligned(arrays.channels[channel] + first + k);
        }
    }
};

/// Runs FormulasCheck; defined in the kernel unit of each instruction set.
template <Isa isa>
void formulas(const FormulaArrays& arrays);

} // namespace raylane::simd
