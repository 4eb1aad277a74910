#include "core/hierarchy/binary_tree.hpp"

#include "core/hierarchy/bins.hpp"
#include "core/hierarchy/packing.hpp"
#include "core/hierarchy/sweep.hpp"
#include "core/shapes/shapes.hpp"

#include <numeric>
#include <span>

namespace raylane::core {

namespace {

/// Maximum number of items that one thread builds as one task: much smaller than a scene that takes
/// long to build, and large enough that the cost of starting a task does not matter.
constexpr std::size_t max_in_a_part = std::size_t{1} << 14;

/// Drops duplicates where they are certain to be together: in a small range, or if all centres
/// coincide.
void drop_duplicates(std::span<Item> items, const Duplicates& duplicates,
                     std::vector<std::uint32_t>& room, Range& range) {
    const auto [lower, upper] = range.centers.bounds();
    const bool is_place = lower == upper;
    if (range.size() <= Sweep::max_items || is_place)
        range.last = range.first +
                     duplicates.drop_from(items.subspan(range.first, range.size()), room, is_place);
}

/// Builds parts of the tree, one task each.
class PartBuilder {
  public:
    PartBuilder(std::span<Item> items, const Duplicates& duplicates, int node_width)
        : items_(items), duplicates_(duplicates), node_width_(node_width), sweep_(node_width) {}

    EntryCosts build(const Range& range, TreePart& part) {
        nodes_.assign(1, {range.box.bounds(), 0, 0, {}, {}});
        const EntryCosts costs = grow(range, 0);
        part.nodes.assign(nodes_.begin(), nodes_.end()); // without spare capacity
        return costs;
    }

  private:
    EntryCosts grow(Range range, std::uint32_t node) {
        drop_duplicates(items_, duplicates_, room_, range);
        if (range.size() <= Sweep::max_items)
            return sweep_.build(items_.subspan(range.first, range.size()), range.first, nodes_,
                                node);
        const Halves halves = split_by_bins(items_, range, alone_);
        const auto left = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({halves.left.box.bounds(), 0, 0, {}, {}});
        nodes_.push_back({halves.right.box.bounds(), 0, 0, {}, {}});
        const EntryCosts left_costs = grow(halves.left, left);
        const EntryCosts right_costs = grow(halves.right, left + 1);
        BinaryNode& parent = nodes_[node];
        parent.first = left;
        return collapse(parent.bounds.half_area(), left_costs, right_costs, node_width_,
                        parent.shares);
    }

    std::span<Item> items_;
    const Duplicates& duplicates_;
    int node_width_;
    std::vector<BinaryNode> nodes_;
    std::vector<std::uint32_t> room_;
    Sweep sweep_;
    Workers alone_;
};

class TreeBuilder {
  public:
    TreeBuilder(std::span<Item> items, const Duplicates& duplicates, int node_width,
                Workers& workers)
        : items_(items), duplicates_(duplicates), node_width_(node_width), workers_(workers) {}

    EntryCosts build(Range range, TreePart& part) {
        if (range.size() > max_in_a_part) {
            std::vector<std::uint32_t> room;
            const std::size_t before = range.size();
            drop_duplicates(items_, duplicates_, room, range);
            if (range.size() < before) workers_.placed(before - range.size(), items_.size());
        }
        if (range.size() <= max_in_a_part) {
            const EntryCosts costs =
                PartBuilder(items_, duplicates_, node_width_).build(range, part);
            workers_.placed(range.size(), items_.size());
            return costs;
        }
        const Halves halves = split_by_bins(items_, range, workers_);
        part.left = std::make_unique<TreePart>();
        part.right = std::make_unique<TreePart>();
        EntryCosts left, right;
        workers_.both([&] { left = build(halves.left, *part.left); },
                      [&] { right = build(halves.right, *part.right); });
        BinaryNode& node = part.nodes.emplace_back(BinaryNode{range.box.bounds(), 0, 0, {}, {}});
        return collapse(node.bounds.half_area(), left, right, node_width_, node.shares);
    }

