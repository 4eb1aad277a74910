#include "core/hierarchy/binary_tree.hpp"

#include "core/hierarchy/bins.hpp"
#include "core/hierarchy/sweep.hpp"

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
    PartBuilder(std::span<Item> items, const Duplicates& duplicates)
        : items_(items), duplicates_(duplicates) {}

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
        return collapse(parent.bounds.half_area(), left_costs, right_costs, parent.shares);
    }

    std::span<Item> items_;
    const Duplicates& duplicates_;
    std::vector<BinaryNode> nodes_;
    std::vector<std::uint32_t> room_;
    Sweep sweep_;
    Workers alone_;
};

class TreeBuilder {
  public:
    TreeBuilder(std::span<Item> items, const Duplicates& duplicates, Workers& workers)
        : items_(items), duplicates_(duplicates), workers_(workers) {}

    EntryCosts build(Range range, TreePart& part) {
        if (range.size() > max_in_a_part) {
            std::vector<std::uint32_t> room;
            const std::size_t before = range.size();
            drop_duplicates(items_, duplicates_, room, range);
            if (range.size() < before) workers_.placed(before - range.size(), items_.size());
        }
        if (range.size() <= max_in_a_part) {
            const EntryCosts costs = PartBuilder(items_, duplicates_).build(range, part);
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
        return collapse(node.bounds.half_area(), left, right, node.shares);
    }

  private:
    std::span<Item> items_;
    const Duplicates& duplicates_;
    Workers& workers_;
};

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

BinaryTree build_binary_tree(BigArray<Item> items, const Duplicates& duplicates, Workers& workers) {
    BinaryTree tree;
    const std::span<Item> all(items.data(), items.size());
    TreeBuilder(all, duplicates, workers).build(whole_range(all, workers), tree.root);
    tree.positions = Positions(std::move(items));
    return tree;
}

} // namespace raylane::core
