#pragma once

#include "core/scene/scene.hpp"

#include <algorithm>
#include <vector>

namespace raylane::core {

/// Finds parts of solids that may be near a point, by way of the hierarchy; to be used by one
/// thread.
class PartsNear {
  public:
    explicit PartsNear(const Scene& scene) : scene_(scene) {}

    /// Calls visit(kind, block) for the blocks whose bounds meet those, until it returns false.
    template <class Visit>
    void each_block(const Bounds& around, const Visit& visit) {
        const BigArray<WideNode>& nodes = scene_.hierarchy().nodes;
        if (nodes.empty()) return;
        // Whoever is called may look for others.
        const std::size_t others = pending_.size();
        pending_.push_back(0);
        while (pending_.size() > others) {
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
                if (!child.is_block())
                    pending_.push_back(child.index());
                else if (!visit(child.kind(), child.index()))
                    return pending_.resize(others);
            }
        }
    }

    /// Calls visit(child) for the children of a union of many that may have anything within bounds,
    /// until it returns false; in their order if `sorted`.
    template <class Visit>
    void each_child(Solids::Index parent, const Bounds& around, const Visit& visit,
                    bool sorted = false) {
        const Solids& solids = scene_.solids();
        const Solids::Index end = solids.node(parent).end;
        std::vector<Solids::Index> children;
        bool more = true;
        each_block(around, [&](Kind kind, std::uint32_t block) {
            with_table(scene_.shapes(), kind, [&](const auto& table) {
                for_each_in_block(table, block, [&](Place, ShapeId id) {
                    const Solids::Index part = solids.part_of(id);
                    if (part == Solids::none || part <= parent || end <= part) return;
                    const Solids::Index child = solids.child_of(parent, part);
                    if (sorted)
                        children.push_back(child);
                    else
                        more = more && visit(child);
                });
            });
            return more;
        });
        std::sort(children.begin(), children.end());
        children.erase(std::unique(children.begin(), children.end()), children.end());
        for (const Solids::Index child : children)
            if (!visit(child)) return;
    }

  private:
    const Scene& scene_;
    std::vector<std::uint32_t> pending_; // nodes of the hierarchy
};

} // namespace raylane::core
