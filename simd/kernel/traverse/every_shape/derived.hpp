#pragma once

#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// True if making one of these from a shape's floats takes more than to read what it derives.
template <class Arch, class Made>
concept Derives = requires(const Made& made) {
    made.derived([](const Floats<Arch>&) {});
};

/// What filters or solvers derive from shapes, of kinds that have up to 16, by way of their blocks.
/// `With::with(kind, visit)` calls visit with their type.
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

    /// Null: there are none.
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

    static constexpr int most = 24; // of a shape
    alignas(64) float rows_[most * core::kind_count][16];
    Rows of_kind_[core::kind_count] = {};
    int used_ = 0;
};

} // namespace raylane::simd
