#include "core/hierarchy/moved_spheres.hpp"

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/emission.hpp"
#include "core/hierarchy/equal_spheres.hpp"
#include "core/hierarchy/packing.hpp"
#include "core/hierarchy/refit.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

namespace raylane::core {

namespace {

/// Number of blocks in a task: enough to be worth the overhead, and few enough for the cache.
constexpr std::size_t blocks_moved_at_a_time = std::size_t{1} << 7;

/// Numbers the spheres that are not parts of solids, in the order of their ids.
class SphereNumbers {
  public:
    explicit SphereNumbers(const MovableShapes& shapes) {
        const auto& table = std::get<Table<Sphere>>(shapes.tables);
        count_ = table.size();
        if (count_ == shapes.material_of.size() && !shapes.solids.any()) return;
        words_.resize(shapes.material_of.size() / bits + 1);
        const auto add = [&](ShapeId id) {
            words_[id / bits].movable |= std::uint64_t{1} << id % bits;
        };
        for (std::uint32_t block = 0; block < table.block_count(); ++block)
            for_each_in_block(table, block, [&](Place, ShapeId id) {
                if (!shapes.solids.has(id)) add(id);
            });
        for (const MergedShape& sphere : shapes.merged)
            add(sphere.id);
        count_ = 0;
        for (Word& word : words_) {
            word.before = static_cast<std::uint32_t>(count_);
            count_ += static_cast<std::size_t>(std::popcount(word.movable));
        }
    }

    std::size_t count() const { return count_; }
    std::size_t operator[](ShapeId id) const {
        if (words_.empty()) return id;
        const Word& word = words_[id / bits];
        const std::uint64_t below = (std::uint64_t{1} << id % bits) - 1;
        return word.before + static_cast<std::size_t>(std::popcount(word.movable & below));
    }

  private:
    static constexpr std::size_t bits = 64;
    struct Word {
        std::uint64_t movable = 0; ///< the ids of these spheres, as bits
        std::uint32_t before = 0;  ///< how many of them earlier words have
    };

    std::vector<Word> words_; // empty: each id is its number
    std::size_t count_ = 0;
};

/// Checks the coordinates. Returns true if all of them are floats.
template <class Number>
bool check_coordinates(std::span<const Number> coordinates, std::size_t count) {
    if (coordinates.size() != 3 * count)
        throw InvalidValue("positions", "must have one element for each of " +
                                            std::to_string(count) + " spheres, got " +
                                            std::to_string(coordinates.size() / 3));
    bool are_valid = true, are_floats = true;
    for (const Number value : coordinates) {
        const bool is_float = checks::is_float(value);
        are_valid &= std::abs(value) <= Number(coordinate_limit) &&
                     (is_float || std::abs(value) >= Number(min_double));
        are_floats &= is_float;
    }
    for (std::size_t i = 0; !are_valid && i < count; ++i)
        checks::require_point(
            checks::Field("positions").at(static_cast<int>(i)),
            Vec3<Number>(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]));
    return are_floats;
}

/// Moves the spheres of all blocks and finds the blocks' bounds.
template <class Number>
class SphereMover {
  public:
    SphereMover(std::span<const Number> coordinates, const MovableShapes& shapes)
        : coordinates_(coordinates), shapes_(shapes), numbers_(shapes),
          table_(std::get<Table<Sphere>>(shapes.tables)) {}

    void move(Workers& workers) {
        const bool are_floats = check_coordinates(coordinates_, numbers_.count());
        const std::size_t count = table_.block_count();
        blocks = Blocks<Sphere>(count, !are_floats || keeps_doubles());
        bounds = BigArray<Bounds>(count);
        EqualSpheres equal(count * block_size);
        std::mutex mutex;
        workers.each((count + blocks_moved_at_a_time - 1) / blocks_moved_at_a_time,
                     [&](std::size_t task) {
                         const std::size_t first = task * blocks_moved_at_a_time;
                         const std::size_t last = std::min(first + blocks_moved_at_a_time, count);
                         for (std::size_t i = first; i < last; ++i)
                             move_block(static_cast<std::uint32_t>(i));
                         const std::lock_guard lock(mutex);
                         equal.add(blocks, first, last, shapes_.material_of, shapes_.solids);
                     });
        may_have_duplicates = shapes_.merge && equal.may_be_any();
    }

