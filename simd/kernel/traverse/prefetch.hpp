#pragma once

#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// Addresses of children, for prefetching them without a branch for each ray.
template <class Arch>
struct Prefetcher {
    /// Cache lines of a node, and of the smallest block.
    static constexpr std::uint32_t max_lines = (sizeof(NodeView) + 63) / 64, min_lines = 4;
    struct Addresses {
        const char* from;
        std::uint32_t bytes; ///< from one child to the next
        std::uint32_t
            further[max_lines - min_lines]; ///< offsets of further lines, 0 if there are fewer
    } tables[32];                           ///< indexed by the bits of a child above its index

    explicit Prefetcher(const SceneView& scene) {
        for (Addresses& table : tables)
            set(table, scene.nodes, sizeof(NodeView));
        for (int kind = 0; kind < core::kind_count; ++kind) {
            const TableView& shapes = scene.tables[kind];
            if (shapes.is_packed())
                set(tables[16 + kind], shapes.packed.blocks, sizeof(PackedBlockView));
            else
                set(tables[16 + kind], shapes.blocks, shapes.block_floats * sizeof(float));
        }
        tables[31].bytes = 0; // no_child
    }

    [[gnu::always_inline]] void fetch(std::uint32_t child) const {
        const Addresses& table = tables[child >> 27];
        const char* const from =
            table.from + static_cast<std::size_t>(child & child_index) * table.bytes;
        for (std::uint32_t line = 0; line < min_lines; ++line)
            __builtin_prefetch(from + 64 * line);
        for (const std::uint32_t start : table.further)
            __builtin_prefetch(from + start);
    }

  private:
    static void set(Addresses& table, const void* from, std::size_t bytes) {
        table.from = static_cast<const char*>(from);
        table.bytes = static_cast<std::uint32_t>(bytes);
        for (std::uint32_t k = 0; k < max_lines - min_lines; ++k) {
            const std::uint32_t start = 64 * (min_lines + k);
            table.further[k] = start < table.bytes ? start : 0;
        }
    }
};

} // namespace raylane::simd
