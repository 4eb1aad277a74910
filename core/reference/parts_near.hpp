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
            with_table(scene_.shapes(), kind, [&]<class Shape>(const Table<Shape>& table) {
                const unsigned near = near_in(table.blocks()[block], around);
                for_each_in_block(table, block, [&](Place place, ShapeId id) {
                    if ((near >> place.lane & 1) == 0) return;
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
    /// The lanes of a block whose shapes may have something within bounds: of spheres those that
    /// are as near as that, whatever their floats are rounded by.
    template <class Shape>
    static unsigned near_in(const Block<Shape>&, const Bounds&) {
        return ~0U;
    }
    static unsigned near_in(const Block<Sphere>& block, const Bounds& around) {
        constexpr double rounding = 0x1p-22;
        double over[block_size], least[block_size];
        for (int lane = 0; lane < block_size; ++lane) {
            const auto radius = static_cast<double>(block.values[3][lane]);
            over[lane] = radius;
            least[lane] = 0.0;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const auto lower = static_cast<double>(around.lower[axis]);
            const auto upper = static_cast<double>(around.upper[axis]);
            for (int lane = 0; lane < block_size; ++lane) {
                const auto center = static_cast<double>(block.values[axis][lane]);
                const double below = lower - center, above = center - upper;
                const double farther = below > above ? below : above;
                const double away = farther > 0.0 ? farther : 0.0;
                least[lane] += away * away;
                over[lane] += rounding * std::abs(center);
            }
        }
        unsigned near = 0;
        for (int lane = 0; lane < block_size; ++lane) {
            const double reach = over[lane] * (1.0 + rounding);
            near |= static_cast<unsigned>(!(least[lane] > reach * reach)) << lane;
        }
        return near;
    }

    const Scene& scene_;
    std::vector<std::uint32_t> pending_; // nodes of the hierarchy
};

} // namespace raylane::core
