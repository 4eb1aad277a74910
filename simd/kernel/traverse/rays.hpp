#pragma once

#include "simd/kernel/shapes/packed_spheres.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/units/trace_kernels.hpp"

namespace raylane::simd {

/// Factors of a ray's t_limit. Crossings below the first product may be before the limit, and those
/// below the second certainly are. Both t_limit and the product are rounded.
inline constexpr float perhaps_within = 1 + 4 * half_ulp, surely_within = 1 - 4 * half_ulp;

/// Returns the end of the lanes that hold something, of 16 in registers of Arch: filled lanes come
/// first. `ids`: of shapes, or the children of a node.
template <class Arch>
[[gnu::always_inline]] inline int end_of_filled(const std::uint32_t* ids) {
    constexpr int lanes = static_cast<int>(Floats<Arch>::size);
    static_assert(no_child == no_slot);
    int end = lanes;
    while (end < 16 && ids[end] != no_slot)
        end += lanes;
    return end;
}

/// The 16 shapes of a block in memory, where they are stored or have been unpacked to.
template <class Arch>
struct PlainLanes {
    const float (*rows)[16];
    std::uint32_t values;

    PlainLanes(const TableView& table, const float* block)
        : rows(reinterpret_cast<const float (*)[16]>(block)), values(table.values) {}
    BlockReader<Arch> reader(int from) const { return {rows, from}; }
    Floats<Arch> ids(int from) const { return Floats<Arch>::load_unaligned(rows[values] + from); }
    int end() const {
        return end_of_filled<Arch>(reinterpret_cast<const std::uint32_t*>(rows[values]));
    }
};

/// Same for packed spheres, which are unpacked in registers.
template <class Arch>
struct PackedLanes {
    using Packed = PackedSpheres<Arch>;
    const PackedView& packed;
    const PackedBlockView& block;

    typename Packed::Reader reader(int from) const { return {packed, block, from}; }
    Floats<Arch> ids(int from) const {
        const typename Packed::BlockRows rows(packed, block, from);
        return select(rows.empty, rows.words, rows.ids());
    }
    int end() const { return end_of_filled<Arch>(block.words); }
};

/// Memory for an unpacked block.
template <class Arch>
struct alignas(64) BlockRoom {
    float rows[PackedSpheres<Arch>::rows][16];
};

/// Access to the arrays of trace_kernels.hpp.
template <class Arch>
struct Streams {
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    static constexpr std::size_t lanes = F::size;

    static F load(const float* from) { return F::load_unaligned(from); }
    static F load_bits(const std::uint32_t* from) {
        return F::load_unaligned(reinterpret_cast<const float*>(from));
    }
    static F broadcast_bits(std::uint32_t bits) { return F(__builtin_bit_cast(float, bits)); }
    static void store_bits(const F& values, std::uint32_t* to) {
        values.store_unaligned(reinterpret_cast<float*>(to));
    }
    static F infinity() { return F(__builtin_inff()); }

    static float greatest_of_16(const float* from) {
        F result = load(from);
        for (std::size_t k = lanes; k < 16; k += lanes)
            result = max(result, load(from + k));
        return Lanes<Arch>::greatest(result);
    }
    static float min_of_16(const float* from) {
        F result = load(from);
        for (std::size_t k = lanes; k < 16; k += lanes)
            result = min(result, load(from + k));
        return Lanes<Arch>::least(result);
    }

    /// Returns the mask of the first `count` lanes.
    static M first_lanes(std::size_t count) {
        static constexpr float numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
        return load(numbers) < F(static_cast<float>(count < lanes ? count : lanes));
    }

    /// Returns the entries of a node that are not empty, as bits, from `from` on. Comparisons with
    /// their bounds do not show this for rays that are infinitely far away.
    static std::uint32_t filled(const NodeView& node, int from) {
        static_assert(no_child == no_slot);
        return Lanes<Arch>::bits(filled(load_bits(node.children + from)));
    }
    /// True for ids that belong to a shape.
    static M filled(const F& ids) {
        const F empty = broadcast_bits(no_slot);
        return ~Lanes<Arch>::in_range(ids, empty, empty);
    }

    /// Returns the lanes of the slot's block whose shapes block every ray that hits them, as bits.
    static std::uint32_t plain_lanes(const SceneView& scene, std::uint32_t slot) {
        return scene.plain_lanes == nullptr ? 0xFFFF : scene.plain_lanes[slot / 16];
    }
    static bool is_plain(const SceneView& scene, std::uint32_t slot) {
        return (plain_lanes(scene, slot) >> slot % 16 & 1) != 0;
    }

    /// Returns the lanes of the slot's block that occlusion queries can skip, as bits. only_cuts()
    /// is true if the slot is one of these.
    static std::uint32_t only_cut_lanes(const SceneView& scene, std::uint32_t slot) {
        return scene.only_cut_lanes == nullptr ? 0 : scene.only_cut_lanes[slot / 16];
    }
    static bool only_cuts(const SceneView& scene, std::uint32_t slot) {
        return (only_cut_lanes(scene, slot) >> slot % 16 & 1) != 0;
    }

