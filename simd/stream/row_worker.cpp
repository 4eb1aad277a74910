#include "simd/stream/row_worker.hpp"

#include "core/shapes/solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace raylane::simd {

namespace {

bool is_solid(core::Kind kind) {
    return core::with_shape_type(
        kind, []<class Shape>(std::type_identity<Shape>) { return core::is_solid<Shape>; });
}

enum class Within : std::uint8_t { no, yes, unknown };

/// Compares a t with the limits. It has the error `error`, and is the nearest double.
template <class Real>
Within is_within(const Limits& limits, double t, double error) {
    if (!(limits.t_min > 0.0) && limits.t_max == std::numeric_limits<double>::infinity())
        return Within::yes;
    if constexpr (std::is_same_v<Real, float>) {
        float rounded = 0.0F;
        if (!core::rounds_surely(t, error, rounded)) return Within::unknown;
        t = static_cast<double>(rounded);
    }
    return t > limits.t_min && t <= limits.t_max ? Within::yes : Within::no;
}

template <class Real>
void push_back(const core::Vec3<Real>& vector, std::array<std::vector<Real>, 3>& columns) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns[axis].push_back(vector[static_cast<int>(axis)]);
}

} // namespace

RowWorker::RowWorker(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes)
    : scene_(scene), tracing_{tracing.kernels, core::Precision::exact},
      solid_surfaces_(scene.scene()), lengths_(scene.scene()),
      searcher_(scene.scene(), core::Search::hierarchy),
      intake_(scene, tracing_, shapes, at_a_time), search_(scene, tracing_),
      pairs_(scene, tracing_) {
    pairs_.reserve(at_a_time);
    arena_ = arena_for([&](Arena& arena) {
        intake_.take_from(arena);
        search_.take_from(arena, at_a_time);
        t_limit_ = arena.take<float>(at_a_time);
    });
}

/// Calls visit(first, lane) for each ray, once the crossings of the ray with all shapes that it may
/// cross are known. `first` is the index of the first ray of the batch that intake_ took together
/// with this ray. Invalid rays are visited, too. Returns the number of refused ones.
template <class Real, class Visit>
std::size_t RowWorker::for_each_ray(const RayStream<Real>& rays, bool with_normals,
                                    const Visit& visit) {
    std::size_t refused = 0;
    for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
        count = intake_.take(rays, first).count;
        refused += intake_.refused();
        search_.take(intake_.paths().columns());
        for (std::size_t begin = 0, some = count; begin < count; begin += some) {
            some = std::min(some, count - begin);
            while (!list_pairs(begin, begin + some))
                some /= 2;
            const Paths& paths = intake_.paths();
            pairs_.cross(paths.origin, paths.exact_direction, paths.direction, with_normals);
            for (std::size_t lane = begin; lane < begin + some; ++lane)
                visit(first, lane);
        }
    }
    return refused;
}

/// Lists the pairs of a ray in lanes `begin` to `end` - 1 and a shape that this ray may cross,
/// sorted by ray. Returns false if there are more than max_pairs pairs, unless there is only one
/// ray.
bool RowWorker::list_pairs(std::size_t begin, std::size_t end) {
    const Paths& paths = intake_.paths();
    constexpr auto max_of_floats = static_cast<double>(std::numeric_limits<float>::max());
    for (std::size_t lane = 0; lane < paths.count; ++lane) {
        const double left =
            intake_.taken().t_limit[lane] * (1.0 + 0x1p-40) - search_.approach().before(lane);
        const bool is_asked = begin <= lane && lane < end && intake_.is_ray(lane);
        t_limit_[lane] =
            !is_asked
                ? -1.0F
                : std::max(static_cast<float>(std::min(left, max_of_floats)) * candidate_tolerance,
                           std::numeric_limits<float>::min());
    }
    const auto add_own = [&](PairList& list) {
        // Filters do not see the shape on which a ray starts.
        for (std::size_t lane = begin; lane < end; ++lane) {
            if ((paths.origin_bits[lane] & origin_may_return) == 0 || !intake_.is_ray(lane))
                continue;
            if (list.count < list.room) {
                list.ray[list.count] = static_cast<std::uint32_t>(lane);
                list.slot[list.count] = paths.origin_slot[lane];
            }
            ++list.count;
        }
    };
    constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
    return pairs_.list(search_, t_limit_, end - begin > 1 ? max_pairs : any, add_own);
}

