#pragma once

#include "core/counters.hpp"
#include "core/reference/departure.hpp"
#include "core/scene.hpp"
#include "core/solve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

/// Finding what a ray hits: one shape after the other, by way of the hierarchy or all of them.
namespace raylane::core {

enum class Search : std::uint8_t { hierarchy, every_shape };

/// Searches one scene; to be used by one thread.
template <class Real>
class Searcher {
  public:
    Searcher(const Scene& scene, Search search, Precision precision = precision_of<Real>)
        : scene_(scene), search_(search), precision_(precision) {
        pending_.reserve(512);
        coinciding_.reserve(64);
    }

    /// The first crossing with t < t_most that `counts(hit)`. Its t is infinite if there is none.
    template <class Counts>
    Encounter<Real> nearest(const Ray<Real>& ray, const Departure<Real>& departure,
                            const Counts& counts,
                            Real t_most = std::numeric_limits<Real>::infinity()) {
        Hit<Real> first;
        for (const Contact<Real>& contact : departure)
            if (contact.is_crossed() && contact_hit(contact).before(first) &&
                counts(contact_hit(contact)))
                first = contact_hit(contact);
        if (first.any()) return {first, departure, false};

        Hit<Real> best;
        best.t = t_most;
        coinciding_.clear();
        for_each_candidate(
            ray, [&] { return best.t; },
            [&](Kind kind, std::uint32_t block) {
                cross_block(kind, block, ray, departure, [&](const Hit<Real>& hit) {
                    if (!hit.before(best) && !hit.coincides(best)) return;
                    if (!(hit.t < t_most)) return;
                    // What does not count may still lie where the ray will go on from.
                    const bool may_be_hit = counts(hit);
                    coinciding_.push_back({hit, DoubleDouble(hit.t), hit.error, may_be_hit});
                    if (may_be_hit && hit.before(best)) best = hit;
                });
                return true;
            });
        return best.any() ? encounter(ray, departure, best) : Encounter<Real>{};
    }

    /// Calls visit(hit) for the crossings with t < t_most, in no order, until it returns false.
    template <class Visit>
    void each(const Ray<Real>& ray, const Departure<Real>& departure, Real t_most,
              const Visit& visit) {
        bool more = true;
        for (const Contact<Real>& contact : departure)
            if (more && contact.is_crossed()) more = visit(contact_hit(contact));
        if (!more) return;
        for_each_candidate(
            ray, [&] { return t_most; },
            [&](Kind kind, std::uint32_t block) {
                cross_block(kind, block, ray, departure, [&](const Hit<Real>& hit) {
                    if (more && hit.t < t_most) more = visit(hit);
                });
                return more;
            });
    }

    /// The unit normal on the outside (the front).
    Vec3<Real> outward_normal_at(const Hit<Real>& hit, const Vec3<Real>& point) const {
        return with_table(scene_.shapes(), hit.kind, [&](const auto& table) {
            return outward_normal(table.get(hit.slot), point, hit.face);
        });
    }

    Counters counters;

  private:
    static Hit<Real> contact_hit(const Contact<Real>& contact) {
        Hit<Real> hit = contact.hit;
        hit.t = 0;
        hit.error = 0.0;
        hit.at_start = true;
        hit.entering = contact.goes_inside;
        return hit;
    }

    /// A hit that may be the first, or in contact with it.
    struct Candidate {
        Hit<Real> hit;
        DoubleDouble t; ///< of the hit, as well as it is known
        double t_error; ///< of that
        bool may_be_hit;

        bool is_surely_before(const Candidate& other) const {
            return static_cast<double>(other.t - t) > t_error + other.t_error;
        }
    };

