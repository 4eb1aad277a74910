#include "scenes/formats/structure/atom_tree.hpp"

#include <algorithm>

namespace raylane::scenes {
namespace {

constexpr std::uint32_t leaf_size = 8;

bool is_within(const core::Vec3f& apart, float reach) {
    return core::dot(apart, apart) <= reach * reach;
}

} // namespace

AtomTree::AtomTree(const std::vector<core::Vec3f>& positions, const std::vector<AtomIndex>& atoms) {
    points_.reserve(atoms.size());
    for (const AtomIndex atom : atoms)
        points_.push_back(positions[atom]);
    if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

std::uint32_t AtomTree::build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    core::Bounds bounds;
    for (std::uint32_t i = begin; i < end; ++i)
        bounds.include({points_[i], points_[i]});
    nodes_.push_back({bounds, begin, end});
    if (end - begin <= leaf_size) return index;

    const core::Vec3f size = bounds.upper - bounds.lower;
    int axis = size.y > size.x ? 1 : 0;
    if (size.z > size[axis]) axis = 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                     [&](const core::Vec3f& a, const core::Vec3f& b) { return a[axis] < b[axis]; });
    build(begin, middle);
    nodes_[index].second = build(middle, end);
    return index;
}

/// The distance to a node's bounds, rounded, is at most the rounded distance to any of its atoms:
/// rounding keeps the order of coordinates, squares and sums.
bool AtomTree::has_within(const core::Vec3f& point, float reach) const {
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::uint32_t index = open.back();
        open.pop_back();
        const Node& node = nodes_[index];
        core::Vec3f nearest; // of its bounds
        for (int axis = 0; axis < 3; ++axis)
            nearest[axis] =
                std::clamp(point[axis], node.bounds.lower[axis], node.bounds.upper[axis]);
        if (!is_within(point - nearest, reach)) continue;
        if (node.second != 0) {
            open.push_back(node.second);
            open.push_back(index + 1);
            continue;
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i)
            if (is_within(point - points_[i], reach)) return true;
    }
    return false;
}

} // namespace raylane::scenes