/// Sorts the crossings of a ray that count into keys_ and returns true if the results of
/// cross_pairs() suffice:
///   - All crossings are known, and each t rounds to one double with certainty.
///   - The order of the crossings is certain.
///   - It is certain which of the crossings are between the limits.
///   - The ray cannot meet the shape that it leaves again.
template <class Real, class Counts>
bool RowWorker::sort_at_once(const RayStream<Real>& rays, std::size_t lane, const Counts& counts) {
    if ((intake_.paths().origin_bits[lane] & origin_may_return) != 0) return false;
    const double unit = intake_.taken().unit[lane];
    const Limits limits = limits_of(rays, lane);
    keys_.clear();
    for (std::uint32_t k = 2 * pairs_.first_of_ray[lane]; k < 2 * pairs_.first_of_ray[lane + 1];
         ++k) {
        if ((pairs_.bits[k] & hit_none) != 0) continue;
        if ((pairs_.bits[k] & hit_doubtful) != 0 ||
            !core::rounds_surely(core::DoubleDouble(pairs_.high[k], pairs_.low[k]),
                                 pairs_.error[k]) ||
            !std::isnormal(pairs_.high[k] * unit))
            return false;
        if (!counts(k)) continue;
        const Within within =
            is_within<Real>(limits, pairs_.high[k] * unit, pairs_.off_by(k) * unit);
        if (within == Within::unknown) return false;
        if (within == Within::yes) keys_.push_back({pairs_.high[k], k});
    }
    std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) { return a.t < b.t; });
    for (std::size_t i = 1; i < keys_.size(); ++i) {
        const std::uint32_t before = keys_[i - 1].crossing, k = keys_[i].crossing;
        if (!(pairs_.high[before] + pairs_.off_by(before) < pairs_.high[k] - pairs_.off_by(k)))
            return false;
    }
    counters_.order.by_bounds += keys_.empty() ? 0 : keys_.size() - 1;
    return true;
}

/// Adds the crossings in keys_.
template <class Real>
void RowWorker::add_keys(const RayStream<Real>& rays, std::size_t lane,
                         const CrossingRequest& wanted, CrossingRows& rows) {
    const double unit = intake_.taken().unit[lane];
    const std::size_t count = wanted.most == 0 ? keys_.size() : std::min(wanted.most, keys_.size());
    const std::size_t begin = rows.t.size();
    rows.t.resize(begin + count);
    rows.shape.resize(begin + count);
    for (std::vector<std::uint8_t>* const column :
         {&rows.entering, &rows.face, &rows.tied, &rows.touching})
        column->resize(begin + count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t k = keys_[i].crossing;
        const SceneData::ShapeRecord shape = scene_.record_of(pairs_.slot[k / 2]);
        rows.t[begin + i] = pairs_.high[k] * unit;
        rows.shape[begin + i] = shape.id;
        rows.entering[begin + i] = shape.is_entered(pairs_.bits[k]) ? 1 : 0;
        rows.face[begin + i] = static_cast<std::uint8_t>(pairs_.bits[k] & hit_face);
    }
    for (std::size_t i = 0; wanted.normals && i < count; ++i)
        push_back(normal_of(rays, lane, keys_[i].crossing), rows.normal);
    if (!wanted.normals_double || count == 0) return;
    const LoneRay ray = intake_.lone(rays, lane, lane);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t k = keys_[i].crossing;
        const core::SharpHit hit(hit_at(k), {pairs_.high[k], pairs_.low[k]}, pairs_.error[k]);
        push_back(ray.double_normal_of(scene_.scene(), hit), rows.normal_double);
    }
}

/// Returns the normal of a crossing, on the outside of its solid.
template <class Real>
core::Vec3f RowWorker::normal_of(const RayStream<Real>& rays, std::size_t lane, std::size_t k) {
    core::Vec3f normal(pairs_.normal[0][k], pairs_.normal[1][k], pairs_.normal[2][k]);
    const core::Hit<double> hit = hit_at(k);
    if (std::isnan(normal.x) || std::isnan(normal.y) || std::isnan(normal.z))
        normal = core::rounded_normal(scene_.scene(), intake_.lone(rays, lane, lane).leaving(), hit,
                                      normal);
    return hit.reversed ? core::Vec3f(0.0F) - normal : normal; // no -0
}

core::Crossing<double> RowWorker::crossing_at(std::size_t k, const core::DoubleDouble& t) const {
    return {t.high, static_cast<core::Face>(pairs_.bits[k] & hit_face),
            (pairs_.bits[k] & hit_entering) != 0,
            (pairs_.error[k] + std::abs(t.low)) * (1.0 + 0x1p-50)};
}

