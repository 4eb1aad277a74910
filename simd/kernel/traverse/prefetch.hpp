#pragma once

#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// Places of children in memory, to fetch them ahead without a branch for each ray.
template <class Arch>
struct Prefetcher {
    /// Cache lines of a node, and of the smallest of blocks.
    static constexpr std::uint32_t most_lines = (sizeof(NodeView) + 63) / 64, least_lines = 5;
    struct Place {
        const char* from;
        std::uint32_t bytes; ///< from one to the next
        std::uint32_t
            further[most_lines - least_lines]; ///< starts of other lines, as far as there are any
    } of[32];                                  ///< by the bits of a child above its index

    explicit Prefetcher(const SceneView& scene) {
        for (Place& place : of)
            set(place, scene.nodes, sizeof(NodeView));
        for (int kind = 0; kind < core::kind_count; ++kind) {
            const TableView& table = scene.tables[kind];
            set(of[16 + kind], table.blocks, table.block_floats * sizeof(float));
        }
        of[31].bytes = 0; // no_child
    }

    [[gnu::always_inline]] void fetch(std::uint32_t child) const {
        const Place& place = of[child >> 27];
        const char* const from =
            place.from + static_cast<std::size_t>(child & child_index) * place.bytes;
        for (std::uint32_t line = 0; line < least_lines; ++line)
            __builtin_prefetch(from + 64 * line);
        for (const std::uint32_t start : place.further)
            __builtin_prefetch(from + start);
    }

  private:
    static void set(Place& place, const void* from, std::size_t bytes) {
        place.from = static_cast<const char*>(from);
        place.bytes = static_cast<std::uint32_t>(bytes);
        for (std::uint32_t k = 0; k < most_lines - least_lines; ++k) {
            const std::uint32_t start = 64 * (least_lines + k);
            place.further[k] = start < place.bytes ? start : 0;
        }
    }
};

} // namespace raylane::simd
