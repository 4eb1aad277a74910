#include "core/hierarchy/hierarchy.hpp"

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/emission.hpp"
#include "core/shapes/shapes.hpp"

#include <limits>

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
