#include "core/binary_tree.hpp"

#include "core/bins.hpp"
#include "core/sweep.hpp"

#include <span>

namespace raylane::core {

namespace {

/// Up to so many items are built by one thread: much less than there are of them in a scene that
/// takes long, much more than handing them over costs.
constexpr std::size_t most_in_a_part = std::size_t{1} << 14;

/// Grows parts of the tree that are one task each.
class PartBuilder {
  public:
    PartBuilder(std::span<Item> items, std::span<std::uint32_t> positions)
        : items_(items), positions_(positions) {}

    SlotCosts build(const Range& range, TreePart& part) {
        nodes_.assign(1, {range.box.bounds(), 0, 0, {}, {}});
        const SlotCosts costs = grow(range, 0);
        part.nodes.assign(nodes_.begin(), nodes_.end()); // exactly as many
        return costs;
    }

  private:
    SlotCosts grow(const Range& range, std::uint32_t node) {
        if (range.size() <= Sweep::most_items)
            return sweep_.build(items_.subspan(range.first, range.size()), range.first,
                                positions_.subspan(range.first, range.size()), nodes_, node);
        const Halves halves = split_by_bins(items_, range, alone_);
        const auto left = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({halves.left.box.bounds(), 0, 0, {}, {}});
        nodes_.push_back({halves.right.box.bounds(), 0, 0, {}, {}});
        const SlotCosts left_costs = grow(halves.left, left);
        const SlotCosts right_costs = grow(halves.right, left + 1);
        BinaryNode& parent = nodes_[node];
        parent.first = left;
        return collapse(parent.bounds.half_area(), left_costs, right_costs, parent.shares);
    }

    std::span<Item> items_;
    std::span<std::uint32_t> positions_;
    std::vector<BinaryNode> nodes_;
    Sweep sweep_;
    Workers alone_;
};

SlotCosts build_part(std::span<Item> items, std::span<std::uint32_t> positions, const Range& range,
                     TreePart& part, Workers& workers) {
    if (range.size() <= most_in_a_part) {
        const SlotCosts costs = PartBuilder(items, positions).build(range, part);
        workers.placed(range.size(), items.size());
        return costs;
    }
    const Halves halves = split_by_bins(items, range, workers);
    part.left = std::make_unique<TreePart>();
    part.right = std::make_unique<TreePart>();
    SlotCosts left, right;
    workers.both([&] { left = build_part(items, positions, halves.left, *part.left, workers); },
                 [&] { right = build_part(items, positions, halves.right, *part.right, workers); });
    BinaryNode& node = part.nodes.emplace_back(BinaryNode{range.box.bounds(), 0, 0, {}, {}});
    return collapse(node.bounds.half_area(), left, right, node.shares);
}

} // namespace

BinaryTree build_binary_tree(BigArray<Item> items, Workers& workers) {
    BinaryTree tree;
    tree.positions = BigArray<std::uint32_t>(items.size());
    const std::span<Item> all(items.data(), items.size());
    build_part(all, {tree.positions.data(), tree.positions.size()}, whole_range(all, workers),
               tree.root, workers);
    return tree;
}

} // namespace raylane::core