    /// Returns true if the merged spheres are still equal to those that they were equal to.
    bool keeps_merged() const {
        return std::all_of(
            shapes_.merged.begin(), shapes_.merged.end(), [&](const MergedShape& sphere) {
                const Number *const one = at(sphere.id), *const other = at(sphere.first);
                return std::memcmp(one, other, 3 * sizeof *one) == 0; // NOLINT: compares bits
            });
    }

    std::size_t count() const { return numbers_.count(); }
    InDouble<Sphere> moved(ShapeId id, double radius) const {
        const Number* const center = at(id);
        return {{center[0], center[1], center[2]}, radius};
    }

    Blocks<Sphere> blocks;
    BigArray<Bounds> bounds;
    bool may_have_duplicates = false;

  private:
    /// Returns true if a number other than a centre that moves is not a float.
    bool keeps_doubles() const {
        bool keeps = false;
        for (std::uint32_t i = 0; table_.has_doubles() && !keeps && i < table_.block_count(); ++i)
            for_each_in_block(table_, i, [&](Place place, ShapeId id) {
                const InDouble<Sphere> sphere = table_.get(place);
                keeps = keeps || !(shapes_.solids.has(id) ? is_in_floats(sphere)
                                                          : checks::is_float(sphere.radius));
            });
        return keeps;
    }
    const Number* at(ShapeId id) const { return &coordinates_[3 * numbers_[id]]; }

    void move_block(std::uint32_t index) {
        // Prefetches centers for a later block. The spheres of a block are scattered over them.
        // (g++ 12 drops calls of a function that does nothing else.)
        constexpr std::uint32_t ahead = 4;
        for (std::uint8_t lane = 0; lane < block_size && index + ahead < bounds.size(); ++lane)
            if (const ShapeId id = table_.id({index + ahead, lane});
                id != no_shape && !shapes_.solids.has(id))
                __builtin_prefetch(at(id));
        const bool has_doubles = !blocks.doubles.empty();
        Block<Sphere> block;
        DoubleBlock<Sphere> exact;
        Bounds moved_bounds;
        WidenedBounds of_doubles;
        for (std::uint8_t lane = 0; lane < block_size; ++lane) {
            const Place place{index, lane};
            const ShapeId id = table_.id(place);
            if (id == no_shape) break;
            if (const Bounds* const of_part = shapes_.solids.bounds_of(id); of_part != nullptr) {
                const InDouble<Sphere> sphere = table_.get(place);
                block.set(lane, to_floats(sphere), id);
                exact.set(lane, sphere);
                moved_bounds.include(*of_part);
                continue;
            }
            const InDouble<Sphere> sphere = moved(id, radius_at(place));
            const Sphere rounded{convert<float>(sphere.center), static_cast<float>(sphere.radius)};
            block.set(lane, rounded, id);
            if (has_doubles) {
                exact.set(lane, sphere);
                of_doubles.include(sphere.center, Vec3d(sphere.radius), absolute(sphere.center));
            } else {
                moved_bounds.include(bounds_of(rounded));
            }
        }
        if (has_doubles) {
            moved_bounds.include(of_doubles.rounded());
            blocks.doubles[index] = exact;
        }
        blocks.floats[index] = block;
        bounds[index] = moved_bounds;
    }

    double radius_at(Place place) const {
        constexpr int radius = 3;
        if (table_.is_packed()) return table_.get(place).radius;
        if (table_.has_doubles()) return table_.doubles()[place.block].values[radius][place.lane];
        return static_cast<double>(table_.plain_blocks()[place.block].values[radius][place.lane]);
    }

