#include "core/scene/built_shapes.hpp"

#include "core/shapes/invalid_value.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>

namespace raylane::core {

namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw InvalidValue("", what);
}

class Checker {
  public:
    Checker(const BuiltShapes& shapes, std::size_t material_count, Workers& workers)
        : shapes_(shapes), materials_(material_count), workers_(workers) {}

    void check() {
        check_counts();
        check_materials();
        check_polygons();
        check_tree();
        for_each_table(shapes_.tables, [&](const auto& table) { check_table(table); });
        check_merged();
        check_bounds();
    }

  private:
    static constexpr std::size_t in_a_task = std::size_t{1} << 12;

    const BigArray<WideNode>& nodes() const { return shapes_.hierarchy.nodes; }
    std::size_t shape_count() const { return shapes_.material_of.size(); }

    /// Calls `is_right(i)` for all i below `count`; refuses with `what` if it is false for any.
    template <class IsRight>
    void require_all(std::size_t count, const char* what, const IsRight& is_right) {
        std::atomic<bool> are_valid = true;
        workers_.each((count + in_a_task - 1) / in_a_task, [&](std::size_t task) {
            const std::size_t last = std::min(count, (task + 1) * in_a_task);
            bool mine = true;
            for (std::size_t i = task * in_a_task; i < last && mine; ++i)
                mine = is_right(i);
            if (!mine) are_valid = false;
        });
        if (!are_valid) refuse(what);
    }

    void check_counts() const {
        std::size_t slots = 0, shapes = 0;
        for_each_table(shapes_.tables, [&](const auto& table) {
            if (table.block_count() > std::size_t{Child::max_index} + 1) refuse("too many blocks");
            if (table.has_doubles() && table.doubles().size() != table.block_count())
                refuse("doubles that do not match the blocks");
            slots += table.block_count() * block_size;
            shapes += table.size();
        });
        if (shape_count() > no_shape || slots >= no_shape || shapes != shape_count())
            refuse("inconsistent numbers of shapes");
    }

    void check_materials() {
        const MaterialIndices& materials = shapes_.material_of;
        if (shape_count() > 0 && materials_ == 0) refuse("shapes without a material");
        require_all(materials.width() == 0 ? 0 : materials.size(), "an invalid index of a material",
                    [&](std::size_t id) { return materials[id] < materials_; });
    }

    void check_polygons() const {
        std::size_t next = 0;
        for (const IdRange& polygon : shapes_.polygons) {
            if (polygon.first < next || polygon.last <= polygon.first ||
                polygon.last >= shape_count())
                refuse("polygons out of order");
            next = std::size_t{polygon.last} + 1;
        }
    }

    /// Checks that each node except the root has one parent, which comes before it, and that each
    /// block of a bounded kind has one parent.
    void check_tree() const {
        constexpr std::uint16_t max_levels = 4096; // limits recursion
        std::vector<std::uint16_t> level(nodes().size(), 0);
        std::vector<bool> seen[kind_count];
        for_each_table(shapes_.tables, [&]<class Shape>(const Table<Shape>& table) {
            if (is_bounded<Shape>)
                seen[static_cast<std::size_t>(kind_of<Shape>)].resize(table.block_count());
        });
        for (std::size_t i = 0; i < nodes().size(); ++i) {
            if (i > 0 && level[i] == 0) refuse("a node without a parent");
            bool is_over = false;
            for (const Child child : nodes()[i].children) {
                if (child.empty()) {
                    is_over = true;
                    continue;
                }
                if (is_over) refuse("a child after an empty one");
                if (child.is_block()) {
                    const auto kind = static_cast<std::size_t>(child.kind());
                    if (kind >= kind_count || child.index() >= seen[kind].size() ||
                        seen[kind][child.index()])
                        refuse("a missing or repeated block");
                    seen[kind][child.index()] = true;
                } else {
                    if (child.index() <= i || child.index() >= nodes().size() ||
                        level[child.index()] != 0 || level[i] >= max_levels)
                        refuse("nodes that do not form a tree");
                    level[child.index()] = static_cast<std::uint16_t>(level[i] + 1);
                }
            }
        }
        for (const std::vector<bool>& of_kind : seen)
            if (!std::all_of(of_kind.begin(), of_kind.end(), [](bool is_seen) { return is_seen; }))
                refuse("a block without a node");
    }

    template <class Shape>
    void check_table(const Table<Shape>& table) {
        if (const PackedSpheres* packed = table.packed()) check_packed(*packed);
        std::atomic<std::size_t> shapes = 0;
        require_all(table.block_count(), "an invalid shape", [&](std::size_t index) {
            const Block<Shape>& block = table.blocks()[index];
            const auto end = std::find(std::begin(block.ids), std::end(block.ids), no_shape);
            const auto count = static_cast<int>(end - std::begin(block.ids));
            shapes += static_cast<std::size_t>(count);
            if (count == 0) return false;
            for (int lane = 0; lane < block_size; ++lane)
                if (!(lane < count ? is_right(table, block, index, lane) : is_empty(block, lane)))
                    return false;
            return true;
        });
        const auto& merged = shapes_.merged[static_cast<std::size_t>(kind_of<Shape>)];
        if (shapes + merged.size() != table.size()) refuse("other numbers of shapes than stated");
    }

