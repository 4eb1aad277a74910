#include "core/hierarchy/hierarchy.hpp"

#include "core/hierarchy/binary_tree.hpp"
#include "core/shapes/shapes.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace raylane::core {

WideNode::WideNode() {
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < block_size; ++i) {
            lower[axis][i] = std::numeric_limits<float>::infinity();
            upper[axis][i] = -std::numeric_limits<float>::infinity();
        }
}

Bounds WideNode::bounds(int i) const {
    return {{lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}};
}

void WideNode::set(int i, const Bounds& bounds, Child child) {
    for (int axis = 0; axis < 3; ++axis) {
        lower[axis][i] = bounds.lower[axis];
        upper[axis][i] = bounds.upper[axis];
    }
    children[i] = child;
}

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

Shares own_shares_of(const Cursor& at) {
    const int left = at.node().shares.left_of_own();
    return {left, block_size - left};
}

/// Returns the size of a subtree that may fill `entries` of a wide node. At a fork, also stores the
/// left child's size.
Tally count(const Cursor& at, int entries, Workers& workers);

Tally count_children(const Cursor& at, const Shares& shares, Workers& workers) {
    Tally left, right;
    if (at.forks()) {
        workers.both([&] { left = count(at.left(), shares.left, workers); },
                     [&] { right = count(at.right(), shares.right, workers); });
        at.left_tally() = left;
    } else {
        left = count(at.left(), shares.left, workers);
        right = count(at.right(), shares.right, workers);
    }
    left += right;
    return left;
}

Tally count(const Cursor& at, int entries, Workers& workers) {
    const Shares shares = shares_of(at, entries);
    if (shares.left > 0) return count_children(at, shares, workers);
    Tally tally;
    if (at.is_leaf()) {
        tally.blocks[static_cast<std::size_t>(at.node().kind)] = 1;
    } else {
        tally = count_children(at, own_shares_of(at), workers);
        ++tally.nodes;
    }
    tally.entries = 1;
    return tally;
}

/// Returns bounds wider by an ulp, so that no shape touches them.
Bounds padded(Bounds bounds) {
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lower[axis] = std::nextafter(bounds.lower[axis], -std::numeric_limits<float>::max());
        bounds.upper[axis] = std::nextafter(bounds.upper[axis], std::numeric_limits<float>::max());
    }
    return bounds;
}

template <class AnyTables>
struct BlocksOf;
template <class... Shapes>
struct BlocksOf<std::tuple<Table<Shapes>...>> {
    using type = std::tuple<Blocks<Shapes>...>;
};

class Emitter {
  public:
    Emitter(const BinaryTree& tree, const ShapeLists& lists, Workers& workers)
        : positions_(tree.positions), lists_(lists), workers_(workers) {}

    void emit(const Cursor& root) {
        const Tally whole = count(root, 1, workers_);
        // A root that is a leaf still needs a wide node.
        nodes_ = BigArray<WideNode>(whole.nodes + (root.is_leaf() ? 1 : 0));
        for_each_table(lists_, [&]<class Shape>(const ShapeList<Shape>& list) {
            blocks_of<Shape>() = Blocks<Shape>(
                whole.blocks[static_cast<std::size_t>(kind_of<Shape>)], list.has_doubles());
        });
        Tally next;
        if (root.is_leaf()) {
            next.nodes = 1;
            nodes_[0] = WideNode();
            emit(root, 1, 0, next);
        } else {
            emit_node(root, next);
        }
    }

    BigArray<WideNode> take_nodes() { return std::move(nodes_); }

    template <class Shape>
    Table<Shape> take_table() {
        return {std::move(blocks_of<Shape>()), std::get<ShapeList<Shape>>(lists_).size()};
    }

  private:
    template <class Shape>
    Blocks<Shape>& blocks_of() {
        return std::get<Blocks<Shape>>(blocks_);
    }

