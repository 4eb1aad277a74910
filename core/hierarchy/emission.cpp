#include "core/hierarchy/emission.hpp"

#include "core/shapes/shapes.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace raylane::core {

namespace {

/// A reference to a node of the binary tree, in any part.
class Cursor {
  public:
    explicit Cursor(TreePart& part, std::uint32_t index = 0) : part_(&part), index_(index) {}

    const BinaryNode& node() const { return part_->nodes[index_]; }
    bool is_leaf() const { return node().is_leaf(); }
    /// Returns true if the children are separate parts.
    bool forks() const { return part_->left != nullptr; }
    Cursor left() const { return forks() ? Cursor(*part_->left) : Cursor(*part_, node().first); }
    Cursor right() const {
        return forks() ? Cursor(*part_->right) : Cursor(*part_, node().first + 1);
    }
    /// Returns the size of the left child, where the tree forks. Valid after count().
    Tally& left_tally() const { return part_->left_tally; }

  private:
    TreePart* part_;
    std::uint32_t index_;
};

/// Entries for each child.
struct Shares {
    int left, right;
};

/// Returns the entries of each child if the subtree may fill `entries` entries of a wide node. Both
/// numbers are 0 if the subtree takes one entry itself.
Shares shares_of(const Cursor& at, int entries) {
    if (at.is_leaf()) return {0, 0};
    for (; entries > 1; --entries)
        if (const int left = at.node().shares.left_of(entries); left != 0)
            return {left, entries - left};
    return {0, 0};
}

Shares own_shares_of(const Cursor& at, int node_width) {
    const int left = at.node().shares.left_of_own();
    return {left, node_width - left};
}

/// Returns the size of a subtree that may fill `entries` of a wide node. At a fork, also stores the
/// left child's size.
Tally count(const Cursor& at, int entries, int node_width, Workers& workers);

Tally count_children(const Cursor& at, const Shares& shares, int node_width, Workers& workers) {
    Tally left, right;
    if (at.forks()) {
        workers.both([&] { left = count(at.left(), shares.left, node_width, workers); },
                     [&] { right = count(at.right(), shares.right, node_width, workers); });
        at.left_tally() = left;
    } else {
        left = count(at.left(), shares.left, node_width, workers);
        right = count(at.right(), shares.right, node_width, workers);
    }
    left += right;
    return left;
}

Tally count(const Cursor& at, int entries, int node_width, Workers& workers) {
    const Shares shares = shares_of(at, entries);
    if (shares.left > 0) return count_children(at, shares, node_width, workers);
    Tally tally;
    if (at.is_leaf()) {
        tally.blocks[static_cast<std::size_t>(at.node().kind)] = 1;
    } else {
        tally = count_children(at, own_shares_of(at, node_width), node_width, workers);
        ++tally.nodes;
    }
    tally.entries = 1;
    return tally;
}

class Emitter {
  public:
    Emitter(const BinaryForest& forest, const ShapeLists& lists, Workers& workers, Emission& to)
        : forest_(forest), lists_(lists), workers_(workers), to_(to) {}

    Child emit(const Cursor& root, Tally& next) {
        return root.is_leaf() ? emit_block(root.node(), next) : emit_node(root, next);
    }

  private:
    /// The member `entries` of `next`, here and below, counts the used entries of the node `wide`.
    void emit_children(const Cursor& at, const Shares& shares, std::uint32_t wide, Tally& next) {
        if (!at.forks()) {
            emit(at.left(), shares.left, wide, next);
            emit(at.right(), shares.right, wide, next);
            return;
        }
        Tally left = next;
        next += at.left_tally();
        workers_.both([&] { emit(at.left(), shares.left, wide, left); },
                      [&] { emit(at.right(), shares.right, wide, next); });
    }

    void emit(const Cursor& at, int entries, std::uint32_t wide, Tally& next) {
        const Shares shares = shares_of(at, entries);
        if (shares.left > 0) return emit_children(at, shares, wide, next);
        const int entry = next.entries++;
        const Child child = emit(at, next);
        to_.nodes[wide].set(entry, padded(at.node().bounds), child);
    }

    Child emit_node(const Cursor& at, Tally& next) {
        const std::uint32_t own = next.nodes++;
        to_.nodes[own] = WideNode();
        const int entries = std::exchange(next.entries, 0);
        emit_children(at, own_shares_of(at, forest_.node_width), own, next);
        next.entries = entries;
        return Child::node(own);
    }

    Child emit_block(const BinaryNode& leaf, Tally& next) {
        const std::uint32_t index = next.blocks[static_cast<std::size_t>(leaf.kind)]++;
        with_shape_type(leaf.kind, [&]<class Shape>(std::type_identity<Shape>) {
            const auto& list = std::get<ShapeList<Shape>>(lists_);
            to_.blocks<Shape>().fill(index, list, leaf.count, [&](int lane) {
                const std::size_t at = leaf.first + static_cast<std::size_t>(lane);
                fetch_ahead(list, at);
                return forest_.positions[at];
            });
        });
        return Child::block(leaf.kind, index);
    }

    /// Prefetches a shape of a later leaf. Leaves are emitted in the order of their items, but the
    /// shapes of the items are scattered over the list.
    template <class Shape>
    void fetch_ahead(const ShapeList<Shape>& list, std::size_t at) const {
        constexpr auto ahead = std::size_t{4} * block_size;
        if (at + ahead >= forest_.positions.size()) return;
        const std::uint32_t position = forest_.positions[at + ahead];
        if (position < list.size()) list.prefetch(position); // it may belong to another kind
    }

    const BinaryForest& forest_;
    const ShapeLists& lists_;
    Workers& workers_;
    Emission& to_;
};

} // namespace

Bounds padded(Bounds bounds) {
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lower[axis] = std::nextafter(bounds.lower[axis], -std::numeric_limits<float>::max());
        bounds.upper[axis] = std::nextafter(bounds.upper[axis], std::numeric_limits<float>::max());
    }
    return bounds;
}

Emission::Emission(const Tally& size, const std::array<bool, kind_count>& has_doubles)
    : nodes(size.nodes) {
    for_each_table(blocks_, [&]<class Shape>(Blocks<Shape>& blocks) {
        constexpr auto kind = static_cast<std::size_t>(kind_of<Shape>);
        blocks = Blocks<Shape>(size.blocks[kind], has_doubles[kind]);
    });
}

Tally size_of(TreePart& tree, int node_width, Workers& workers) {
    return count(Cursor(tree), 1, node_width, workers);
}

Child emit(BinaryForest& forest, std::size_t tree, const ShapeLists& lists, Workers& workers,
           Tally& next, Emission& to) {
    return Emitter(forest, lists, workers, to).emit(Cursor(forest.trees[tree]), next);
}

Emission emit_all(BinaryForest& forest, const ShapeLists& lists,
                  const std::array<bool, kind_count>& has_doubles, Workers& workers) {
    const BinaryNode& root = forest.trees.front().nodes.front();
    Tally size = size_of(forest.trees.front(), forest.node_width, workers), next;
    // A root that is a leaf still needs a wide node.
    if (root.is_leaf()) size.nodes = next.nodes = 1;
    Emission emission(size, has_doubles);
    const Child child = emit(forest, 0, lists, workers, next, emission);
    if (root.is_leaf()) {
        emission.nodes[0] = WideNode();
        emission.nodes[0].set(0, padded(root.bounds), child);
    }
    return emission;
}

} // namespace raylane::core
