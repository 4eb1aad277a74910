#include "core/hierarchy/hierarchy.hpp"

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/emission.hpp"

#include <array>
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

Bounds WideNode::bounds() const {
    Bounds scene_bounds;
    for (int entry = 0; entry < block_size && !children[entry].empty(); ++entry)
        scene_bounds.include(bounds(entry));
    return scene_bounds;
}

void WideNode::set(int i, const Bounds& bounds, Child child) {
    for (int axis = 0; axis < 3; ++axis) {
        lower[axis][i] = bounds.lower[axis];
        upper[axis][i] = bounds.upper[axis];
    }
    children[i] = child;
}

Hierarchy hierarchy_of(BigArray<WideNode> nodes) {
    Hierarchy hierarchy;
    if (!nodes.empty()) hierarchy.bounds = nodes.front().bounds();
    hierarchy.nodes = std::move(nodes);
    return hierarchy;
}

Hierarchy build_hierarchy(const ShapeLists& lists, const Duplicates& duplicates, Workers& workers,
                          Tables& tables) {
    EndsOfLists ends{};
    std::array<bool, kind_count> has_doubles{};
    bool is_empty = true;
    for_each_table(lists, [&]<class Shape>(const ShapeList<Shape>& list) {
        constexpr auto kind = static_cast<std::size_t>(kind_of<Shape>);
        if constexpr (!is_bounded<Shape>) {
            std::get<Table<Shape>>(tables) =
                Table<Shape>(duplicates.without_duplicates(list), list.size());
            return;
        }
        ends[kind] = list.size();
        has_doubles[kind] = list.has_doubles();
        is_empty = is_empty && list.size() == 0;
    });
    if (is_empty) return {};
    BinaryForest forest = build_binary_forest(lists, {&ends, 1}, duplicates, workers);
    Emission emission = emit_all(forest, lists, has_doubles, workers);
    for_each_table(tables, [&]<class Shape>(Table<Shape>& table) {
        if constexpr (is_bounded<Shape>)
            table = Table<Shape>(std::move(emission.blocks<Shape>()),
                                 std::get<ShapeList<Shape>>(lists).size());
    });
    return hierarchy_of(std::move(emission.nodes));
}

} // namespace raylane::core
