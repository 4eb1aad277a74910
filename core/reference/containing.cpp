#include "core/reference/containing.hpp"

#include "core/reference/enclosing.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

void PointSearcher::add_containing(const Vec3d& point, std::vector<Containing>& found) {
    const BigArray<WideNode>& nodes = scene_.hierarchy().nodes;
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(point[axis])) return;
    if (nodes.empty()) return;
    Bounds around;
    include_point(around, point);
    const std::size_t first = found.size();
    pending_.assign(1, 0);
    while (!pending_.empty()) {
        const WideNode& node = nodes[pending_.back()];
        pending_.pop_back();
        unsigned meets[block_size];
        std::fill_n(meets, block_size, 1U);
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < block_size; ++i)
                meets[i] &= static_cast<unsigned>(node.lower[axis][i] <= around.upper[axis]) &
                            static_cast<unsigned>(around.lower[axis] <= node.upper[axis][i]);
        for (int i = 0; i < block_size; ++i) {
            if (meets[i] == 0) continue;
            const Child child = node.children[i];
            if (child.is_block())
                add_of_block(child, point, found);
            else
                pending_.push_back(child.index());
        }
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
              [](const Containing& a, const Containing& b) { return a.shape < b.shape; });
}

void PointSearcher::add_of_block(const Child& block, const Vec3d& point,
                                 std::vector<Containing>& found) {
    with_table(scene_.shapes(), block.kind(), [&]<class Shape>(const Table<Shape>& table) {
        if constexpr (is_solid<Shape>) {
            for_each_in_block(table, block.index(), [&](Place place, ShapeId id) {
                const Side side = side_of(table.get(place), point);
                if (side != Side::outside) found.push_back({id, side == Side::surface});
            });
        }
    });
}

} // namespace raylane::core
