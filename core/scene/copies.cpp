#include "core/scene/copies.hpp"

#include "core/hierarchy/emission.hpp"
#include "core/scene/scene.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace raylane::core {

namespace {

/// Returns the half of the diagonal of the prototype's bounds, and their centre.
void enclose(const Scene& prototype, Vec3d& center, double& radius) {
    const Bounds& bounds = prototype.hierarchy().bounds;
    const Vec3d lower = convert<double>(bounds.lower), upper = convert<double>(bounds.upper);
    center = 0.5 * (lower + upper);
    radius = 0.5 * length(upper - lower) * (1.0 + 0x1p-40);
}

} // namespace

Copies::Copies(std::vector<Group> groups, Tables& tables) {
    take(std::move(groups));
    reserve_blocks(tables);
    build_tree();
}

void Copies::take(std::vector<Group> groups) {
    for (Group& group : groups) {
        Set set{};
        set.prototype = std::move(group.prototype);
        set.first_copy = copy_count();
        if (group.placements.size() > max_copies - copy_count())
            throw InvalidValue("", "must have at most " + std::to_string(max_copies) + " copies");
        set.copy_count = static_cast<std::uint32_t>(group.placements.size());
        set.first_id = group.first_id;
        set.shape_count = static_cast<std::uint32_t>(set.prototype->shape_count());
        enclose(*set.prototype, set.center, set.radius);
        if (placements_.empty())
            placements_ = std::move(group.placements);
        else
            placements_.insert(placements_.end(), group.placements.begin(), group.placements.end());
        sets_.push_back(std::move(set));
    }
}

/// Reserves the blocks of all copies behind those of the tables.
void Copies::reserve_blocks(Tables& tables) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / block_size;
    std::size_t slots = 0;
    for_each_table(tables, [&]<class Shape>(Table<Shape>& table) {
        constexpr auto kind = static_cast<std::size_t>(kind_of<Shape>);
        const std::size_t own = table.block_count();
        std::size_t count = own;
        for (Set& set : sets_) {
            set.first_block[kind] = static_cast<std::uint32_t>(count);
            set.block_count[kind] = static_cast<std::uint32_t>(
                std::get<Table<Shape>>(set.prototype->shapes()).block_count());
            count += std::size_t{set.copy_count} * set.block_count[kind];
        }
        slots += count;
        if (slots >= most || count > Child::max_index)
            throw InvalidValue("", "must be of at most 134217727 blocks of shapes");
        if (count == own) return;
        auto& blocks = std::get<CopiedBlocks<Shape>>(of_kind_);
        blocks.first = static_cast<std::uint32_t>(own);
        blocks.shapes.floats = BigArray<Block<Shape>>::zeros(count);
        blocks.shapes.doubles = BigArray<DoubleBlock<Shape>>::zeros(count);
        blocks.made = BigArray<std::uint8_t>::zeros(count - own);
        for (std::uint32_t block = 0; block < own; ++block) {
            blocks.shapes.floats[block] = table.plain_blocks()[block];
            DoubleBlock<Shape> exact;
            for_each_in_block(table, block, [&](Place place, ShapeId) {
                exact.set(place.lane, table.get(place));
            });
            blocks.shapes.doubles[block] = exact;
        }
        table.extend_blocks(blocks.shapes, own);
    });
}

/// Returns bounds within the box around the transformed box of the prototype, and within that of
/// the sphere around it. Errors of the map are far below 2^-40 of the numbers.
Bounds Copies::bounds_of(const Copy& copy) const {
    const Placement& placement = placements_[copy.set.first_copy + copy.number];
    const std::array<Vec3d, 3> rows = rows_of(placement);
    const Bounds& box = copy.set.prototype->hierarchy().bounds;
    const Vec3d half = 0.5 * (convert<double>(box.upper) - convert<double>(box.lower));
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d& row = rows[static_cast<std::size_t>(axis)];
        const double center = dot(row, copy.set.center) + placement.translate[axis];
        const double extent = std::min(dot(absolute(row), half), placement.scale * copy.set.radius);
        const double off = 0x1p-36 * (dot(absolute(row), absolute(copy.set.center)) +
                                      std::abs(placement.translate[axis]) + extent);
        bounds.lower[axis] = static_cast<float>(center - extent - off);
        bounds.upper[axis] = static_cast<float>(center + extent + off);
    }
    return padded(bounds);
}

namespace {

/// Builds a hierarchy. Divides the items of a node into parts of 4^k items, and a last part with
/// the rest, by halving along the longest axis of their centres. So each part of 4^k items becomes
/// a subtree of full nodes, and n copies take about n / 3 nodes.
class TreeBuilder {
  public:
    struct Item {
        Bounds bounds;
        std::uint32_t copy;
        float center(int axis) const { return bounds.lower[axis] + bounds.upper[axis]; }
    };

    explicit TreeBuilder(std::vector<Item> items) : items_(std::move(items)) {}

    BigArray<Copies::Node> build() {
        nodes_.reserve(items_.size() / 2 + 1);
        add_node(items_);
        BigArray<Copies::Node> nodes(nodes_.size());
        std::copy(nodes_.begin(), nodes_.end(), nodes.begin());
        return nodes;
    }

  private:
    using Items = std::span<Item>;

    /// Moves the `count` items with the smallest centres to the front.
    static void divide(Items items, std::size_t count) {
        Bounds centers;
        for (const Item& item : items)
            for (int axis = 0; axis < 3; ++axis) {
                centers.lower[axis] = std::min(centers.lower[axis], item.center(axis));
                centers.upper[axis] = std::max(centers.upper[axis], item.center(axis));
            }
        int longest = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (centers.upper[axis] - centers.lower[axis] >
                centers.upper[longest] - centers.lower[longest])
                longest = axis;
        std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(count),
                         items.end(), [longest](const Item& a, const Item& b) {
                             return a.center(longest) != b.center(longest)
                                        ? a.center(longest) < b.center(longest)
                                        : a.copy < b.copy;
                         });
    }