    /// `next`, here and below, holds the index of the next wide node and of the next block of each
    /// kind. Its member `entries` counts the used entries of the node `wide`.
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
        const Child child = at.is_leaf() ? emit_block(at.node(), next) : emit_node(at, next);
        nodes_[wide].set(entry, padded(at.node().bounds), child);
    }

    Child emit_node(const Cursor& at, Tally& next) {
        const std::uint32_t own = next.nodes++;
        nodes_[own] = WideNode();
        const int entries = std::exchange(next.entries, 0);
        emit_children(at, own_shares_of(at), own, next);
        next.entries = entries;
        return Child::node(own);
    }

    Child emit_block(const BinaryNode& leaf, Tally& next) {
        const std::uint32_t index = next.blocks[static_cast<std::size_t>(leaf.kind)]++;
        with_shape_type(leaf.kind, [&]<class Shape>(std::type_identity<Shape>) {
            const auto& list = std::get<ShapeList<Shape>>(lists_);
            blocks_of<Shape>().fill(index, list, leaf.count, [&](int lane) {
                const std::size_t at = leaf.first + static_cast<std::size_t>(lane);
                fetch_ahead(list, at);
                return positions_[at];
            });
        });
        return Child::block(leaf.kind, index);
    }

    /// Prefetches a shape of a later leaf. Leaves are emitted in the order of their items, but the
    /// shapes of the items are scattered over the list.
    template <class Shape>
    void fetch_ahead(const ShapeList<Shape>& list, std::size_t at) const {
        constexpr auto ahead = std::size_t{4} * block_size;
        if (at + ahead >= positions_.size()) return;
        const std::uint32_t position = positions_[at + ahead];
        if (position < list.size()) list.prefetch(position); // it may belong to another kind
    }

    const Positions& positions_;
    const ShapeLists& lists_;
    Workers& workers_;
    BigArray<WideNode> nodes_;
    BlocksOf<Tables>::type blocks_;
};

/// Turns a binary tree into wide nodes with padded bounds, following its nodes' decisions, and its
/// leaves into blocks of the lists' shapes. Numbers both by their position in the tree.
void emit(BinaryTree& tree, const ShapeLists& lists, Workers& workers, Hierarchy& hierarchy,
          Tables& tables) {
    const Cursor root(tree.root);
    Emitter emitter(tree, lists, workers);
    emitter.emit(root);
    hierarchy.nodes = emitter.take_nodes();
    hierarchy.bounds = padded(root.node().bounds);
    for_each_table(tables, [&]<class Shape>(Table<Shape>& table) {
        if constexpr (is_bounded<Shape>) table = emitter.take_table<Shape>();
    });
}

/// Number of shapes in a task: enough to be worth the overhead.
constexpr std::size_t shapes_in_a_task = std::size_t{1} << 14;

template <class Shape>
Bounds bounds_of_listed(const ShapeList<Shape>& list, std::size_t i, const Duplicates& duplicates) {
    if (const Bounds* of_part = duplicates.bounds_of_part(list[i].id)) return *of_part;
    return list.has_doubles() ? bounds_of(list.exact(i)) : bounds_of(list[i].shape);
}

template <class Shape>
void add_items(const ShapeList<Shape>& list, const Duplicates& duplicates, Item* to,
               Workers& workers) {
    workers.each((list.size() + shapes_in_a_task - 1) / shapes_in_a_task, [&](std::size_t task) {
        const std::size_t first = task * shapes_in_a_task;
        const std::size_t last = std::min(first + shapes_in_a_task, list.size());
        for (std::size_t i = first; i < last; ++i)
            to[i] = Item(bounds_of_listed(list, i, duplicates), kind_of<Shape>,
                         static_cast<std::uint32_t>(i));
    });
}

BigArray<Item> bounded_items(const ShapeLists& lists, const Duplicates& duplicates,
                             Workers& workers) {
    std::size_t count = 0;
    for_each_bounded_table(lists, [&](const auto& list) { count += list.size(); });
    BigArray<Item> items(count);
    Item* next = items.data();
    for_each_bounded_table(lists, [&](const auto& list) {
        add_items(list, duplicates, next, workers);
        next += list.size();
    });
    return items;
}

} // namespace

Hierarchy build_hierarchy(const ShapeLists& lists, const Duplicates& duplicates, Workers& workers,
                          Tables& tables) {
    for_each_unbounded_table(lists, [&]<class Shape>(const ShapeList<Shape>& list) {
        std::get<Table<Shape>>(tables) =
            Table<Shape>(duplicates.without_duplicates(list), list.size());
    });
    Hierarchy hierarchy;
    BigArray<Item> items = bounded_items(lists, duplicates, workers);
    if (items.empty()) return hierarchy;
    BinaryTree tree = build_binary_tree(std::move(items), duplicates, workers);
    emit(tree, lists, workers, hierarchy, tables);
    return hierarchy;
}

} // namespace raylane::core
