#pragma once

#include "core/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raylane::core {

/// Finds parts of solids that may be near a point, through the hierarchy. For use by one thread.
class PartsNear {
  public:
    explicit PartsNear(const Scene& scene) : scene_(scene) {}

    /// Calls visit(kind, block) for the blocks whose bounds meet `around`, until it returns false.
    template <class Visit>
    void each_block(const Bounds& around, const Visit& visit) {
        const BigArray<WideNode>& nodes = scene_.hierarchy().nodes;
        if (nodes.empty()) return;
        // The callback may start another search.
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

    /// Calls visit(child) for the children of a union of many that may have a point within bounds,
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
                const unsigned near = table.visit_block(
                    block, [&](const Block<Shape>& shapes) { return near_in(shapes, around); });
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
    /// Returns a mask of the lanes whose shapes may have a point within bounds. Tests spheres, and
    /// capped cylinders and cones as if their ends were round, by their distance, with a tolerance
    /// for the rounding of their floats. All lanes of other shapes count.
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

    static unsigned near_in(const Block<CappedCylinder>& block, const Bounds& around) {
        return near_axes(block.values, block.values[6], block.values[6], around);
    }
    static unsigned near_in(const Block<CappedCone>& block, const Bounds& around) {
        return near_axes(block.values, block.values[6], block.values[7], around);
    }
    /// `values`: the base and the axis.
    static unsigned near_axes(const float (*values)[block_size], const float* base_radius,
                              const float* top_radius, const Bounds& around) {
        constexpr double rounding = 0x1p-22;
        const Vec3d lower = convert<double>(around.lower), upper = convert<double>(around.upper);
        const Vec3d middle = 0.5 * lower + 0.5 * upper;
        const double extent =
            0.5 * ((upper.x - lower.x) + (upper.y - lower.y) + (upper.z - lower.z));
        unsigned near = 0;
        for (int lane = 0; lane < block_size; ++lane) {
            double along = 0.0, squared = 0.0, away = 0.0, size = 0.0;
            double from_base[3], axis[3];
            for (int k = 0; k < 3; ++k) {
                const auto base = static_cast<double>(values[k][lane]);
                axis[k] = static_cast<double>(values[3 + k][lane]);
                from_base[k] = middle[k] - base;
                along += from_base[k] * axis[k];
                squared += axis[k] * axis[k];
                size += std::abs(base) + std::abs(axis[k]);
            }
            const double share = along / squared;
            const double nearest = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
            for (int k = 0; k < 3; ++k) {
                const double off = from_base[k] - nearest * axis[k];
                away += off * off;
            }
            const auto radius = static_cast<double>(std::max(base_radius[lane], top_radius[lane]));
            const double reach = (radius + extent) * (1.0 + rounding) + rounding * size;
            near |= static_cast<unsigned>(!(away > reach * reach)) << lane;
        }
        return near;
    }

    const Scene& scene_;
    std::vector<std::uint32_t> pending_; // nodes of the hierarchy
};

} // namespace raylane::core
