#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/shape_list.hpp"
#include "core/shapes/shapes.hpp"

#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

namespace raylane::core {

/// Shapes to a block: as many as the widest packet has lanes.
inline constexpr int block_size = 16;

/// The floats of 16 shapes of one kind, or those nearest to their numbers, structure of arrays:
/// value k of lane i is values[k][i]. An empty lane holds NaN and no_shape.
template <class Shape>
struct alignas(64) Block {
    float values[number_count<Shape>][block_size];
    ShapeId ids[block_size];

    Block() {
        for (auto& row : values)
            for (float& value : row)
                value = std::numeric_limits<float>::quiet_NaN();
        for (ShapeId& id : ids)
            id = no_shape;
    }

    Shape get(int lane) const {
        Numbers<Shape> floats;
        for (int k = 0; k < number_count<Shape>; ++k)
            floats[k] = values[k][lane];
        return shape_of<Shape>(floats);
    }

    void set(int lane, const Shape& shape, ShapeId id) {
        const Numbers<Shape> floats = numbers_of(shape);
        for (int k = 0; k < number_count<Shape>; ++k)
            values[k][lane] = floats[k];
        ids[lane] = id;
    }
};

/// What the same 16 shapes are exactly, where that is no floats. It has as many rows as a Block has
/// with its ids, so that places in both are as far from the table's first.
template <class Shape>
struct alignas(64) DoubleBlock {
    double values[number_count<Shape> + 1][block_size];

    DoubleBlock() {
        for (auto& row : values)
            for (double& value : row)
                value = std::numeric_limits<double>::quiet_NaN();
    }

    InDouble<Shape> get(int lane) const {
        Numbers<InDouble<Shape>> numbers;
        for (int k = 0; k < number_count<Shape>; ++k)
            numbers[k] = values[k][lane];
        return shape_of<InDouble<Shape>>(numbers);
    }

    void set(int lane, const InDouble<Shape>& shape) {
        const Numbers<InDouble<Shape>> numbers = numbers_of(shape);
        for (int k = 0; k < number_count<Shape>; ++k)
            values[k][lane] = numbers[k];
    }
};

/// Blocks of a table; and as many of doubles, or none where floats are what the shapes are.
template <class Shape>
struct Blocks {
    BigArray<Block<Shape>> floats;
    BigArray<DoubleBlock<Shape>> doubles;

    Blocks() = default;
    Blocks(std::size_t count, bool has_doubles) : floats(count), doubles(has_doubles ? count : 0) {}

    /// Fills a block with shapes of a list, those at position(lane).
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

/// Place of a shape in the table of its kind.
struct Place {
    std::uint32_t block;
    std::uint8_t lane;
};

/// All shapes of one kind, in a finished scene. Each block of a bounded kind is a leaf of the
/// hierarchy, so blocks may be partly empty.
template <class Shape>
class Table {
  public:
    Table() = default;
    /// `size` shapes in all, with duplicates.
    Table(Blocks<Shape> blocks, std::size_t size) : blocks_(std::move(blocks)), size_(size) {}
    /// Table in the list's order.
    explicit Table(const ShapeList<Shape>& list) : Table(list, list.size()) {}
    Table(const ShapeList<Shape>& list, std::size_t size)
        : blocks_((list.size() + block_size - 1) / block_size, list.has_doubles()), size_(size) {
        for (std::size_t first = 0; first < list.size(); first += block_size)
            blocks_.fill(first / block_size, list,
                         static_cast<int>(std::min<std::size_t>(list.size() - first, block_size)),
                         [first](int lane) { return first + static_cast<std::size_t>(lane); });
    }

    /// Number of shapes with duplicates, of which the blocks have one each.
    std::size_t size() const { return size_; }
    const BigArray<Block<Shape>>& blocks() const { return blocks_.floats; }
    bool has_doubles() const { return !blocks_.doubles.empty(); }
    /// If it has any: as many as blocks.
    const BigArray<DoubleBlock<Shape>>& doubles() const { return blocks_.doubles; }
    /// Exactly the shape.
    InDouble<Shape> get(Place place) const {
        const std::size_t count = blocks_.floats.size();
        if (place.block >= count) [[unlikely]]
            return get(hidden_, {static_cast<std::uint32_t>(place.block - count), place.lane});
        return get(blocks_, place);
    }
    ShapeId id(Place place) const { return blocks_.floats[place.block].ids[place.lane]; }
    std::size_t bytes() const {
        return blocks_.floats.bytes() + blocks_.doubles.bytes() + hidden_.floats.bytes() +
               hidden_.doubles.bytes();
    }

    /// Keeps shapes that no ray is to cross, in places behind those of the blocks; shape i of them
    /// is at hidden_place(i).
    void hide(const ShapeList<Shape>& list) { hidden_ = Table(list).blocks_; }
    Place hidden_place(std::size_t i) const {
        return {static_cast<std::uint32_t>(blocks_.floats.size() + i / block_size),
                static_cast<std::uint8_t>(i % block_size)};
    }

  private:
    static InDouble<Shape> get(const Blocks<Shape>& blocks, Place place) {
        return blocks.doubles.empty() ? to_doubles(blocks.floats[place.block].get(place.lane))
                                      : blocks.doubles[place.block].get(place.lane);
    }

    Blocks<Shape> blocks_;
    Blocks<Shape> hidden_;
    std::size_t size_ = 0;
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
    const Block<Shape>& block = table.blocks()[index];
    for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane)
        visit(Place{index, static_cast<std::uint8_t>(lane)}, block.ids[lane]);
}

/// Calls `visit(shape, id)` for every shape of a table.
template <class Shape, class Visit>
void for_each_shape(const Table<Shape>& table, const Visit& visit) {
    for (std::uint32_t index = 0; index < table.blocks().size(); ++index)
        for_each_in_block(table, index,
                          [&](Place place, ShapeId id) { visit(table.get(place), id); });
}

/// Calls `visit(table)` for every kind in order; so it does with lists.
template <class TablesRef, class Visit>
void for_each_table(TablesRef&& tables, Visit&& visit) {
    std::apply([&](auto&... table) { (visit(table), ...); }, tables);
}

/// The same for the kinds that have bounds, and so are in the hierarchy; and for the others.
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
