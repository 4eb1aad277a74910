#include "core/reference/search.hpp"

#include "core/reference/crossing_order.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace raylane::core {

namespace {

template <class Real>
Hit<Real> contact_hit(const Contact<Real>& contact) {
    Hit<Real> hit = contact.hit;
    hit.t = 0;
    hit.error = 0.0;
    hit.at_start = true;
    hit.entering = contact.goes_inside;
    return hit;
}

/// Tolerance for a miss of bounds, relative to t. It is the solvers' error, which is 2^-27 in
/// double, plus the error of the quotients in entry_t(), 3 half ulps (Ize, "Robust BVH Ray
/// Traversal", 2013). In float, and in plain double, the solvers guarantee nothing.
template <class Real>
constexpr Real allowance = Real(1) + Real(std::is_same_v<Real, float> ? 0x1p-20 : 0x1p-25);

/// Returns a limit of t with the tolerance. Subnormal numbers have a larger error.
template <class Real>
Real allowed(Real limit) {
    return limit * allowance<Real> + (std::is_same_v<Real, double> ? Real(0x1p-1060) : Real(0));
}

/// Returns the t >= 0 at which a ray enters the bounds of entry i, or -1 if the ray misses these
/// bounds between 0 and t_limit. A direction component of 0 gives 0 / 0 only if the origin is in a
/// plane of the bounds. Either answer is then right, as no shape touches its bounds. (The
/// reciprocal of a tiny component would overflow.)
template <class Real>
Real entry_t(const WideNode& node, int i, const Ray<Real>& ray, Real t_limit) {
    Real near = 0, far = t_limit;
    for (int axis = 0; axis < 3; ++axis) {
        const Real to_lower = Real(node.lower[axis][i]) - ray.origin[axis];
        const Real to_upper = Real(node.upper[axis][i]) - ray.origin[axis];
        const Real at_lower = to_lower / ray.direction[axis];
        const Real at_upper = to_upper / ray.direction[axis];
        near = std::max(near, std::min(at_lower, at_upper));
        far = std::min(far, std::max(at_lower, at_upper));
    }
    return near <= allowed(far) ? near : Real(-1);
}

} // namespace

template <class Real>
Searcher<Real>::Searcher(const Scene& scene, Search search, Precision precision)
    : scene_(scene), search_(search), precision_(precision), solid_surfaces_(scene) {
    if (scene.copies() != nullptr) copy_walk_.emplace(*scene.copies());
    pending_.reserve(512);
    candidates_.reserve(64);
    sharp_.reserve(64);
    contacts_.reserve(64);
}

template <class Real>
Encounter<Real> Searcher<Real>::nearest(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                                        OfHit counts, Real t_limit) {
    Hit<Real> first;
    for (const Contact<Real>& contact : origins) {
        if (!contact.is_crossed() || !counts(contact_hit(contact)) ||
            !is_surface(ray, origins, contact_hit(contact)))
            continue;
        if (!first.any() || contact_hit(contact).precedes(first)) first = contact_hit(contact);
    }
    if (first.any()) return {first, origins};
    const Hit<Real> best = look(ray, origins, counts, t_limit);
    return best.any() ? encounter(ray, origins, best) : Encounter<Real>{};
}

template <class Real>
void Searcher<Real>::each(const Ray<Real>& ray, const OriginSurfaces<Real>& origins, Real t_limit,
                          OfHit visit) {
    bool more = true;
    for (const Contact<Real>& contact : origins)
        if (more && contact.is_crossed() && is_surface(ray, origins, contact_hit(contact)))
            more = visit(contact_hit(contact));
    if (!more) return;
    for_each_candidate(
        ray, [&] { return t_limit; },
        [&](Kind kind, std::uint32_t block) {
            cross_block(kind, block, ray, origins, [&](const Hit<Real>& hit) {
                if (more && hit.t < t_limit && is_surface(ray, origins, hit)) more = visit(hit);
            });
            return more;
        });
}

template <class Real>
SurfacePoint<Real> Searcher<Real>::surface_at(const Ray<Real>& ray,
                                              const OriginSurfaces<Real>& origins,
                                              const Hit<Real>& hit) const {
    if constexpr (std::is_same_v<Real, double>)
        if (is_exact()) return surface_point(scene_, {ray, origins}, hit);
    const Vec3<Real> point = mul_add(hit.t, ray.direction, ray.origin);
    return with_table(scene_.shapes(), hit.kind, [&](const auto& table) {
        return SurfacePoint<Real>{point, outward_normal(table.get(hit.place), point, hit.face)};
    });
}