    /// True if the test of a slot's shape is deferred until a ray crosses it within a part that it
    /// cuts.
    static bool waits(const SceneView& scene, std::uint32_t slot) {
        return scene.deferred_lanes != nullptr &&
               (scene.deferred_lanes[slot / 16] >> slot % 16 & 1) != 0;
    }

    static core::Kind kind_of(std::uint32_t child) {
        return static_cast<core::Kind>(child >> 27 & 0xF);
    }
    static const TableView& table_of(const SceneView& scene, core::Kind kind) {
        return scene.tables[static_cast<int>(kind)];
    }
    /// Calls visit(kind) for the kinds whose bits are set.
    template <class Visit>
    [[gnu::always_inline]] static void for_each_kind(std::uint32_t kind_bits, const Visit& visit) {
        for (; kind_bits != 0; kind_bits &= kind_bits - 1)
            visit(static_cast<core::Kind>(__builtin_ctz(kind_bits)));
    }
    /// Returns a block of a table that is not packed. In scenes without a tree no table is packed.
    static const float* block_of(const TableView& table, std::uint32_t block) {
        return table.blocks + static_cast<std::size_t>(block) * table.block_floats;
    }
    /// Returns a block of any table: as it is stored, or unpacked to `room`.
    [[gnu::always_inline]] static const float* block_of(const TableView& table, std::uint32_t block,
                                                        BlockRoom<Arch>& room) {
        if (!table.is_packed()) [[likely]]
            return block_of(table, block);
        PackedSpheres<Arch>::unpack_apart(table.packed, block, room.rows);
        return room.rows[0];
    }
    /// Same for callers with one type of filter, which tells at compile time whether tables may be
    /// packed.
    template <class Filter>
    [[gnu::always_inline]] static const float*
    block_for(const TableView& table, std::uint32_t block, BlockRoom<Arch>& room) {
        if constexpr (of_spheres<Filter>())
            return block_of(table, block, room);
        else
            return block_of(table, block);
    }
    /// Calls visit() with the lanes of a block, for one ray. Packed spheres are unpacked in
    /// registers if possible. For solvers they are unpacked in memory, as their code is long and
    /// would be instantiated twice.
    template <class Filter, class Visit>
    [[gnu::always_inline]] static auto with_lanes(const TableView& table, std::uint32_t number,
                                                  const Visit& visit) {
        if constexpr (solves_shapes<Filter>()) {
            BlockRoom<Arch> room;
            return visit(PlainLanes<Arch>(table, block_for<Filter>(table, number, room)));
        } else if constexpr (of_spheres<Filter>()) {
            if (table.is_packed()) {
                const PackedBlockView& block = table.packed.blocks[number];
                if (PackedSpheres<Arch>::is_of_steps(block)) [[likely]]
                    return visit(PackedLanes<Arch>{table.packed, block});
                BlockRoom<Arch> room;
                PackedSpheres<Arch>::unpack_apart(table.packed, number, room.rows);
                return visit(PlainLanes<Arch>(table, room.rows[0]));
            }
        }
        return visit(PlainLanes<Arch>(table, block_of(table, number)));
    }
    /// Same for callers that need only the ids.
    template <class Filter, class Visit>
    [[gnu::always_inline]] static auto with_ids(const TableView& table, std::uint32_t number,
                                                const Visit& visit) {
        if constexpr (of_spheres<Filter>())
            if (table.is_packed())
                return visit(PackedLanes<Arch>{table.packed, table.packed.blocks[number]});
        return visit(PlainLanes<Arch>(table, block_of(table, number)));
    }
    /// Prefetches the rows of a packed block that are stored outside of it. The block itself must
    /// be loaded.
    template <class Filter>
    [[gnu::always_inline]] static void fetch_whole_rows(const TableView& table,
                                                        std::uint32_t number) {
        if constexpr (of_spheres<Filter>())
            if (table.is_packed()) PackedSpheres<Arch>::fetch_whole_rows(table.packed, number);
    }
    using Rows = const float (*)[16];
    static Rows rows_of(const float* block) { return reinterpret_cast<Rows>(block); }
    static const std::uint32_t* ids_of(const TableView& table, const float* block) {
        return reinterpret_cast<const std::uint32_t*>(block + std::size_t{16} * table.values);
    }
};

/// Rays of a stream, rounded to float.
template <class Arch>
struct RaysInFloat : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using Rays = FilterRays<Arch>;
    static constexpr bool rounded_alone = true; ///< rays before rounding are not needed

    /// Returns the rays from i on, one per lane.
    static Rays packet(const RoundedRays& rays, std::size_t i) {
        const auto load = [&](float* const(&from)[3]) {
            return Vectors<Arch>{S::load(from[0] + i), S::load(from[1] + i), S::load(from[2] + i)};
        };
        return {load(rays.origin), load(rays.direction), S::load(rays.slack + i)};
    }

    /// Returns ray i in all lanes.
    [[gnu::always_inline]] static Rays broadcast(const RoundedRays& rays, std::size_t i) {
        return {{F(rays.origin[0][i]), F(rays.origin[1][i]), F(rays.origin[2][i])},
                {F(rays.direction[0][i]), F(rays.direction[1][i]), F(rays.direction[2][i])},
                F(rays.slack[i])};
    }
};

} // namespace raylane::simd
