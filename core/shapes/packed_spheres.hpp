#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/block.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace raylane::core {

/// A Block of spheres in 224 bytes rather than 320, with the same bits.
///
/// Spheres of a block are close together, so the bit patterns of a row of coordinates, as integers,
/// usually differ by less than 2^24. The block stores a row as its least pattern and 24-bit steps
/// from it. Radii are few: a word holds the sphere's id and, above it, the number of its radius in
/// the scene's palette. Rows for which this does not work, such as coordinates on both sides of 0,
/// are stored as floats outside of the block.
struct alignas(32) PackedBlock {
    static constexpr int rows = 4;                     ///< rows of floats: x, y, z, radius
    static constexpr std::uint32_t is_whole = 1;       ///< << row: its floats are stored elsewhere
    static constexpr std::uint32_t empty = 0xFFFFFFFF; ///< word of an empty lane
    static constexpr std::uint32_t step_limit = 1U << 24;

    std::uint32_t least[3]; ///< least pattern of each axis
    std::uint32_t own_rows; ///< rows stored elsewhere; above these 4 bits, the index of the first
    std::uint8_t steps[3][3 * block_size]; ///< by axis and lane, 24 bits each, the lowest first
    std::uint32_t words[block_size];       ///< id, and above it the radius' number

    int whole_rows() const { return std::popcount(own_rows & ((1U << rows) - 1)); }
};
static_assert(sizeof(PackedBlock) == 224);

/// Radii by number, in the bits that ids leave free.
class RadiusPalette {
  public:
    static constexpr std::size_t most = 256;
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// For spheres whose ids are less than `id_count`.
    explicit RadiusPalette(std::size_t id_count = 1);

    /// Adds a radius if it is new and if the palette is not full.
    void add(float radius);
    /// Returns the number of a radius, compared by its bits; or none.
    std::uint32_t find(float radius) const;

    int id_bits() const { return id_bits_; }
    std::uint32_t id_mask() const { return (std::uint32_t{1} << id_bits_) - 1; }
    std::size_t size() const { return size_; }
    const float* radii() const { return radii_.data(); }
    float radius(std::uint32_t word) const { return radii_[word >> id_bits_]; }

  private:
    /// Returns the position of a radius, or a free position, in a hash table. It holds numbers plus
    /// 1; 0 means free.
    std::size_t place_of(float radius) const;

    int id_bits_;
    std::size_t capacity_;
    std::size_t size_ = 0;
    std::array<float, most> radii_{}; // at least 16 elements, for registers
    std::array<std::uint16_t, 4 * most> places_{};
};

/// Maximum number of ids: larger ones leave no bit for the palette.
inline constexpr std::size_t max_packed_ids = std::size_t{1} << 30;

/// Returns how many rows of a block are stored elsewhere.
int whole_rows(const Block<Sphere>& block, const RadiusPalette& palette);

/// Packs a block. Writes the rows that are stored elsewhere to `rows`. `first_row`: the number of
/// rows of earlier blocks.
PackedBlock pack(const Block<Sphere>& block, const RadiusPalette& palette, std::uint32_t first_row,
                 std::array<float, block_size>* rows);

/// All blocks of spheres of a scene, packed.
struct PackedSpheres {
    using Row = std::array<float, block_size>;

    BigArray<PackedBlock> blocks;
    BigArray<Row> rows; ///< rows stored outside of the blocks
    RadiusPalette palette;

    bool empty() const { return blocks.empty(); }
    std::size_t bytes() const { return blocks.bytes() + rows.bytes(); }

    Block<Sphere> block(std::size_t index) const;
    Sphere get(std::size_t index, int lane) const;
    ShapeId id(std::size_t index, int lane) const {
        const std::uint32_t word = blocks[index].words[lane];
        return word == PackedBlock::empty ? no_shape : word & palette.id_mask();
    }

  private:
    float value(const PackedBlock& block, int row, int lane) const;
};

} // namespace raylane::core
