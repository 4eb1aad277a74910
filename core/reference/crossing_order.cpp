#include "core/reference/crossing_order.hpp"

#include "core/shapes/error_predicate.hpp"
#include "core/shapes/shapes.hpp"

#include <utility>

namespace raylane::core {

namespace {

/// Returns the crossing as a root of its surface's equation along the ray. If the ray starts on
/// that surface, t = 0 is a root, and the crossing is the root of the remaining linear equation, as
/// in the solvers. A root behind the start counts as 0, as in not_behind().
template <class Shape>
ExactRoot root_of(const Shape& shape, const LeavingRay& from, const Hit<double>& hit) {
    if (hit.at_start) return ExactRoot::at(0.0);
    const ExactRay ray{convert<Dyadic>(from.ray.origin), convert<Dyadic>(from.ray.direction)};
    const Start start = from.origins.start_on(hit.shape);
    ExactQuadratic form = form_along(shape, ray, hit.face);
    if (!start.on_surface || start.face != hit.face) return {std::move(form), !hit.entering};
    ExactRoot root({0.0, 0.5 * form.A, form.B + form.B}, true);
    return root.sign() > 0 ? root : ExactRoot::at(0.0);
}

} // namespace

void SharpHit::widen(const Scene& scene, const LeavingRay& from) const {
    if (std::exchange(is_wide_, true) || hit_.at_start) return;
    t_ = hit_.t;
    t_error_ = hit_.error;
    with_table(scene.shapes(), hit_.kind,
               [&](const auto& table) { widen(table.get(hit_.place), from); });
}

const ExactRoot& SharpHit::root(const Scene& scene, const LeavingRay& from) const {
    if (!root_)
        with_table(scene.shapes(), hit_.kind,
                   [&](const auto& table) { root_ = root_of(table.get(hit_.place), from, hit_); });
    return *root_;
}

template <class Shape>
void SharpHit::widen(const Shape& shape, const LeavingRay& from) const {
    using Wide = Bounded<DoubleDouble>;
    ErrorPredicate<Wide> predicate;
    const Ray<Wide> wide{convert<Wide>(from.ray.origin), convert<Wide>(from.ray.direction)};
    const Crossings<Wide> found =
        crossings(shape, wide, from.origins.start_on(hit_.shape), predicate);
    if (predicate.doubt()) return; // the formulas may have taken a wrong branch
    for (const Crossing<Wide>& crossing : found) {
        if (crossing.face != hit_.face || crossing.entering != hit_.entering) continue;
        if (!(crossing.t.error < hit_.error)) continue;
        t_ = crossing.t.value;
        t_error_ = crossing.t.error;
    }
}

int CrossingOrder::compare(const SharpHit& a, const SharpHit& b) const {
    if (a.hit().is_surely_before(b.hit())) return decided(&OrderCounters::by_bounds, -1);
    if (b.hit().is_surely_before(a.hit())) return decided(&OrderCounters::by_bounds, 1);
    a.widen(scene_, from_);
    b.widen(scene_, from_);
    if (a.is_surely_before(b)) return decided(&OrderCounters::by_digits, -1);
    if (b.is_surely_before(a)) return decided(&OrderCounters::by_digits, 1);
    if (a.is_surely_at(b)) return decided(&OrderCounters::by_digits, 0);
    return decided(&OrderCounters::exactly,
                   core::compare(a.root(scene_, from_), b.root(scene_, from_)));
}

} // namespace raylane::core
