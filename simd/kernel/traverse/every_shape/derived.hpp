#pragma once

#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// True if constructing a Made from a shape's floats costs more than reading the numbers that it
/// derives.
template <class Arch, class Made>
concept Derives = requires(const Made& made) {
    made.derived([](const Floats<Arch>&) {});
};

/// The numbers that filters or solvers derive from shapes, for kinds with a single block, which has
/// up to 16 shapes. `With::with(kind, visit)` calls visit with the type of the filter or solver.
template <class Arch, class With>
class DerivedNumbers : Streams<Arch> {
    using S = Streams<Arch>;
    using F = Floats<Arch>;

  public:
    using Rows = const float (*)[16];

    DerivedNumbers(const SceneView& scene, std::uint32_t kind_bits) {
        S::for_each_kind(kind_bits, [&](core::Kind kind) {
            const TableView& table = S::table_of(scene, kind);
            With::with(kind, [&]<class Made>() {
                if constexpr (Derives<Arch, Made>)
                    if (table.block_count == 1)
                        derive<Made>(kind, S::rows_of(S::block_of(table, 0)));
            });
        });
    }

    /// Returns the rows of a kind, or null if it has none.
    Rows of(core::Kind kind) const { return of_kind_[static_cast<int>(kind)]; }

  private:
    template <class Made>
    void derive(core::Kind kind, Rows block) {
        const int first = used_;
        for (std::size_t lane = 0; lane < 16; lane += F::size) {
            int row = first;
            const Made made(BlockReader<Arch>(block, static_cast<int>(lane)));
            made.derived([&](const F& number) { number.store_unaligned(rows_[row++] + lane); });
            used_ = row;
        }
        of_kind_[static_cast<int>(kind)] = rows_ + first;
    }

    static constexpr int most = 24; // per shape
    alignas(64) float rows_[most * core::kind_count][16];
    Rows of_kind_[core::kind_count] = {};
    int used_ = 0;
};

} // namespace raylane::simd