    /// Checks that merged shapes are not stored, of whatever kind, and not merged twice. The shapes
    /// that they equal must be stored, with the same kind.
    void check_merged() const {
        if (std::ranges::all_of(shapes_.merged, [](const auto& merged) { return merged.empty(); }))
            return;
        constexpr std::uint8_t nowhere = kind_count, merged = kind_count + 1;
        std::vector<std::uint8_t> place(shape_count(),
                                        nowhere); // or the kind in which it is stored
        for_each_table(shapes_.tables, [&]<class Shape>(const Table<Shape>& table) {
            for_each_shape(table, [&](const auto&, ShapeId id) {
                place[id] = static_cast<std::uint8_t>(kind_of<Shape>);
            });
        });
        for (std::size_t kind = 0; kind < kind_count; ++kind) {
            ShapeId next = 0;
            for (const MergedShape& shape : shapes_.merged[kind]) {
                if (shape.id < next || shape.id >= shape_count() || shape.first >= shape.id ||
                    place[shape.id] != nowhere || place[shape.first] != kind)
                    refuse("merged shapes out of order");
                place[shape.id] = merged;
                next = shape.id + 1;
            }
        }
    }

    /// Filters look only at the ids of the shapes that they find, so an empty lane must contain
    /// NaNs.
    template <class Shape>
    static bool is_empty(const Block<Shape>& block, int lane) {
        return block.ids[lane] == no_shape &&
               std::ranges::all_of(block.values,
                                   [&](const auto& row) { return std::isnan(row[lane]); });
    }

    template <class Shape>
    bool is_right(const Table<Shape>& table, const Block<Shape>& block, std::size_t index,
                  int lane) const {
        if (block.ids[lane] >= shape_count()) return false;
        const Shape shape = block.get(lane);
        try {
            if (!table.has_doubles()) {
                validate(shape);
                return true;
            }
            const InDouble<Shape> exact = table.doubles()[index].get(lane);
            validate(exact);
            return numbers_of(to_floats(exact)) == numbers_of(shape);
        } catch (const InvalidValue&) {
            return false;
        }
    }

    /// Checks packed spheres. Call before reading any of them.
    void check_packed(const PackedSpheres& packed) {
        if (shape_count() > max_packed_ids) refuse("too many packed spheres");
        require_all(packed.blocks.size(), "invalid packed spheres", [&](std::size_t index) {
            const PackedBlock& block = packed.blocks[index];
            const std::size_t first = block.own_rows >> PackedBlock::rows;
            if (first + static_cast<std::size_t>(block.whole_rows()) > packed.rows.size())
                return false;
            const bool has_radii = (block.own_rows & PackedBlock::is_whole << 3) != 0;
            return std::ranges::all_of(block.words, [&](std::uint32_t word) {
                return word == PackedBlock::empty || has_radii ||
                       word >> packed.palette.id_bits() < packed.palette.size();
            });
        });
    }

    template <class Shape>
    static Bounds bounds_of_block(const Table<Shape>& table, std::uint32_t index) {
        Bounds bounds;
        const Block<Shape>& block = table.blocks()[index];
        for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane)
            bounds.include(table.has_doubles() ? bounds_of(table.doubles()[index].get(lane))
                                               : bounds_of(block.get(lane)));
        return bounds;
    }

    /// Returns true if a child is within the bounds that its parent stores for it. Shapes must not
    /// touch the bounds.
    bool is_within(const Bounds& bounds, Child child) const {
        const auto contains = [&](const Bounds& inner, const auto& less) {
            for (int axis = 0; axis < 3; ++axis)
                if (!less(bounds.lower[axis], inner.lower[axis]) ||
                    !less(inner.upper[axis], bounds.upper[axis]))
                    return false;
            return true;
        };
        if (!child.is_block()) return contains(nodes()[child.index()].bounds(), std::less_equal());
        bool is_in = false;
        with_table(shapes_.tables, child.kind(), [&]<class Shape>(const Table<Shape>& table) {
            if constexpr (is_bounded<Shape>)
                is_in = contains(bounds_of_block(table, child.index()), std::less());
        });
        return is_in;
    }

    /// Returns true if bounds are those of no child. Traversals read the bounds of an entry, not
    /// whether it has a child.
    static bool is_of_nothing(const Bounds& bounds) {
        const Bounds nothing = WideNode().bounds(0);
        return bounds.lower == nothing.lower && bounds.upper == nothing.upper;
    }

    void check_bounds() {
        require_all(nodes().size(), "a shape outside of its bounds", [&](std::size_t index) {
            const WideNode& node = nodes()[index];
            for (int entry = 0; entry < block_size; ++entry) {
                const Child child = node.children[entry];
                const Bounds bounds = node.bounds(entry);
                const bool is_right = child.empty() ? is_of_nothing(bounds)
                                                    : is_finite(bounds) && is_within(bounds, child);
                if (!is_right) return false;
            }
            return true;
        });
    }

    const BuiltShapes& shapes_;
    std::size_t materials_;
    Workers& workers_;
};

} // namespace

void check(const BuiltShapes& shapes, std::size_t material_count, Workers& workers) {
    Checker(shapes, material_count, workers).check();
}

} // namespace raylane::core