    /// Of coinciding_, among which is `best`. What is entered comes before what is left where they
    /// coincide: they touch, there is no gap between them.
    Encounter<Real> encounter(const Ray<Real>& ray, const Departure<Real>& departure,
                              Hit<Real> best) {
        const auto drop_others = [&] {
            std::erase_if(coinciding_, [&](const Candidate& candidate) {
                return !candidate.hit.coincides(best);
            });
        };
        drop_others();
        Encounter<Real> result;
        if constexpr (std::is_same_v<Real, double>)
            if (coinciding_.size() > 1 && precision_ == Precision::exact) {
                for (Candidate& candidate : coinciding_)
                    sharpen(candidate, ray, departure);
                best = first_of_coinciding().hit;
                drop_others();
                result.is_close = true;
            }
        result.hit = first_of_coinciding().hit;

        const Vec3<Real> point = mul_add(result.hit.t, ray.direction, ray.origin);
        const auto add = [&](const Hit<Real>& hit) {
            if (result.contacts.find(hit.shape) != nullptr) return;
            result.contacts.add({hit, scene_.coplanar_with(hit.shape),
                                 outward_normal_at(hit, point), !hit.entering, hit.entering});
        };
        add(result.hit);
        for (const Candidate& candidate : coinciding_)
            add(candidate.hit);
        return result;
    }

    /// Of those that may be hit: the first for sure, or, of those that cannot be told apart from
    /// the first, the one that the rule says.
    const Candidate& first_of_coinciding() const {
        const Candidate* first = nullptr;
        for (const Candidate& candidate : coinciding_)
            if (candidate.may_be_hit && (first == nullptr || candidate.is_surely_before(*first)))
                first = &candidate;
        const Candidate* chosen = first;
        for (const Candidate& candidate : coinciding_) {
            if (!candidate.may_be_hit || first->is_surely_before(candidate)) continue;
            const Hit<Real>&a = candidate.hit, &b = chosen->hit;
            if (a.entering != b.entering ? a.entering : a.shape < b.shape) chosen = &candidate;
        }
        return *chosen;
    }

    /// Solves in double-double. In double it leaves an error of no more than what double loses of
    /// the point: what is closer together than that is in contact for a ray that goes on from
    /// there.
    void sharpen(Candidate& candidate, const Ray<double>& ray, const Departure<double>& departure) {
        using Wide = Bounded<DoubleDouble>;
        Hit<double>& hit = candidate.hit;
        with_table(scene_.shapes(), hit.kind, [&](const auto& table) {
            Judge<Wide> judge;
            const Ray<Wide> wide{convert<Wide>(ray.origin), convert<Wide>(ray.direction)};
            const Crossings<Wide> all =
                crossings(table.get(hit.slot), wide, departure.start_on(hit.shape), judge);
            ++counters.widened;
            const double rounding = 0x1p-53 * (std::abs(ray.origin.x) + std::abs(ray.origin.y) +
                                               std::abs(ray.origin.z) + std::abs(hit.t));
            for (const Crossing<Wide>& crossing : all) {
                const auto t = static_cast<double>(crossing.t);
                const bool same = crossing.face == hit.face && crossing.entering == hit.entering &&
                                  std::abs(t - hit.t) <= crossing.t.error + hit.error;
                if (!same || crossing.t.error + rounding >= hit.error) continue;
                candidate.t = crossing.t.value;
                candidate.t_error = crossing.t.error;
                hit.t = t;
                hit.error = crossing.t.error + rounding;
                return;
            }
        });
    }

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
    /// float, and in plain double, the solvers promise nothing; the bounds' padding does the rest.
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
                     const Departure<Real>& departure, const Visit& visit) {
        with_table(scene_.shapes(), kind, [&](const auto& table) {
            const auto& block = table.blocks()[index];
            for (int lane = 0; lane < block_size && block.ids[lane] != no_shape; ++lane) {
                const ShapeId id = block.ids[lane];
                const Start start = departure.start_on(id);
                ++counters.shapes;
                for (const Crossing<Real>& crossing :
                     solve(block.get(lane), ray, start, counters.widened, precision_))
                    if (crossing.t > Real(0) || (start.on_surface && crossing.t == Real(0)))
                        visit(Hit<Real>{crossing.t, crossing.error, false, id, crossing.face,
                                        crossing.entering, kind,
                                        Slot{index, static_cast<std::uint8_t>(lane)}});
            }
        });
    }

    const Scene& scene_;
    Search search_;
    Precision precision_;
    std::vector<Pending> pending_;      // nearest last
    std::vector<Candidate> coinciding_; // with the best so far
};

} // namespace raylane::core