    /// Divides items into parts of `size` items, and a last part with the rest.
    static void divide(Items items, std::size_t size, std::vector<Items>& parts) {
        const std::size_t count = (items.size() + size - 1) / size;
        if (count == 1) return parts.push_back(items);
        const std::size_t first = (count + 1) / 2 * size;
        divide(items, first);
        divide(items.first(first), size, parts);
        divide(items.subspan(first), size, parts);
    }

    std::uint32_t add_node(Items items) {
        std::size_t size = 1; // of a part
        while (4 * size < items.size())
            size *= 4;
        std::vector<Items> parts;
        divide(items, size, parts);
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        for (int child = 0; child < 4; ++child) {
            Bounds bounds;
            std::uint32_t what = Copies::Node::none;
            if (static_cast<std::size_t>(child) < parts.size()) {
                for (const Item& item : parts[child])
                    bounds.include(item.bounds);
                what = parts[child].size() == 1 ? parts[child].front().copy | Copies::Node::copy_bit
                                                : add_node(parts[child]);
            }
            Copies::Node& node = nodes_[number];
            for (int axis = 0; axis < 3; ++axis) {
                node.lower[axis][child] = bounds.lower[axis];
                node.upper[axis][child] = bounds.upper[axis];
            }
            node.children[child] = what;
        }
        return number;
    }

    std::vector<Item> items_;
    std::vector<Copies::Node> nodes_;
};

} // namespace

void Copies::build_tree() {
    std::vector<TreeBuilder::Item> items;
    items.reserve(placements_.size());
    for (const Set& set : sets_)
        for (std::uint32_t k = 0; k < set.copy_count; ++k) {
            items.push_back({bounds_of({set, k}), set.first_copy + k});
            bounds_.include(items.back().bounds);
        }
    nodes_ = TreeBuilder(std::move(items)).build();
}

Copies::Copy Copies::copy_at(std::uint32_t copy) const {
    const auto after = std::upper_bound(
        sets_.begin(), sets_.end(), copy,
        [](std::uint32_t number, const Set& set) { return number < set.first_copy; });
    const Set& set = *(after - 1);
    return {set, copy - set.first_copy};
}

Copies::Copy Copies::copy_with(ShapeId id) const {
    const auto after =
        std::upper_bound(sets_.begin(), sets_.end(), id,
                         [](ShapeId number, const Set& set) { return number < set.first_id; });
    const Set& set = *(after - 1);
    return {set, (id - set.first_id) / set.shape_count};
}

template <class Shape>
void Copies::make_in(const CopiedBlocks<Shape>& blocks, std::size_t i) const {
    using Blocks = CopiedBlocks<Shape>;
    while (!blocks.is_made(i)) { // or another thread makes it, in some microseconds
        std::uint8_t expected = Blocks::unmade;
        if (!__atomic_compare_exchange_n(&blocks.made[i], &expected, Blocks::in_work, false,
                                         __ATOMIC_ACQUIRE, __ATOMIC_ACQUIRE))
            continue;
        try {
            fill(blocks, i);
        } catch (...) {
            __atomic_store_n(&blocks.made[i], Blocks::unmade, __ATOMIC_RELEASE);
            throw;
        }
        made_bytes_ += sizeof(Block<Shape>) + sizeof(DoubleBlock<Shape>);
        __atomic_store_n(&blocks.made[i], Blocks::done, __ATOMIC_RELEASE);
    }
}

template <class Shape>
void Copies::fill(const CopiedBlocks<Shape>& blocks, std::size_t i) const {
    if constexpr (requires(const Placer& placer, const InDouble<Shape>& shape) { placer(shape); }) {
        constexpr auto kind = static_cast<std::size_t>(kind_of<Shape>);
        const std::size_t index = blocks.first + i;
        const auto after = std::upper_bound(
            sets_.begin(), sets_.end(), index,
            [](std::size_t block, const Set& set) { return block < set.first_block[kind]; });
        const Set& set = *(after - 1);
        const auto offset = static_cast<std::uint32_t>(index - set.first_block[kind]);
        const Copy copy{set, offset / set.block_count[kind]};
        const Placer placer(placements_[set.first_copy + copy.number]);
        const ShapeId first = first_id_of(copy);
        const auto& table = std::get<Table<Shape>>(set.prototype->shapes());
        Block<Shape> floats;
        DoubleBlock<Shape> doubles;
        for_each_in_block(table, offset % set.block_count[kind], [&](Place place, ShapeId id) {
            const InDouble<Shape> shape = placer(table.get(place));
            floats.set(place.lane, to_floats(shape), first + id);
            doubles.set(place.lane, shape);
        });
        const_cast<Block<Shape>&>(blocks.shapes.floats[index]) = floats;
        const_cast<DoubleBlock<Shape>&>(blocks.shapes.doubles[index]) = doubles;
    }
}

#define RAYLANE_INSTANTIATE(Shape, name, text)                                                     \
    template void Copies::make_in(const CopiedBlocks<Shape>&, std::size_t) const;
RAYLANE_SHAPES(RAYLANE_INSTANTIATE)
#undef RAYLANE_INSTANTIATE

std::size_t Copies::bytes() const {
    std::size_t bytes = placements_.capacity() * sizeof(Placement) + nodes_.bytes() + made_bytes_;
    for (const Set& set : sets_)
        bytes += set.prototype->bytes();
    return bytes;
}

} // namespace raylane::core