core::Hit<double> RowWorker::hit_at(std::size_t k) const {
    const SceneData::ShapeRecord shape = scene_.record_of(pairs_.slot[k / 2]);
    return {crossing_at(k, {pairs_.high[k], pairs_.low[k]}), shape.id, shape.kind,
            scene_.place_of(pairs_.slot[k / 2]), shape.reversed};
}

/// Returns true if a crossing is on a visible surface.
template <class Real>
bool RowWorker::is_seen(const RayStream<Real>& rays, std::size_t lane, std::size_t k) {
    const SceneData::ShapeRecord shape = scene_.record_of(pairs_.slot[k / 2]);
    const core::Scene& scene = scene_.scene();
    if (!scene.materials()[shape.material].is_seen(shape.is_entered(pairs_.bits[k]))) return false;
    if (!scene.solids().has(shape.id)) return true;
    const LoneRay ray = intake_.lone(rays, lane, lane);
    return solid_surfaces_.is_surface(ray.leaving(), hit_at(k));
}

/// Finds the crossings of one ray for which wanted(hit) is true, in order.
template <class Counts>
void RowWorker::find(const LoneRay& ray, std::size_t lane, const Counts& wanted) {
    crossed_.clear();
    const auto counts = [&](const core::Hit<double>& hit) {
        return wanted(hit) && solid_surfaces_.is_surface(ray.leaving(), hit);
    };
    if (intake_.is_apart(lane)) {
        searcher_.each(ray.ray, ray.origins, ray.t_limit, [&](const core::Hit<double>& hit) {
            if (wanted(hit)) crossed_.push_back({hit, hit.t, hit.error});
            return true;
        });
        return sort(ray);
    }
    for (std::size_t pair = pairs_.first_of_ray[lane]; pair < pairs_.first_of_ray[lane + 1];
         ++pair) {
        const SceneData::ShapeRecord shape = scene_.record_of(pairs_.slot[pair]);
        const core::Place place = scene_.place_of(pairs_.slot[pair]);
        const auto hit_of = [&](const core::Crossing<double>& crossing) {
            return core::Hit<double>(crossing, shape.id, shape.kind, place, shape.reversed);
        };
        const core::Start start = ray.origins.start_on(shape.id);
        if (start.on_surface ||
            ((pairs_.bits[2 * pair] | pairs_.bits[2 * pair + 1]) & hit_doubtful) != 0) {
            core::with_table(scene_.scene().shapes(), shape.kind, [&](const auto& table) {
                for (const core::Crossing<double>& crossing :
                     core::solve(table.get(place), ray.ray, start, counters_.widened)) {
                    if (!(crossing.t > 0.0 || (start.on_surface && crossing.t == 0.0))) continue;
                    const core::Hit<double> hit = hit_of(crossing);
                    if (counts(hit)) crossed_.push_back({hit, crossing.t, crossing.error});
                }
            });
            continue;
        }
        for (std::size_t k = 2 * pair; k < 2 * pair + 2; ++k) {
            if ((pairs_.bits[k] & hit_none) != 0) continue;
            const core::DoubleDouble t =
                core::double_double::two_sum(pairs_.high[k], pairs_.low[k]);
            const core::Hit<double> hit = hit_of(crossing_at(k, t));
            if (counts(hit)) crossed_.push_back({hit, t, pairs_.error[k]});
        }
    }
    sort(ray);
}

void RowWorker::sort(const LoneRay& ray) {
    std::sort(crossed_.begin(), crossed_.end(),
              [](const Crossed& a, const Crossed& b) { return a.hit.t < b.hit.t; });
    if (are_surely_in_order()) {
        counters_.order.by_bounds += crossed_.empty() ? 0 : crossed_.size() - 1;
        return;
    }
    sharp_.clear();
    for (const Crossed& crossed : crossed_)
        sharp_.emplace_back(crossed.hit, crossed.t, crossed.error);
    order_.resize(crossed_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    const core::CrossingOrder order(scene_.scene(), ray.leaving(), &counters_.order);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return order.is_before(sharp_[a], sharp_[b]);
    });
    sorted_.clear();
    for (std::size_t i = 0; i < order_.size(); ++i) {
        Crossed& crossed = sorted_.emplace_back(crossed_[order_[i]]);
        crossed.hit = sharp_[order_[i]].sharpened();
        crossed.hit.joins = i != 0 && order.compare(sharp_[order_[i - 1]], sharp_[order_[i]]) == 0;
    }
    crossed_.swap(sorted_);
}

bool RowWorker::are_surely_in_order() const {
    for (std::size_t i = 1; i < crossed_.size(); ++i)
        if (!crossed_[i - 1].hit.is_surely_before(crossed_[i].hit)) return false;
    return true;
}

