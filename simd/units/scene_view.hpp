#pragma once

#include "core/kinds.hpp"

#include <cstdint>

/// A scene as the kernel units see it: plain data, so that nothing inline is shared with the units
/// that are built for newer processors.
namespace raylane::simd {

/// Same layout as core::PackedBlock.
struct alignas(32) PackedBlockView {
    std::uint32_t least[3];
    std::uint32_t own_rows;
    std::uint8_t steps[3][48];
    std::uint32_t words[16];
};

/// View of core::PackedSpheres.
struct PackedView {
    const PackedBlockView* blocks = nullptr; ///< null: the table is not packed
    const float (*rows)[16] = nullptr;       ///< of coordinates that are stored as floats
    const float* radii = nullptr;            ///< at least 16 can be read
    std::uint32_t radius_count = 0;
    std::uint32_t id_bits = 0; ///< of a word; the bits above them are the index of the radius
    std::uint32_t id_mask = 0; ///< the id's bits
};

/// All shapes of one kind: an array of core::Block, each of `values` rows of 16 floats and a row of
/// 16 ids. Slots number the shapes across the kinds: lane l of block b has slot first_slot + 16 b +
/// l.
struct TableView {
    const float* blocks; ///< null: the blocks are packed
    std::uint32_t block_count;
    std::uint32_t block_floats; ///< from one block to the next, in floats
    std::uint32_t values;       ///< floats per shape
    std::uint32_t first_slot;
    /// Null, or the exact numbers of the shapes: an array of core::DoubleBlock. A double has the
    /// same index here as its float has in `blocks`.
    const double* doubles = nullptr;
    /// Used instead of `blocks` if the table is packed.
    PackedView packed{};

    [[gnu::always_inline]] bool is_packed() const { return packed.blocks != nullptr; }
};

/// Same layout as core::WideNode.
struct NodeView {
    float lower[3][16];
    float upper[3][16];
    std::uint32_t children[16]; ///< core::Child's bits
};

/// Half-spaces that cut a union (its clip planes), in groups. Nothing of the union is left at
/// points that are outside of all half-spaces of one group.
struct ClipPlanesView {
    static constexpr int most = 16;
    float normal[3][most]; ///< outward, of length 1 except for rounding
    float offset[most];    ///< outside, normal . point is larger
    /// Id of the shape that has the half-space as a face, if this holds for each ray that starts on
    /// the shape: if the ray is outside of the half-space later, it has been outside of it since
    /// its start. Otherwise no_slot - 1.
    std::uint32_t shape[most];
    /// Slot of the shape that has it as a face, if that face's clip test is deferred; otherwise
    /// no_slot.
    std::uint32_t face[most];
    float size; ///< at least twice each offset, and 2^-20 of the terms that an offset is made of
    int count;
    std::uint32_t group_ends; ///< bit k: half-space k is the last of a group
    bool is_all;              ///< nothing else cuts the union
};

struct SceneView {
    TableView tables[core::kind_count]; ///< by core::Kind
    const NodeView* nodes;              ///< the root first
    /// Element 8 node + octant of a ray's direction (bit a: component a is negative): the node's
    /// entries in the order of their distance, 4 bits each, the nearest in the lowest bits.
    const std::uint64_t* orders;
    std::uint32_t tree_depth; ///< levels of nodes; 0: the tree is not traversed
    float reach;              ///< the largest coordinate of the tree's bounds
    float rounding; ///< the largest distance between the shapes' floats and their exact numbers
    bool large;     ///< nodes and shapes do not fit in the cache of a core
    bool small;     ///< they take no more than a sixteenth of it
    /// Element slot / 16: lanes of a block that are opaque and visible from both sides, so that
    /// they block any ray that hits them. Null: all lanes are.
    const std::uint16_t* plain_lanes;
    /// Element slot / 16: index in `cuts` of the cut of the block's shapes, or of some of them; 0:
    /// not cut. Null: no shape is cut. Cut shapes are never plain lanes. Cut quadrics have no
    /// quadratic part.
    const std::uint16_t* cut_of_block;
    const ClipPlanesView* cuts;
    /// Element slot / 16: lanes of shapes that only cut. Rays that start outside of their solid may
    /// be blocked by others wherever these block them. Null: no such lanes.
    const std::uint16_t* only_cut_lanes;
    /// The only_cut_lanes whose clip tests are deferred: they are searched only where a ray crosses
    /// them within a part of the union that they cut. All parts of that union are in blocks with
    /// their cut. Null: no such lanes.
    const std::uint16_t* deferred_lanes;
};

/// core::Child's bits.
inline constexpr std::uint32_t child_is_block = 0x80000000;
inline constexpr std::uint32_t child_index = (1U << 27) - 1;
inline constexpr std::uint32_t no_child = 0xFFFFFFFF;

inline constexpr std::uint32_t no_slot = 0xFFFFFFFF;

} // namespace raylane::simd
