#include "core/scene/surface.hpp"

#include "core/shapes/solve.hpp"

namespace raylane::core {

namespace {

/// A point is on a surface if a ray that starts there crosses it at t = 0. No plane contains all
/// three directions, so one of the rays crosses.
template <class Shape>
bool is_on(const Shape& shape, const Vec3f& point) {
    static constexpr double directions[3][3] = {{3, 4, 12}, {12, 3, -4}, {-4, 12, 3}};
    for (const auto& d : directions) {
        std::uint64_t widened = 0;
        const Ray<double> ray{convert<double>(point), {d[0], d[1], d[2]}};
        for (const Crossing<double>& crossing : solve(shape, ray, Start{}, widened))
            if (crossing.t == 0.0) return true;
    }
    return false;
}

template <class Shape>
ShapeId lowest_in_block(const Table<Shape>& table, std::uint32_t index, const Vec3f& point) {
    ShapeId lowest = no_shape;
    for_each_in_block(table, index, [&](Place place, ShapeId id) {
        if (id < lowest && is_on(table.get(place), point)) lowest = id;
    });
    return lowest;
}

} // namespace

ShapeId surface_through(const Scene& scene, const Vec3f& point) {
    ShapeId lowest = no_shape;
    for_each_unbounded_table(scene.shapes(), [&](const auto& table) {
        for (std::uint32_t index = 0; index < table.blocks().size(); ++index)
            lowest = std::min(lowest, lowest_in_block(table, index, point));
    });

    const BigArray<WideNode>& nodes = scene.hierarchy().nodes;
    std::vector<Child> pending;
    if (!nodes.empty()) pending.push_back(Child::node(0));
    while (!pending.empty()) {
        const WideNode& node = nodes[pending.back().index()];
        pending.pop_back();
        for (int i = 0; i < block_size; ++i) {
            const Child child = node.children[i];
            if (child.empty() || !node.bounds(i).contains(point)) continue;
            if (!child.is_block()) {
                pending.push_back(child);
                continue;
            }
            lowest =
                std::min(lowest, with_table(scene.shapes(), child.kind(), [&](const auto& table) {
                             return lowest_in_block(table, child.index(), point);
                         }));
        }
    }
    return lowest;
}

} // namespace raylane::core