/// Calls visit(some, lane, ray) for each ray, once its crossings that count are known: in keys_ if
/// `ray` is null, otherwise in crossed_. Lane `lane` has ray `lane` of `some`.
template <class Real, class Visit>
std::size_t RowWorker::for_each_row(const RayStream<Real>& rays, bool with_normals,
                                    const Visit& visit) {
    const core::Scene& scene = scene_.scene();
    intake_.take_whole_lines(false);
    return for_each_ray(rays, with_normals, [&](std::size_t first, std::size_t lane) {
        const RayStream<Real> part = part_of(rays, first, rays.count - first);
        const auto counts = [&](std::size_t k) {
            return !scene_.looks_through() || is_seen(part, lane, k);
        };
        keys_.clear();
        if ((!intake_.is_ray(lane) && !intake_.is_apart(lane)) ||
            (intake_.is_ray(lane) && sort_at_once(part, lane, counts)))
            return visit(part, lane, static_cast<const LoneRay*>(nullptr));
        const LoneRay ray = intake_.lone(part, lane, lane);
        find(ray, lane, [&](const core::Hit<double>& hit) { return ray.finds(scene, hit); });
        leave_one_of_polygons();
        visit(part, lane, &ray);
    });
}

template <class Real>
std::size_t RowWorker::crossings(const RayStream<Real>& rays, const CrossingRequest& wanted,
                                 CrossingRows& rows, CrossingCounters& counters) {
    counters_ = {};
    const auto visit = [&](const RayStream<Real>& part, std::size_t lane, const LoneRay* ray) {
        if (ray == nullptr)
            add_keys(part, lane, wanted, rows);
        else
            add(*ray, wanted, rows);
        rows.first.push_back(rows.t.size());
    };
    const std::size_t refused = for_each_row(rays, wanted.normals, visit);
    counters += counters_;
    return refused;
}

template <class Real>
std::size_t RowWorker::count_crossings(const RayStream<Real>& rays, std::uint64_t* counts) {
    const auto visit = [&](const RayStream<Real>&, std::size_t, const LoneRay* ray) {
        *counts++ = ray == nullptr ? keys_.size() : crossed_.size();
    };
    return for_each_row(rays, /*with_normals=*/false, visit);
}

/// Keeps one crossing where several triangles of a polygon meet at an edge: that of the first
/// triangle. Crossings at one t, and on one side, are in the order of their shapes, and a polygon's
/// triangles have consecutive ids.
void RowWorker::leave_one_of_polygons() {
    std::size_t kept = 0;
    for (const Crossed& crossed : crossed_) {
        const core::Hit<double>& hit = crossed.hit;
        if (hit.joins && kept != 0) {
            const core::Hit<double>& last = crossed_[kept - 1].hit;
            if (last.enters() == hit.enters() && last.shape != hit.shape &&
                scene_.scene().coplanar_with(last.shape).contains(hit.shape))
                continue;
        }
        crossed_[kept++] = crossed;
    }
    crossed_.resize(kept);
}

void RowWorker::add(const LoneRay& ray, const CrossingRequest& wanted, CrossingRows& rows) {
    const std::size_t most =
        wanted.most == 0 ? crossed_.size() : std::min(wanted.most, crossed_.size());
    for (std::size_t first = 0, end = 0; first < most; first = end) {
        for (end = first + 1; end < crossed_.size() && crossed_[end].hit.joins;)
            ++end;
        add_at_one_t(ray, std::span(crossed_).subspan(first, end - first), most - first, wanted,
                     rows);
    }
}

/// Adds the crossings at one t: the first `most` of them, or all if there are fewer.
void RowWorker::add_at_one_t(const LoneRay& ray, std::span<const Crossed> group, std::size_t most,
                             const CrossingRequest& wanted, CrossingRows& rows) {
    // Entering crossings come first; each side is sorted by shape.
    const auto left = std::find_if(group.begin(), group.end(),
                                   [](const Crossed& crossed) { return !crossed.hit.enters(); });
    const auto is_among = [](auto begin, auto end, core::ShapeId shape) {
        const auto found =
            std::lower_bound(begin, end, shape, [](const Crossed& crossed, core::ShapeId id) {
                return crossed.hit.shape < id;
            });
        return found != end && found->hit.shape == shape;
    };
    const core::Scene& scene = scene_.scene();
    for (const Crossed& crossed : group.first(std::min(most, group.size()))) {
        const core::Hit<double>& hit = crossed.hit;
        const bool touches = hit.enters() ? is_among(left, group.end(), hit.shape)
                                          : is_among(group.begin(), left, hit.shape);
        rows.t.push_back(ray.double_t_of(scene, hit, crossed.t, crossed.error));
        rows.shape.push_back(hit.shape);
        rows.entering.push_back(hit.enters() ? 1 : 0);
        rows.face.push_back(hit.face);
        rows.tied.push_back(hit.joins ? 1 : 0);
        rows.touching.push_back(touches ? 1 : 0);
        if (wanted.normals) {
            const core::Vec3f normal = core::rounded_normal(scene, ray.leaving(), hit);
            push_back(hit.reversed ? core::Vec3f(0.0F) - normal : normal, rows.normal); // no -0
        }
        if (wanted.normals_double)
            push_back(ray.double_normal_of(scene, {hit, crossed.t, crossed.error}),
                      rows.normal_double);
    }
}