template <class Real>
void Searcher<Real>::sort(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                          std::vector<Hit<Real>>& hits) {
    if constexpr (std::is_same_v<Real, double>)
        if (is_exact()) {
            const CrossingOrder order(scene_, {ray, origins});
            sharp_.assign(hits.begin(), hits.end());
            std::sort(sharp_.begin(), sharp_.end(),
                      [&](const SharpHit& a, const SharpHit& b) { return order.is_before(a, b); });
            for (std::size_t i = 0; i < hits.size(); ++i) {
                hits[i] = sharp_[i].sharpened();
                hits[i].joins = i != 0 && order.compare(sharp_[i - 1], sharp_[i]) == 0;
            }
            return;
        }
    std::sort(hits.begin(), hits.end(), [](const Hit<Real>& a, const Hit<Real>& b) {
        return a.t != b.t ? a.t < b.t : a.precedes(b);
    });
    for (std::size_t i = 0; i < hits.size(); ++i)
        hits[i].joins = i != 0 && hits[i - 1].t == hits[i].t;
}

/// Returns true if a crossing is on the surface of the solid that the shape belongs to, or if the
/// shape belongs to no solid.
template <class Real>
bool Searcher<Real>::is_surface(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                                const Hit<Real>& hit) {
    if (!scene_.solids().has(hit.shape)) return true;
    if constexpr (std::is_same_v<Real, double>)
        return solid_surfaces_.is_surface({ray, origins}, hit);
    else {
        const Ray<double> in_double{convert<double>(ray.origin), convert<double>(ray.direction)};
        return solid_surfaces_.is_surface({in_double, OriginSurfaces<double>(origins)},
                                          Hit<double>(hit));
    }
}

/// Fills candidates_. Returns a hit that may be the first, or no hit.
template <class Real>
Hit<Real> Searcher<Real>::look(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                               OfHit counts, Real t_limit) {
    Hit<Real> best;
    best.t = t_limit;
    candidates_.clear();
    for_each_candidate(
        ray, [&] { return std::isfinite(best.error) ? best.t : t_limit; },
        [&](Kind kind, std::uint32_t block) {
            cross_block(kind, block, ray, origins, [&](const Hit<Real>& hit) {
                if (best.is_surely_before(hit) || !(hit.t < t_limit)) return;
                // A hit that does not count may still be at the point where the ray continues.
                const bool may_be_hit = counts(hit) && is_surface(ray, origins, hit);
                candidates_.push_back({hit, may_be_hit});
                if (may_be_hit && (hit.t < best.t || !best.any())) best = hit;
            });
            return true;
        });
    return best;
}

/// Returns the ray's encounter with the candidates, which include `best`: the first hit that
/// counts, and all hits at the same t.
template <class Real>
Encounter<Real> Searcher<Real>::encounter(const Ray<Real>& ray, const OriginSurfaces<Real>& origins,
                                          const Hit<Real>& best) {
    std::erase_if(candidates_,
                  [&](const Candidate& candidate) { return best.is_surely_before(candidate.hit); });
    if constexpr (std::is_same_v<Real, double>)
        if (is_exact() && candidates_.size() > 1) {
            const CrossingOrder order(scene_, {ray, origins});
            sharp_.clear();
            for (const Candidate& candidate : candidates_)
                sharp_.emplace_back(candidate.hit);
            return first_of(sharp_, ray, origins, [&](const SharpHit& a, const SharpHit& b) {
                return order.compare(a, b);
            });
        }
    return first_of(candidates_, ray, origins, [](const Candidate& a, const Candidate& b) {
        return a.hit.t < b.hit.t ? -1 : a.hit.t > b.hit.t ? 1 : 0;
    });
}

/// Returns the encounter with `hits`, which correspond to the candidates: the first hit that
/// counts, and all hits at the same t.
template <class Real>
template <class AnyHit, class Compare>
Encounter<Real> Searcher<Real>::first_of(const std::vector<AnyHit>& hits, const Ray<Real>& ray,
                                         const OriginSurfaces<Real>& origins,
                                         const Compare& compare) {
    const auto hit_of = [](const AnyHit& any) -> const Hit<Real>& {
        if constexpr (std::is_same_v<AnyHit, Candidate>)
            return any.hit;
        else
            return any.hit();
    };
    const auto sharpened = [&](const AnyHit& any) {
        if constexpr (std::is_same_v<AnyHit, Candidate>)
            return any.hit;
        else
            return any.sharpened();
    };
    std::size_t first = hits.size();
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!candidates_[i].may_be_hit) continue;
        const int order = first == hits.size() ? -1 : compare(hits[i], hits[first]);
        if (order < 0 || (order == 0 && hit_of(hits[i]).precedes(hit_of(hits[first])))) first = i;
    }
    const Hit<Real> hit_first = sharpened(hits[first]);
    contacts_.clear();
    const auto add = [&](const Hit<Real>& hit) {
        const IdRange shapes = scene_.coplanar_with(hit.shape);
        // An edge between triangles of one polygon belongs to both.
        if (shapes.first != shapes.last &&
            std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact<Real>& other) {
                return other.shapes.first == shapes.first;
            }))
            return;
        contacts_.push_back(
            {hit, shapes, scene_.material_index_of(hit.shape), surface_at(ray, origins, hit).normal,
             !hit.entering, hit.entering,
             scene_.solids().has(hit.shape) ? scene_.solids().solid_of(hit.shape) : no_shape,
             is_surface(ray, origins, hit)});
    };
    add(hit_first);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (i != first && compare(hits[i], hits[first]) == 0) add(sharpened(hits[i]));
    return {hit_first, OriginSurfaces<Real>(contacts_)};
}

