#pragma once

#include "simd/kernel/shapes/packed_spheres.hpp"

#include <cstddef>

namespace raylane::simd {

/// Access to shapes by their slots. A template, like everything in kernel/.
template <class Arch>
struct Slots {
    static bool holds(const TableView& table, std::uint32_t slot) {
        return slot - table.first_slot < 16 * table.block_count;
    }

    /// Returns the kind of a slot, which must be in one of the tables.
    static core::Kind kind_of(const SceneView& scene, std::uint32_t slot) {
        int kind = 0;
        while (!holds(scene.tables[kind], slot))
            ++kind;
        return static_cast<core::Kind>(kind);
    }

    static const TableView& table_of(const SceneView& scene, core::Kind kind) {
        return scene.tables[static_cast<int>(kind)];
    }

    static std::uint32_t id(const TableView& table, std::uint32_t slot) {
        if (table.is_packed())
            return PackedSpheres<Arch>::id(table.packed, slot - table.first_slot);
        const float* const ids = table.blocks + std::size_t{16} * table.values;
        return __builtin_bit_cast(std::uint32_t, ids[offset(table, slot)]);
    }

    /// Returns the offset of a slot's first float from the table's first one. The table must not be
    /// packed.
    [[gnu::always_inline]] static long long offset(const TableView& table, std::uint32_t slot) {
        const std::uint32_t place = slot - table.first_slot;
        return static_cast<long long>(place / 16) * table.block_floats + place % 16;
    }
};

} // namespace raylane::simd