/// Finds the lengths of one ray and returns true if the results of cross_pairs() suffice.
template <class Real>
bool RowWorker::add_lengths_at_once(const RayStream<Real>& lines, const LoneRay& ray,
                                    std::size_t lane, core::Bodies bodies) {
    if (scene_.scene().solids().any()) return false;
    const auto counts = [&](std::size_t k) {
        return is_solid(scene_.record_of(pairs_.slot[k / 2]).kind);
    };
    if (!sort_at_once(lines, lane, counts)) return false;
    solid_crossings_.clear();
    for (const Key& key : keys_) {
        const std::uint32_t k = key.crossing;
        const SceneData::ShapeRecord shape = scene_.record_of(pairs_.slot[k / 2]);
        const bool enters = shape.is_entered(pairs_.bits[k]);
        // A line enters a convex shape before it leaves it.
        const bool from_inside = !enters && (pairs_.bits[k ^ 1] & hit_none) != 0;
        solid_crossings_.push_back(
            {bodies == core::Bodies::materials ? shape.medium : shape.id,
             enters,
             from_inside,
             {core::double_double::two_sum(pairs_.high[k], pairs_.low[k]), pairs_.error[k]}});
    }
    return lengths_.add_certain(ray.ray, solid_crossings_, std::ldexp(ray.t_min, -ray.exponent),
                                std::ldexp(ray.t_max, -ray.exponent), lengths_found_);
}

template <class Real>
std::size_t RowWorker::path_lengths(const RayStream<Real>& rays, core::Bodies bodies,
                                    LengthRows& rows) {
    // The crossings beyond a limit tell which solids contain the ray's point at this limit.
    RayStream<Real> lines = rays;
    lines.t_min = lines.t_max = nullptr;
    const auto visit = [&](std::size_t first, std::size_t lane) {
        if (intake_.is_ray(lane) || intake_.is_apart(lane)) {
            const LoneRay ray = intake_.lone(part_of(rays, first, rays.count - first), lane, lane);
            lengths_found_.clear();
            if (intake_.is_apart(lane) || !add_lengths_at_once(lines, ray, lane, bodies))
                find_lengths(ray, lane, bodies);
            for (const core::BodyLength& found : lengths_found_) {
                rows.body.push_back(found.body);
                rows.length.push_back(found.length);
            }
        }
        rows.first.push_back(rows.body.size());
    };
    intake_.take_whole_lines(true);
    return for_each_ray(rays, /*with_normals=*/false, visit);
}

/// Finds the lengths of one ray by all its crossings.
void RowWorker::find_lengths(LoneRay ray, std::size_t lane, core::Bodies bodies) {
    ray.t_limit = std::numeric_limits<double>::infinity();
    find(ray, lane, [&](const core::Hit<double>& hit) {
        return is_solid(hit.kind) || scene_.scene().solids().has(hit.shape);
    });
    hits_.clear();
    for (const Crossed& crossed : crossed_)
        hits_.push_back(crossed.hit);
    lengths_.add(ray.leaving(), hits_, std::ldexp(ray.t_min, -ray.exponent),
                 std::ldexp(ray.t_max, -ray.exponent), bodies, lengths_found_);
}

#define RAYLANE_INSTANTIATE(Real)                                                                  \
    template std::size_t RowWorker::crossings(const RayStream<Real>&, const CrossingRequest&,      \
                                              CrossingRows&, CrossingCounters&);                   \
    template std::size_t RowWorker::count_crossings(const RayStream<Real>&, std::uint64_t*);       \
    template std::size_t RowWorker::path_lengths(const RayStream<Real>&, core::Bodies, LengthRows&);
RAYLANE_INSTANTIATE(float)
RAYLANE_INSTANTIATE(double)
#undef RAYLANE_INSTANTIATE

} // namespace raylane::simd
