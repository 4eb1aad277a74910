#pragma once

#include "core/counters.hpp"
#include "core/scene.hpp"
#include "core/solve.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

/// Finding what a ray hits: one shape after the other, by way of the hierarchy or all of them.
namespace raylane::core {

/// What a secondary ray knows of the surface that it leaves.
struct Departure {
    IdRange shapes{no_shape, no_shape}; ///< itself and what lies in one plane with it
    Start start;

    Start from(ShapeId id) const { return shapes.contains(id) ? start : Start{}; }
};

template <class Real>
struct Hit {
    Real t = std::numeric_limits<Real>::infinity();
    ShapeId shape = no_shape;
    int order = 0; ///< among the crossings of this shape
    Face face = body;
    bool entering = false;
    Kind kind = Kind::sphere;
    Slot slot{};

    bool any() const { return shape != no_shape; }

    /// The crossings along one ray in a total order: by t, then by shape.
    bool before(const Hit& other) const {
        return std::tie(t, shape, order) < std::tie(other.t, other.shape, other.order);
    }
};

enum class Search : std::uint8_t { hierarchy, every_shape };

/// Searches one scene; to be used by one thread.
template <class Real>
class Searcher {
  public:
    Searcher(const Scene& scene, Search search) : scene_(scene), search_(search) {}

    /// The first crossing with t < t_most that `counts(hit)`. At equal t the lower shape id wins.
    template <class Counts>
    Hit<Real> nearest(const Ray<Real>& ray, const Departure& departure, Real t_most,
                      const Counts& counts) {
        Hit<Real> best;
        best.t = t_most;
        for_each_candidate(
            ray, [&] { return best.t; },
            [&](Kind kind, std::uint32_t block) {
                cross_block(kind, block, ray, departure, [&](const Hit<Real>& hit) {
                    if (hit.t < t_most && hit.before(best) && counts(hit)) best = hit;
                });
                return true;
            });
        if (!best.any()) best.t = std::numeric_limits<Real>::infinity();
        return best;
    }

    /// Whether there is a crossing with t < t_most that `counts(hit)`.
    template <class Counts>
    bool any(const Ray<Real>& ray, const Departure& departure, Real t_most, const Counts& counts) {
        bool found = false;
        for_each_candidate(
            ray, [&] { return t_most; },
            [&](Kind kind, std::uint32_t block) {
                cross_block(kind, block, ray, departure, [&](const Hit<Real>& hit) {
                    found = found || (hit.t < t_most && counts(hit));
                });
                return !found;
            });
        return found;
    }

    Counters counters;

  private:
    struct Pending {
        Real t;
        Child child;
    };

    /// Calls visit(kind, block) for the blocks that may be hit before t_most(), until it returns
    /// false.
    template <class Most, class Visit>
    void for_each_candidate(const Ray<Real>& ray, const Most& t_most, const Visit& visit) {
        bool more = true;
        const auto visit_all = [&]<class Shape>(const Table<Shape>& table) {
            for (std::uint32_t block = 0; more && block < table.blocks().size(); ++block)
                more = visit(kind_of<Shape>, block);
        };
        if (search_ == Search::every_shape) {
            for_each_table(scene_.shapes(), visit_all);
            return;
        }
        visit_all(std::get<Table<Plane>>(scene_.shapes()));
        if (more && !scene_.hierarchy().nodes.empty()) walk(ray, t_most, visit);
    }

    /// Through the hierarchy, nearest first.
    template <class Most, class Visit>
    void walk(const Ray<Real>& ray, const Most& t_most, const Visit& visit) {
        const Vec3<Real> inverse = Real(1) / ray.direction;
        pending_.assign(1, {Real(0), Child::node(0)});
        while (!pending_.empty()) {
            const Pending next = pending_.back();
            pending_.pop_back();
            if (next.t > t_most() * allowance) continue;
            if (next.child.is_block()) {
                if (!visit(next.child.kind(), next.child.index())) return;
                continue;
            }
            ++counters.nodes;
            const WideNode& node = scene_.hierarchy().nodes[next.child.index()];
            const auto first = static_cast<std::ptrdiff_t>(pending_.size());
            for (int slot = 0; slot < block_size && !node.children[slot].empty(); ++slot) {
                const Real t = entry(node, slot, ray, inverse, t_most());
                if (t >= Real(0)) pending_.push_back({t, node.children[slot]});
            }
            std::sort(pending_.begin() + first, pending_.end(),
                      [](const Pending& a, const Pending& b) { return a.t > b.t; });
        }
    }

    /// What bounds may be missed by, relative to t: the solvers' error, which is 2^-27 in double,
    /// and that of the quotients here, 3 half ulps (Ize, "Robust BVH Ray Traversal", 2013). In
    /// float the solvers promise nothing; the bounds' padding does the rest.
    static constexpr Real allowance =
        Real(1) + Real(std::is_same_v<Real, float> ? 0x1p-20 : 0x1p-25);

    /// Where a ray enters a slot's bounds, t >= 0; -1 if it misses them between 0 and t_most. A
    /// component of 0 makes 0 * inf only if the origin is in a plane of the bounds; either answer
    /// is then right, as the padding keeps every shape away from there.
    static Real entry(const WideNode& node, int slot, const Ray<Real>& ray,
                      const Vec3<Real>& inverse, Real t_most) {
        Real near = 0, far = t_most;
        for (int axis = 0; axis < 3; ++axis) {
            const Real to_lower = Real(node.lower[axis][slot]) - ray.origin[axis];
            const Real to_upper = Real(node.upper[axis][slot]) - ray.origin[axis];
            const Real at_lower = to_lower * inverse[axis];
            const Real at_upper = to_upper * inverse[axis];
            near = std::max(near, std::min(at_lower, at_upper));
            far = std::min(far, std::max(at_lower, at_upper));
        }
        return near <= far * allowance ? near : Real(-1);
    }

    /// Calls visit(hit) for each crossing ahead of the ray with one block's shapes.
    template <class Visit>
    void cross_block(Kind kind, std::uint32_t index, const Ray<Real>& ray,
                     const Departure& departure, const Visit& visit) {
        with_table(scene_.shapes(), kind, [&](const auto& table) {
            const auto& block = table.blocks()[index];
            for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane) {
                const ShapeId id = block.ids[lane];
                const Start start = departure.from(id);
                ++counters.shapes;
                int order = 0;
                for (const Crossing<Real>& crossing :
                     solve(block.get(lane), ray, start, counters.widened)) {
                    if (crossing.t > Real(0) || (start.on_surface && crossing.t == Real(0)))
                        visit(Hit<Real>{crossing.t, id, order, crossing.face, crossing.entering,
                                        kind, Slot{index, static_cast<std::uint8_t>(lane)}});
                    ++order;
                }
            }
        });
    }

    const Scene& scene_;
    Search search_;
    std::vector<Pending> pending_; // nearest last
};

} // namespace raylane::core
