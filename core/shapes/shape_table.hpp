#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/block.hpp"
#include "core/shapes/packed_spheres.hpp"
#include "core/shapes/shape_list.hpp"

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace raylane::core {

/// Blocks of a table, and as many blocks of doubles, or none if all numbers are floats.
template <class Shape>
struct Blocks {
    BigArray<Block<Shape>> floats;
    BigArray<DoubleBlock<Shape>> doubles;

    Blocks() = default;
    Blocks(std::size_t count, bool has_doubles) : floats(count), doubles(has_doubles ? count : 0) {}

    /// Fills a block with the shapes of a list at position(lane).
    template <class Position>
    void fill(std::size_t index, const ShapeList<Shape>& list, int count,
              const Position& position) {
        Block<Shape> block;
        for (int lane = 0; lane < count; ++lane) {
            const Listed<Shape>& listed = list[position(lane)];
            block.set(lane, listed.shape, listed.id);
        }
        floats[index] = block;
        if (doubles.empty()) return;
        DoubleBlock<Shape> exact;
        for (int lane = 0; lane < count; ++lane)
            exact.set(lane, list.exact(position(lane)));
        doubles[index] = exact;
    }
};

/// Position of a shape in the table of its kind.
struct Place {
    std::uint32_t block;
    std::uint8_t lane;
};

/// All shapes of one kind, in a finished scene. Each block of a bounded kind is a leaf of the
/// hierarchy, so blocks may be partly empty. If there are many spheres, their blocks are packed.
template <class Shape>
class Table {
  public:
    /// True for kinds whose blocks may be packed.
    static constexpr bool packs = kind_of<Shape> == Kind::sphere;

    /// The blocks, packed or not. An element of a packed range is a block by value.
    class BlockRange {
      public:
        using Reference = std::conditional_t<packs, Block<Shape>, const Block<Shape>&>;
        struct Iterator {
            const Table* table;
            std::size_t index;
            Reference operator*() const { return BlockRange(*table)[index]; }
            Iterator& operator++() {
                ++index;
                return *this;
            }
            bool operator!=(const Iterator& other) const { return index != other.index; }
        };

        explicit BlockRange(const Table& table) : table_(&table) {}
        std::size_t size() const { return table_->block_count(); }
        Reference operator[](std::size_t index) const {
            if constexpr (packs)
                if (table_->is_packed()) return table_->packed_.block(index);
            return table_->blocks_.floats[index];
        }
        Iterator begin() const { return {table_, 0}; }
        Iterator end() const { return {table_, size()}; }

      private:
        const Table* table_;
    };

    Table() = default;
    /// `size`: the number of shapes, including duplicates.
    Table(Blocks<Shape> blocks, std::size_t size) : blocks_(std::move(blocks)), size_(size) {}
    /// Builds a table in the list's order.
    explicit Table(const ShapeList<Shape>& list) : Table(list, list.size()) {}
    Table(const ShapeList<Shape>& list, std::size_t size)
        : blocks_((list.size() + block_size - 1) / block_size, list.has_doubles()), size_(size) {
        for (std::size_t first = 0; first < list.size(); first += block_size)
            blocks_.fill(first / block_size, list,
                         static_cast<int>(std::min<std::size_t>(list.size() - first, block_size)),
                         [first](int lane) { return first + static_cast<std::size_t>(lane); });
    }

    /// Returns the number of shapes, including duplicates. The blocks have one of each set of
    /// duplicates.
    std::size_t size() const { return size_; }
    std::size_t block_count() const {
        if constexpr (packs)
            if (is_packed()) return packed_.blocks.size();
        return blocks_.floats.size();
    }
    BlockRange blocks() const { return BlockRange(*this); }
    /// Calls visit(block), without copying blocks that are not packed.
    template <class Visit>
    decltype(auto) visit_block(std::size_t index, const Visit& visit) const {
        if constexpr (packs)
            if (is_packed()) return visit(std::as_const(packed_).block(index));
        return visit(blocks_.floats[index]);
    }
    bool has_doubles() const { return blocks_.doubles.data() != nullptr; }
    /// Returns the doubles of each block, or an empty array.
    const BigArray<DoubleBlock<Shape>>& doubles() const { return blocks_.doubles; }
    /// Returns the exact shape.
    InDouble<Shape> get(Place place) const {
        const std::size_t count = block_count() + copied_;
        if (place.block >= count) [[unlikely]]
            return get(hidden_, {static_cast<std::uint32_t>(place.block - count), place.lane});
        if constexpr (packs)
            if (is_packed()) return to_doubles(packed_.get(place.block, place.lane));
        return get(blocks_, place);
    }
    ShapeId id(Place place) const {
        if constexpr (packs)
            if (is_packed()) return packed_.id(place.block, place.lane);
        return blocks_.floats[place.block].ids[place.lane];
    }
    std::size_t bytes() const {
        return blocks_.floats.bytes() + blocks_.doubles.bytes() + hidden_.floats.bytes() +
               hidden_.doubles.bytes() + (is_packed() ? packed()->bytes() : 0);
    }

    /// Returns null if the blocks are not packed.
    const PackedSpheres* packed() const {
        if constexpr (packs)
            return packed_.empty() ? nullptr : &packed_;
        else
            return nullptr;
    }
    bool is_packed() const { return packed() != nullptr; }
    /// Returns all blocks, contiguously, if they are not packed.
    const BigArray<Block<Shape>>& plain_blocks() const { return blocks_.floats; }
    /// Replaces the blocks by packed ones, without doubles.
    void replace_blocks(PackedSpheres packed) {
        packed_ = std::move(packed);
        blocks_ = {};
    }
    void replace_blocks(Blocks<Shape> blocks) {
        packed_ = decltype(packed_)();
        blocks_ = std::move(blocks);
    }

    /// Replaces the blocks by the first `count` ones of a larger array. The others are those of
    /// copies (see Copies), which makes each before anything reads it. They do not count as blocks
    /// of the table.
    void extend_blocks(const Blocks<Shape>& blocks, std::size_t count) {
        copied_ = blocks.floats.size() - count;
        blocks_.floats = blocks.floats.first(count);
        blocks_.doubles = blocks.doubles.first(count);
    }
    /// Returns the number of blocks of copies behind those of the table.
    std::size_t copied_blocks() const { return copied_; }

    /// Stores shapes that rays must not cross, at positions behind those of the blocks. Shape i of
    /// them is at hidden_place(i).
    void hide(const ShapeList<Shape>& list) { hidden_ = Table(list).blocks_; }
    Place hidden_place(std::size_t i) const {
        return {static_cast<std::uint32_t>(block_count() + copied_ + i / block_size),
                static_cast<std::uint8_t>(i % block_size)};
    }

  private:
    static InDouble<Shape> get(const Blocks<Shape>& blocks, Place place) {
        // All blocks may be of copies.
        return blocks.doubles.data() == nullptr
                   ? to_doubles(blocks.floats[place.block].get(place.lane))
                   : blocks.doubles[place.block].get(place.lane);
    }

    Blocks<Shape> blocks_;
    struct NeverPacked {};
    std::conditional_t<packs, PackedSpheres, NeverPacked> packed_; // replaces blocks_ unless empty
    Blocks<Shape> hidden_;
    std::size_t size_ = 0;
    std::size_t copied_ = 0; // blocks
};

/// One table per kind, in the order of `Kind`.
using Tables = OfEachShape<Table>;

/// Calls `visit(table)` with the table of `kind`.
template <class TablesRef, class Visit>
decltype(auto) with_table(TablesRef&& tables, Kind kind, Visit&& visit) {
    return with_shape_type(kind, [&]<class Shape>(std::type_identity<Shape>) -> decltype(auto) {
        return visit(std::get<Table<Shape>>(tables));
    });
}

/// Calls `visit(place, id)` for every shape of a block.
template <class Shape, class Visit>
void for_each_in_block(const Table<Shape>& table, std::uint32_t index, const Visit& visit) {
    for (std::uint8_t lane = 0; lane < block_size; ++lane) {
        const Place place{index, lane};
        const ShapeId id = table.id(place);
        if (id == no_shape) return;
        visit(place, id);
    }
}

/// Calls `visit(shape, id)` for every shape of a table.
template <class Shape, class Visit>
void for_each_shape(const Table<Shape>& table, const Visit& visit) {
    for (std::uint32_t index = 0; index < table.blocks().size(); ++index)
        for_each_in_block(table, index,
                          [&](Place place, ShapeId id) { visit(table.get(place), id); });
}

/// Calls `visit(table)` for every kind in order. Also works with lists.
template <class TablesRef, class Visit>
void for_each_table(TablesRef&& tables, Visit&& visit) {
    std::apply([&](auto&... table) { (visit(table), ...); }, tables);
}

/// Calls `visit(table)` for the bounded kinds, which are in the hierarchy, or for the other kinds.
template <class TablesRef, class Visit>
void for_each_bounded_table(TablesRef&& tables, Visit&& visit) {
    for_each_table(tables, [&]<template <class> class Of, class Shape>(const Of<Shape>& table) {
        if constexpr (is_bounded<Shape>) visit(table);
    });
}
template <class TablesRef, class Visit>
void for_each_unbounded_table(TablesRef&& tables, Visit&& visit) {
    for_each_table(tables, [&]<template <class> class Of, class Shape>(const Of<Shape>& table) {
        if constexpr (!is_bounded<Shape>) visit(table);
    });
}

} // namespace raylane::core