    std::span<const Number> coordinates_;
    const MovableShapes& shapes_;
    SphereNumbers numbers_;
    const Table<Sphere>& table_;
};

/// Rebuilds subtrees of a hierarchy.
class Rebuilder {
  public:
    Rebuilder(const MovableShapes& shapes, Workers& workers)
        : shapes_(shapes), workers_(workers), tree_of_(nodes().size(), none) {
        kept_.nodes = static_cast<std::uint32_t>(nodes().size());
        for_each_bounded_table(shapes.tables, [&]<class Shape>(const Table<Shape>& table) {
            constexpr auto kind = static_cast<std::size_t>(kind_of<Shape>);
            has_doubles_[kind] = table.has_doubles();
            kept_.blocks[kind] = static_cast<std::uint32_t>(table.block_count());
        });
    }

    /// Adds the shapes below a node to those of the next tree.
    void gather(std::uint32_t subtree) {
        std::vector<Child> pending = {Child::node(subtree)};
        while (!pending.empty()) {
            const Child child = pending.back();
            pending.pop_back();
            if (child.is_block()) {
                gather_block(child);
                continue;
            }
            --kept_.nodes;
            const WideNode& node = nodes()[child.index()];
            for (int entry = block_size; entry-- > 0;)
                if (!node.children[entry].empty()) pending.push_back(node.children[entry]);
        }
    }
    void gather(const InDouble<Sphere>& sphere, ShapeId id) {
        constexpr auto kind = static_cast<std::size_t>(Kind::sphere);
        std::get<ShapeList<Sphere>>(lists_).add(sphere, id, has_doubles_[kind]);
    }
    /// Completes the next tree, which replaces a node.
    void end_tree(std::uint32_t node) {
        tree_of_[node] = static_cast<std::uint32_t>(ends_.size());
        EndsOfLists& ends = ends_.emplace_back();
        for_each_bounded_table(lists_, [&]<class Shape>(const ShapeList<Shape>& list) {
            ends[static_cast<std::size_t>(kind_of<Shape>)] = list.size();
        });
    }

