#pragma once

#include "core/shapes.hpp"

#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

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

/// Where a shape is in the table of its kind.
struct Slot {
    std::uint32_t block;
    std::uint8_t lane;
};

/// All shapes of one kind. In a finished scene each block is a leaf of the hierarchy, so blocks may
/// be partly empty.
template <class Shape>
class Table {
  public:
    std::size_t size() const { return size_; }
    const std::vector<Block<Shape>>& blocks() const { return blocks_; }
    Shape get(Slot slot) const { return blocks_[slot.block].get(slot.lane); }
    ShapeId id(Slot slot) const { return blocks_[slot.block].ids[slot.lane]; }
    std::size_t bytes() const { return blocks_.capacity() * sizeof(Block<Shape>); }

    void reserve(std::size_t count) { blocks_.reserve((count + block_size - 1) / block_size); }

    void add(const Shape& shape, ShapeId id) {
        const int lane = static_cast<int>(size_ % block_size);
        if (lane == 0) blocks_.emplace_back();
        blocks_.back().set(lane, shape, id);
        ++size_;
    }

    /// Puts blocks that hold the same shapes in another arrangement in place of these.
    void rearrange(std::vector<Block<Shape>> blocks) { blocks_ = std::move(blocks); }

  private:
    std::vector<Block<Shape>> blocks_;
    std::size_t size_ = 0;
};

/// One table per kind, in the order of `Kind`.
using Tables =
    std::tuple<Table<Sphere>, Table<Plane>, Table<Disc>, Table<Triangle>, Table<SmoothTriangle>,
               Table<Box>, Table<OpenCylinder>, Table<CappedCylinder>, Table<OpenCone>,
               Table<CappedCone>, Table<Quadric>>;
static_assert(std::tuple_size_v<Tables> == kind_count);

/// Calls `visit(table)` with the table of `kind`.
template <class TablesRef, class Visit>
decltype(auto) with_table(TablesRef&& tables, Kind kind, Visit&& visit) {
    switch (kind) {
    case Kind::sphere:
        return visit(std::get<Table<Sphere>>(tables));
    case Kind::plane:
        return visit(std::get<Table<Plane>>(tables));
    case Kind::disc:
        return visit(std::get<Table<Disc>>(tables));
    case Kind::triangle:
        return visit(std::get<Table<Triangle>>(tables));
    case Kind::smooth_triangle:
        return visit(std::get<Table<SmoothTriangle>>(tables));
    case Kind::box:
        return visit(std::get<Table<Box>>(tables));
    case Kind::open_cylinder:
        return visit(std::get<Table<OpenCylinder>>(tables));
    case Kind::capped_cylinder:
        return visit(std::get<Table<CappedCylinder>>(tables));
    case Kind::open_cone:
        return visit(std::get<Table<OpenCone>>(tables));
    case Kind::capped_cone:
        return visit(std::get<Table<CappedCone>>(tables));
    case Kind::quadric:
        break;
    }
    return visit(std::get<Table<Quadric>>(tables));
}

/// Calls `visit(shape, id)` for every shape of a table.
template <class Shape, class Visit>
void for_each_shape(const Table<Shape>& table, const Visit& visit) {
    for (const Block<Shape>& block : table.blocks())
        for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane)
            visit(block.get(lane), block.ids[lane]);
}

/// Calls `visit(table)` for every kind in order.
template <class TablesRef, class Visit>
void for_each_table(TablesRef&& tables, Visit&& visit) {
    std::apply([&](auto&... table) { (visit(table), ...); }, tables);
}

} // namespace raylane::core