/// Calls visit(kind, block) for the blocks that may be hit before t_limit(), until visit returns
/// false.
template <class Real>
template <class Most, class Visit>
void Searcher<Real>::for_each_candidate(const Ray<Real>& ray, const Most& t_limit,
                                        const Visit& visit) {
    bool more = true;
    const auto visit_all = [&]<class Shape>(const Table<Shape>& table) {
        for (std::uint32_t block = 0; more && block < table.blocks().size(); ++block)
            more = visit(kind_of<Shape>, block);
    };
    if (search_ == Search::every_shape) {
        for_each_table(scene_.shapes(), visit_all);
        if (more) walk_copies(ray, t_limit, visit);
        return;
    }
    for_each_unbounded_table(scene_.shapes(), visit_all);
    const auto visit_next = [&](Kind kind, std::uint32_t block) {
        return more = visit(kind, block);
    };
    if (more && !scene_.hierarchy().nodes.empty()) walk(ray, t_limit, visit_next);
    if (more) walk_copies(ray, t_limit, visit);
}

/// Visits all blocks of the copies whose spheres the ray enters.
template <class Real>
template <class Most, class Visit>
void Searcher<Real>::walk_copies(const Ray<Real>& ray, const Most& t_limit, const Visit& visit) {
    if (!copy_walk_) return;
    const Copies& copies = *scene_.copies();
    copy_walk_->start({convert<double>(ray.origin), convert<double>(ray.direction)});
    std::uint32_t number = 0;
    while (copy_walk_->next(static_cast<double>(allowed(t_limit())), number)) {
        const Copies::Copy copy = copies.copy_at(number);
        for (int k = 0; k < kind_count; ++k)
            for (std::uint32_t i = 0; i < copy.set.block_count[static_cast<std::size_t>(k)]; ++i) {
                const auto kind = static_cast<Kind>(k);
                const std::uint32_t block = Copies::block_of(copy, kind, i);
                copies.make(kind, block);
                if (!visit(kind, block)) return;
            }
    }
}

/// Visits the blocks through the hierarchy, nearest first.
template <class Real>
template <class Most, class Visit>
void Searcher<Real>::walk(const Ray<Real>& ray, const Most& t_limit, const Visit& visit) {
    pending_.assign(1, {Real(0), Child::node(0)});
    while (!pending_.empty()) {
        const Pending next = pending_.back();
        pending_.pop_back();
        if (next.t > allowed(t_limit())) continue;
        if (next.child.is_block()) {
            if (!visit(next.child.kind(), next.child.index())) return;
            continue;
        }
        ++counters.nodes;
        const WideNode& node = scene_.hierarchy().nodes[next.child.index()];
        const auto first = static_cast<std::ptrdiff_t>(pending_.size());
        for (int i = 0; i < block_size && !node.children[i].empty(); ++i) {
            const Real t = entry_t(node, i, ray, t_limit());
            if (t >= Real(0)) pending_.push_back({t, node.children[i]});
        }
        std::sort(pending_.begin() + first, pending_.end(),
                  [](const Pending& a, const Pending& b) { return a.t > b.t; });
    }
}

/// Calls visit(hit) for each crossing ahead of the ray with one block's shapes.
template <class Real>
void Searcher<Real>::cross_block(Kind kind, std::uint32_t index, const Ray<Real>& ray,
                                 const OriginSurfaces<Real>& origins,
                                 FunctionRef<void(const Hit<Real>&)> visit) {
    with_table(scene_.shapes(), kind, [&](const auto& table) {
        for_each_in_block(table, index, [&](Place place, ShapeId id) {
            const Start start = origins.start_on(id);
            ++counters.shapes;
            for (const Crossing<Real>& crossing :
                 solve(table.get(place), ray, start, counters.widened, precision_))
                if (crossing.t > Real(0) || (start.on_surface && crossing.t == Real(0)))
                    visit(Hit<Real>(crossing, id, kind, place, scene_.solids().is_reversed(id)));
        });
    });
}

template class Searcher<float>;
template class Searcher<double>;

} // namespace raylane::core