    /// Builds the trees. Returns the spheres that have been merged.
    std::vector<MergedShape> rebuild() {
        const Duplicates duplicates(lists_, shapes_.material_of, shapes_.polygons, &shapes_.solids,
                                    shapes_.merge);
        forest_ = build_binary_forest(lists_, ends_, duplicates, workers_);
        std::vector<float> costs;
        emission_ = tree_of_[0] != none ? emit_all(forest_, lists_, has_doubles_, workers_)
                                        : emit_between_kept(costs);
        shapes_.hierarchy = hierarchy_of(std::move(emission_.nodes));
        shapes_.hierarchy.built_costs = std::move(costs);
        for_each_table(shapes_.tables, [&]<class Shape>(Table<Shape>& table) {
            if constexpr (is_bounded<Shape>)
                table.replace_blocks(std::move(emission_.blocks<Shape>()));
        });
        return std::move(duplicates.merged()[static_cast<std::size_t>(Kind::sphere)]);
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    const BigArray<WideNode>& nodes() const { return shapes_.hierarchy.nodes; }

    template <class Visit>
    void with_bounded_table(Kind kind, const Visit& visit) const {
        with_table(shapes_.tables, kind, [&]<class Shape>(const Table<Shape>& table) {
            if constexpr (is_bounded<Shape>) visit(table);
        });
    }

    void gather_block(Child child) {
        --kept_.blocks[static_cast<std::size_t>(child.kind())];
        with_bounded_table(child.kind(), [&]<class Shape>(const Table<Shape>& table) {
            auto& list = std::get<ShapeList<Shape>>(lists_);
            for_each_in_block(table, child.index(), [&](Place place, ShapeId id) {
                if (table.has_doubles())
                    list.add(table.get(place), id, true);
                else
                    list.add(table.plain_blocks()[place.block].get(place.lane), id);
            });
        });
    }

    /// Emits the kept nodes with the trees between them. Sets the costs of all nodes.
    Emission emit_between_kept(std::vector<float>& costs) {
        Tally size = kept_, next;
        for (TreePart& tree : forest_.trees)
            size += size_of(tree, forest_.node_width, workers_);
        emission_ = Emission(size, has_doubles_);
        costs.assign(size.nodes, unknown_cost);
        keep(0, costs, next);
        add_costs(emission_.nodes, costs);
        return std::move(emission_);
    }

    Child keep(std::uint32_t index, std::vector<float>& costs, Tally& next) {
        if (const std::uint32_t tree = tree_of_[index]; tree != none)
            return emit(forest_, tree, lists_, workers_, next, emission_);
        const std::uint32_t own = next.nodes++;
        costs[own] = shapes_.hierarchy.built_costs[index];
        WideNode node = nodes()[index];
        for (int entry = 0; entry < block_size && !node.children[entry].empty(); ++entry) {
            Child& child = node.children[entry];
            child = child.is_block() ? keep_block(child, next) : keep(child.index(), costs, next);
        }
        emission_.nodes[own] = node;
        return Child::node(own);
    }

    Child keep_block(Child child, Tally& next) {
        const std::uint32_t own = next.blocks[static_cast<std::size_t>(child.kind())]++;
        with_bounded_table(child.kind(), [&]<class Shape>(const Table<Shape>& table) {
            Blocks<Shape>& blocks = emission_.blocks<Shape>();
            blocks.floats[own] = table.plain_blocks()[child.index()];
            if (table.has_doubles()) blocks.doubles[own] = table.doubles()[child.index()];
        });
        return Child::block(child.kind(), own);
    }

    const MovableShapes& shapes_;
    Workers& workers_;
    Tally kept_;
    std::array<bool, kind_count> has_doubles_{};
    std::vector<std::uint32_t> tree_of_; // by node
    ShapeLists lists_;
    std::vector<EndsOfLists> ends_; // by tree
    BinaryForest forest_;
    Emission emission_;
};

/// Returns the radius of each sphere by id.
std::vector<double> radii_of(const Table<Sphere>& table, std::size_t id_count) {
    std::vector<double> radii(id_count);
    for_each_shape(table,
                   [&](const InDouble<Sphere>& sphere, ShapeId id) { radii[id] = sphere.radius; });
    return radii;
}

} // namespace

template <class Number>
void move_spheres(std::span<const Number> coordinates, const MovableShapes& shapes,
                  Workers& workers) {
    auto& table = std::get<Table<Sphere>>(shapes.tables);
    const std::size_t pack_from = table.is_packed() ? min_packed : packed_from;
    SphereMover<Number> mover(coordinates, shapes);
    mover.move(workers);
    if (mover.count() == 0) return;
    const bool same_merged = mover.keeps_merged() && !mover.may_have_duplicates;
    table.replace_blocks(std::move(mover.blocks));
    Refit refit(shapes.hierarchy, mover.bounds);
    const std::vector<std::uint32_t> worn =
        same_merged ? refit.worn_nodes() : std::vector<std::uint32_t>{0};
    shapes.hierarchy = refit.take();
    if (!worn.empty()) {
        Rebuilder rebuilder(shapes, workers);
        if (!same_merged) {
            const std::vector<double> radii = radii_of(table, shapes.material_of.size());
            for (const MergedShape& sphere : shapes.merged)
                rebuilder.gather(mover.moved(sphere.id, radii[sphere.first]), sphere.id);
        }
        for (const std::uint32_t node : worn) {
            rebuilder.gather(node);
            rebuilder.end_tree(node);
        }
        std::vector<MergedShape> merged = rebuilder.rebuild();
        if (!same_merged) shapes.merged = std::move(merged);
    }
    pack_spheres(table, shapes.material_of.size(), pack_from, workers);
}

template void move_spheres(std::span<const float>, const MovableShapes&, Workers&);
template void move_spheres(std::span<const double>, const MovableShapes&, Workers&);

} // namespace raylane::core
