#pragma once

#include "core/numbers/formula_program.hpp"
#include "simd/kernel/lanes/elementary.hpp"

#include <cstddef>

namespace raylane::simd {

/// Runs the program of a formula on the points of a chunk: each instruction on all of them, so that
/// its choice costs little.
template <class Arch>
class Formulas {
    using F = Floats<Arch>;
    using Operations = core::FormulaOperations<F>;
    using Program = core::FormulaProgram;

  public:
    static constexpr std::size_t chunk = 32;

    explicit Formulas(const Program& program) : program_(program) {
        for (int i = 0; i < program.constant_count; ++i)
            for (std::size_t k = 0; k < chunk; k += F::size)
                set(Program::inputs + i, k, F(program.constants[i]));
    }

    /// Sets the coordinates of the points from `k` on.
    void set_point(std::size_t k, F x, F y, F z) {
        Operations::round_coordinates(x, y, z);
        set(0, k, x);
        set(1, k, y);
        set(2, k, z);
    }
    /// Sets an input of the points from `k` on.
    void set(int input, std::size_t k, const F& value) {
        value.store_unaligned(values_[input] + k);
    }

    /// Computes the colours of the first `count` points, or of some more.
    [[gnu::noinline]] void run(std::size_t count) {
        int result = Program::inputs + program_.constant_count;
        for (int i = 0; i < program_.instruction_count; ++i, ++result) {
            const Program::Instruction& instruction = program_.instructions[i];
            const double* const a = values_[instruction.a];
            const double* const b = values_[instruction.b];
            const double* const c = values_[instruction.c];
            double* const to = values_[result];
            Operations::with(instruction.operation, [&](const auto& f) {
                for (std::size_t k = 0; k < count; k += F::size)
                    f(load(a + k), load(b + k), load(c + k)).store_unaligned(to + k);
            });
        }
    }

    /// Returns a channel of the points from `k` on.
    F channel(int number, std::size_t k) const {
        return Operations::channel(load(values_[program_.channels[number]] + k));
    }

  private:
    static F load(const double* from) { return F::load_unaligned(from); }

    const Program& program_;
    alignas(64) double values_[Program::max_values][chunk];
};

} // namespace raylane::simd
