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

/// 16 shapes of one kind, structure of arrays: value k of lane i is values[k][i]. An empty lane
/// holds NaN and no_shape.
template <class Shape>
struct alignas(64) Block {
    float values[float_count<Shape>][block_size];
    ShapeId ids[block_size];

    Block() {
        for (auto& row : values)
            for (float& value : row)
                value = std::numeric_limits<float>::quiet_NaN();
        for (ShapeId& id : ids)
            id = no_shape;
    }

    Shape get(int lane) const {
        Floats<Shape> floats;
        for (int k = 0; k < float_count<Shape>; ++k)
            floats[k] = values[k][lane];
        return shape_of<Shape>(floats);
    }

    void set(int lane, const Shape& shape, ShapeId id) {
        const Floats<Shape> floats = floats_of(shape);
        for (int k = 0; k < float_count<Shape>; ++k)
            values[k][lane] = floats[k];
        ids[lane] = id;
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
    Table(BigArray<Block<Shape>> blocks, std::size_t size)
        : blocks_(std::move(blocks)), size_(size) {}
    /// Table in the list's order.
    explicit Table(const ShapeList<Shape>& list) : Table(list, list.size()) {}
    Table(const ShapeList<Shape>& list, std::size_t size)
        : blocks_((list.size() + block_size - 1) / block_size), size_(size) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            Block<Shape>& block = blocks_[i / block_size];
            if (i % block_size == 0) block = Block<Shape>();
            block.set(static_cast<int>(i % block_size), list[i].shape, list[i].id);
        }
    }

    /// Number of shapes with duplicates, of which the blocks have one each.
    std::size_t size() const { return size_; }
    const BigArray<Block<Shape>>& blocks() const { return blocks_; }
    Shape get(Place place) const { return blocks_[place.block].get(place.lane); }
    ShapeId id(Place place) const { return blocks_[place.block].ids[place.lane]; }
    std::size_t bytes() const { return blocks_.bytes(); }

  private:
    BigArray<Block<Shape>> blocks_;
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

/// Calls `visit(shape, id)` for every shape of a table.
template <class Shape, class Visit>
void for_each_shape(const Table<Shape>& table, const Visit& visit) {
    for (const Block<Shape>& block : table.blocks())
        for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane)
            visit(block.get(lane), block.ids[lane]);
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
