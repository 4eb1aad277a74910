#pragma once

#include "simd/kernel/lanes/vectors.hpp"
#include "simd/units/scene_view.hpp"

namespace raylane::simd {

/// Unpacks the spheres of a packed table (core/shapes/packed_spheres.hpp) into the layout of a
/// plain table: rows of 16 floats, x, y, z and radius, and a row of ids, with the same bits. All
/// code that reads packed tables uses this class.
template <class Arch>
struct PackedSpheres {
    using F = Floats<Arch>;
    static constexpr int rows = 5;

    [[gnu::always_inline]] static void unpack(const PackedView& packed, std::uint32_t number,
                                              float (*to)[16]) {
        const PackedBlockView& block = packed.blocks[number];
        for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
            const BlockRows spheres(packed, block, from);
            const F nan(__builtin_nanf(""));
            for (int axis = 0; axis < 3; ++axis)
                select(spheres.empty, nan, spheres.coordinates(axis))
                    .store_unaligned(to[axis] + from);
            select(spheres.empty, nan, spheres.radii()).store_unaligned(to[3] + from);
            select(spheres.empty, spheres.words, spheres.ids()).store_unaligned(to[4] + from);
        }
        if (!is_of_steps(block)) [[unlikely]]
            copy_whole_rows(packed, block, to);
    }
    /// Same in a separate function, for callers that unpack less often.
    [[gnu::noinline]] static void unpack_apart(const PackedView& packed, std::uint32_t number,
                                               float (*to)[16]) {
        unpack(packed, number, to);
    }

    /// True if a block has no whole rows, which are stored outside of it.
    static bool is_of_steps(const PackedBlockView& block) { return (block.own_rows & 15) == 0; }

    /// Prefetches the whole rows of a block, if any.
    [[gnu::always_inline]] static void fetch_whole_rows(const PackedView& packed,
                                                        std::uint32_t number) {
        const PackedBlockView& block = packed.blocks[number];
        if (is_of_steps(block)) [[likely]]
            return;
        const float(*const first)[16] = packed.rows + (block.own_rows >> 4);
        for (int row = 0; row < __builtin_popcount(block.own_rows & 15); ++row)
            __builtin_prefetch(first + row);
    }

    /// A register's worth of spheres of a block without whole rows, from lane `first` on. Empty
    /// lanes hold undefined values.
    struct BlockRows {
        const PackedView& packed;
        const PackedBlockView& block;
        int from;
        F words;
        Mask<Arch> empty;

        [[gnu::always_inline]] BlockRows(const PackedView& view, const PackedBlockView& block_view,
                                         int first)
            : packed(view), block(block_view), from(first),
              words(F::load_unaligned(reinterpret_cast<const float*>(block_view.words + first))),
              empty(Lanes<Arch>::in_range(words, bits(no_slot), bits(no_slot))) {}

        [[gnu::always_inline]] F coordinates(int axis) const {
            return Lanes<Arch>::add(bits(block.least[axis]),
                                    Lanes<Arch>::unpack_24(block.steps[axis] + 3 * from));
        }
        [[gnu::always_inline]] F radii() const { return of_palette(packed, words); }
        [[gnu::always_inline]] F ids() const { return words & bits(packed.id_mask); }
    };

    /// Reads the same spheres row after row. In empty lanes x is NaN, which filters test for.
    class Reader {
      public:
        [[gnu::always_inline]] Reader(const PackedView& packed, const PackedBlockView& block,
                                      int from)
            : rows_(packed, block, from) {}
        [[gnu::always_inline]] F next() {
            const int row = row_++;
            if (row == 0) return select(rows_.empty, F(__builtin_nanf("")), rows_.coordinates(0));
            return row == 3 ? rows_.radii() : rows_.coordinates(row);
        }

      private:
        BlockRows rows_;
        int row_ = 0;
    };

    /// Unpacks one sphere into one lane. `place` is 16 times the block's number, plus the sphere's
    /// lane in the block.
    static void unpack_one(const PackedView& packed, std::uint32_t place, float (*to)[16],
                           std::uint32_t lane) {
        for (int row = 0; row < 4; ++row)
            to[row][lane] = value(packed, place, row);
        to[4][lane] = __builtin_bit_cast(float, id(packed, place));
    }
    [[gnu::noinline]] static float value(const PackedView& packed, std::uint32_t place, int row) {
        if (row > 3) __builtin_unreachable(); // other kinds have more rows, and are not packed
        const PackedBlockView& block = packed.blocks[place / 16];
        const std::uint32_t lane = place % 16;
        if ((block.own_rows >> row & 1) != 0) [[unlikely]]
            return whole_row(packed, block, row)[lane];
        if (block.words[lane] == no_slot) return __builtin_nanf("");
        if (row == 3) return packed.radii[block.words[lane] >> packed.id_bits];
        const std::uint8_t* const step = block.steps[row] + 3 * lane;
        return __builtin_bit_cast(float, block.least[row] + (step[0] | std::uint32_t{step[1]} << 8 |
                                                             std::uint32_t{step[2]} << 16));
    }
    static std::uint32_t id(const PackedView& packed, std::uint32_t place) {
        const std::uint32_t word = packed.blocks[place / 16].words[place % 16];
        return word == no_slot ? word : word & packed.id_mask;
    }

  private:
    static F bits(std::uint32_t number) { return F(__builtin_bit_cast(float, number)); }

    /// Returns the radii from the palette. Empty lanes get any value, but must not read out of
    /// bounds.
    [[gnu::always_inline]] static F of_palette(const PackedView& packed, const F& words) {
        const auto numbers = bits_as<std::uint32_t>(words) >> static_cast<int>(packed.id_bits);
        if (packed.radius_count <= 16) [[likely]]
            return Lanes<Arch>::look_up(packed.radii, bits_as<float>(numbers));
        std::uint32_t places[F::size];
        numbers.store_unaligned(places);
        for (std::uint32_t& place : places)
            place = place < packed.radius_count ? place : 0;
        return Lanes<Arch>::gather(packed.radii, places);
    }

    static const float* whole_row(const PackedView& packed, const PackedBlockView& block, int row) {
        const std::uint32_t before = block.own_rows & ((1U << row) - 1);
        return packed
            .rows[(block.own_rows >> 4) + static_cast<std::uint32_t>(__builtin_popcount(before))];
    }
    [[gnu::noinline]] static void copy_whole_rows(const PackedView& packed,
                                                  const PackedBlockView& block, float (*to)[16]) {
        for (int row = 0; row < 4; ++row)
            if ((block.own_rows >> row & 1) != 0)
                __builtin_memcpy(to[row], whole_row(packed, block, row), sizeof(float[16]));
    }
};

} // namespace raylane::simd
