#pragma once

#include "core/kinds.hpp"

#include <cstdint>

/// A scene as the kernel units see it: plain data, so that nothing inline is shared with the units
/// that are built for newer processors.
namespace raylane::simd {

/// core::PackedBlock
struct alignas(32) PackedBlockView {
    std::uint32_t least[3];
    std::uint32_t whole;
    std::uint8_t steps[3][48];
    std::uint32_t words[16];
};

/// core::PackedSpheres
struct PackedView {
    const PackedBlockView* blocks = nullptr; ///< null: the table is not packed
    const float (*rows)[16] = nullptr;       ///< those that stand by themselves
    const float* radii = nullptr;            ///< 16 of them at least can be read
    std::uint32_t radius_count = 0;
    std::uint32_t id_bits = 0; ///< of a word: above them is the number of the radius
    std::uint32_t id_mask = 0; ///< these bits
};

/// All shapes of one kind: an array of core::Block, which is `values` rows of 16 floats and a row
/// of 16 ids. Shapes are numbered across the kinds by slots: that of lane l in block b is
/// first_slot + 16 b + l.
struct TableView {
    const float* blocks; ///< null: they are packed
    std::uint32_t block_count;
    std::uint32_t block_floats; ///< from one block to the next, in floats
    std::uint32_t values;       ///< floats that a shape is
    std::uint32_t first_slot;
    /// Null, or what the shapes are exactly: an array of core::DoubleBlock, whose numbers are as
    /// far from its first as the floats are from theirs.
    const double* doubles = nullptr;
    /// Where there is one, instead of `blocks`.
    PackedView packed{};

    [[gnu::always_inline]] bool is_packed() const { return packed.blocks != nullptr; }
};

/// core::WideNode
struct NodeView {
    float lower[3][16];
    float upper[3][16];
    std::uint32_t children[16]; ///< core::Child's bits
};

/// Half-spaces outside of which nothing is left of what they cut, in groups: that is so where a
/// point is outside of all of one group.
struct CutView {
    static constexpr int most = 16;
    float normal[3][most]; ///< outward, of length 1 but for rounding
    float offset[most];    ///< outside, normal . point is larger
    /// Id of the one that has it as a face, if a ray that starts on that and then is outside has
    /// been so from the start; else no_slot - 1.
    std::uint32_t shape[most];
    /// Slot of the one that has it as a face, if that waits for what it cuts; else no_slot.
    std::uint32_t face[most];
    float size; ///< none smaller than offsets, nor than what they have been made of
    int count;
    std::uint32_t group_ends; ///< bit k: half-space k is the last of a group
    bool is_all;              ///< nothing else cuts
};

struct SceneView {
    TableView tables[core::kind_count]; ///< by core::Kind
    const NodeView* nodes;              ///< the root first
    /// Orders by 8 times the node and a ray direction's octant (bit a: component a is negative):
    /// the node's entries in the order of their distance, 4 bits each, the nearest lowest.
    const std::uint64_t* orders;
    std::uint32_t tree_depth; ///< levels of nodes; 0: not to be walked
    float reach;              ///< the largest coordinate of what is in the tree
    float rounding;           ///< how far the shapes' floats are from what they stand for, at most
    bool large;               ///< nodes and shapes do not fit in the cache of a core
    bool small;               ///< they take no more than a sixteenth of it
    /// Plain lanes by slot / 16: which of a block are opaque and seen from both sides, so that
    /// whatever hits them is blocked. Null: all are.
    const std::uint16_t* plain_lanes;
    /// By slot / 16: which of `cuts` cuts the block's shapes, or some of them; 0: none. Null: none
    /// is cut. Shapes that are cut are no plain ones; quadrics that are have no quadratic part.
    const std::uint16_t* cut_of_block;
    const CutView* cuts;
    /// By slot / 16: lanes of what block no ray that they are not inside of, but for others that
    /// may block it, too. Null: there are none.
    const std::uint16_t* only_cut_lanes;
    /// Those of them that need not be looked for but where rays cross them within what they cut,
    /// all of which is in blocks with their cut. Null: there are none.
    const std::uint16_t* waiting_lanes;
};

/// core::Child's bits.
inline constexpr std::uint32_t child_is_block = 0x80000000;
inline constexpr std::uint32_t child_index = (1U << 27) - 1;
inline constexpr std::uint32_t no_child = 0xFFFFFFFF;

inline constexpr std::uint32_t no_slot = 0xFFFFFFFF;

} // namespace raylane::simd
