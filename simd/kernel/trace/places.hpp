#pragma once

#include "simd/kernel/trace/rays.hpp"

namespace raylane::simd {

/// Where children are in memory: what fetches them ahead without a branch for each ray.
template <class Arch>
struct Places {
    static constexpr std::size_t lines = (sizeof(NodeView) + 63) / 64;
    struct Place {
        const char* from;
        std::uint32_t bytes; ///< from one to the next
        std::uint32_t last;  ///< byte that is fetched
    } of[32];                ///< by the bits of a child above its index

    explicit Places(const SceneView& scene) {
        const Place nodes{reinterpret_cast<const char*>(scene.nodes), sizeof(NodeView),
                          sizeof(NodeView) - 64};
        for (Place& place : of)
            place = nodes;
        for (int kind = 0; kind < kinds; ++kind) {
            const TableView& table = scene.tables[kind];
            const auto bytes = static_cast<std::uint32_t>(table.block_floats * sizeof(float));
            of[16 + kind] = {reinterpret_cast<const char*>(table.blocks), bytes, bytes - 64};
        }
        of[31].bytes = 0; // no_child
    }

    [[gnu::always_inline]] void fetch(std::uint32_t child) const {
        const Place& place = of[child >> 27];
        const char* const from =
            place.from + static_cast<std::size_t>(child & child_index) * place.bytes;
        for (std::uint32_t line = 0; line < lines; ++line)
            __builtin_prefetch(from + (64 * line < place.last ? 64 * line : place.last));
    }
};

} // namespace raylane::simd