  private:
    std::span<Item> items_;
    const Duplicates& duplicates_;
    int node_width_;
    Workers& workers_;
};

/// Number of shapes in a task: enough to be worth the overhead.
constexpr std::size_t shapes_in_a_task = std::size_t{1} << 14;

template <class Shape>
Bounds bounds_of_listed(const ShapeList<Shape>& list, std::size_t i, const Duplicates& duplicates) {
    if (const Bounds* of_part = duplicates.bounds_of_part(list[i].id)) return *of_part;
    return list.has_doubles() ? bounds_of(list.exact(i)) : bounds_of(list[i].shape);
}

/// Writes the items of the shapes from `begin` to `end` - 1.
template <class Shape>
void add_items(const ShapeList<Shape>& list, std::size_t begin, std::size_t end,
               const Duplicates& duplicates, Item* to, Workers& workers) {
    const std::size_t tasks = (end - begin + shapes_in_a_task - 1) / shapes_in_a_task;
    workers.each(tasks, [&](std::size_t task) {
        const std::size_t first = begin + task * shapes_in_a_task;
        const std::size_t last = std::min(first + shapes_in_a_task, end);
        for (std::size_t i = first; i < last; ++i)
            to[i - begin] = Item(bounds_of_listed(list, i, duplicates), kind_of<Shape>,
                                 static_cast<std::uint32_t>(i));
    });
}

/// Returns the items of all trees. Writes the end of each tree's items to `ends_of_items`.
BigArray<Item> items_of(const ShapeLists& lists, std::span<const EndsOfLists> ends,
                        const Duplicates& duplicates, std::vector<std::size_t>& ends_of_items,
                        Workers& workers) {
    BigArray<Item> items(std::accumulate(ends.back().begin(), ends.back().end(), std::size_t{0}));
    std::size_t next = 0;
    EndsOfLists begin{};
    for (const EndsOfLists& end : ends) {
        for_each_bounded_table(lists, [&]<class Shape>(const ShapeList<Shape>& list) {
            constexpr auto kind = static_cast<std::size_t>(kind_of<Shape>);
            add_items(list, begin[kind], end[kind], duplicates, items.data() + next, workers);
            next += end[kind] - begin[kind];
        });
        begin = end;
        ends_of_items.push_back(next);
    }
    return items;
}

} // namespace

Positions::Positions(BigArray<Item> items) : memory_(std::move(items)) {
    auto* to = reinterpret_cast<std::byte*>(memory_.data()); // never ahead of the read position
    for (const Item& item : memory_) {
        const std::uint32_t position = item.position();
        std::memcpy(to, &position, sizeof position);
        to += sizeof position;
    }
    memory_.forget_rest(memory_.size() * sizeof(std::uint32_t));
}

BinaryForest build_binary_forest(const ShapeLists& lists, std::span<const EndsOfLists> ends,
                                 const Duplicates& duplicates, Workers& workers) {
    std::vector<std::size_t> ends_of_items;
    BigArray<Item> items = items_of(lists, ends, duplicates, ends_of_items, workers);
    BinaryForest forest;
    // Narrow nodes take more memory, which counts where spheres are packed.
    forest.node_width = items.size() < packed_from ? workers.node_width() : block_size;
    forest.trees.resize(ends.size());
    const std::span<Item> all_items(items.data(), items.size());
    workers.each(ends.size(), [&](std::size_t i) {
        const std::size_t first = i == 0 ? 0 : ends_of_items[i - 1];
        const Range range = range_of(all_items, first, ends_of_items[i], workers);
        TreeBuilder(all_items, duplicates, forest.node_width, workers)
            .build(range, forest.trees[i]);
    });
    forest.positions = Positions(std::move(items));
    return forest;
}

} // namespace raylane::core
