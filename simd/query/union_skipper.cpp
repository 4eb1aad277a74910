#include "simd/query/union_skipper.hpp"

#include "core/numbers/infinity.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "simd/query/as_core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::simd {

namespace {

/// Maximum number of pairs of rays and shapes at a time, unless one ray has more.
constexpr std::size_t max_pairs = std::size_t{1} << 16;

} // namespace

UnionSkipper::UnionSkipper(const SceneData& scene, const Tracing& tracing)
    : scene_(scene), tracing_(tracing), search_(scene, tracing), pairs_(scene, tracing) {}

void UnionSkipper::take_from(Arena& arena, std::size_t capacity) {
    search_.take_from(arena, capacity);
    t_limit_ = arena.take<float>(capacity);
    pairs_.reserve(capacity);
}

/// Returns true if a ray is inside of a union that nothing cuts.
bool UnionSkipper::is_inside(const core::WayInUnion& way) const {
    return way.counted != core::Solids::none && way.inside > 0 &&
           scene_.scene().solids().node(way.counted).parent == core::Solids::none;
}

void UnionSkipper::skip(const Paths& paths, std::span<core::WayInUnion> ways, double* passed) {
    if (tracing_.method().refine.cross_all == nullptr ||
        std::none_of(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(paths.count),
                     [&](const core::WayInUnion& way) { return is_inside(way); }))
        return;
    search_.take(paths.columns());
    for (std::size_t begin = 0, some = paths.count; begin < paths.count; begin += some) {
        some = std::min(some, paths.count - begin);
        while (!list_pairs(begin, begin + some, ways))
            some /= 2;
        pairs_.cross(paths.origin, paths.direction, paths.direction, /*with_normals=*/false);
        skip_some(paths, begin, begin + some, ways, passed);
    }
}

/// Lists the shapes that rays `begin` to `end` - 1 may cross, sorted by ray. Returns false if they
/// are too many.
bool UnionSkipper::list_pairs(std::size_t begin, std::size_t end,
                              std::span<const core::WayInUnion> ways) {
    for (std::size_t lane = 0; lane < ways.size(); ++lane)
        t_limit_[lane] = begin <= lane && lane < end && is_inside(ways[lane])
                             ? std::numeric_limits<float>::max()
                             : -1.0F;
    constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
    return pairs_.list(search_, t_limit_, end - begin > 1 ? max_pairs : any, [](PairList&) {});
}

void UnionSkipper::skip_some(const Paths& paths, std::size_t begin, std::size_t end,
                             std::span<core::WayInUnion> ways, double* passed) {
    for (std::size_t lane = begin; lane < end; ++lane) {
        if (!is_inside(ways[lane]) || !find_events(paths, lane, ways[lane])) continue;
        const double t = find_place(paths, lane, ways[lane]);
        if (!(t > 0.0)) continue;
        const core::Ray<double> ray = ray_of(paths, lane);
        paths.move_to(lane, core::mul_add(t, ray.direction, ray.origin));
        paths.start_nowhere(lane, lane + 1);
        passed[lane] += t;
    }
}

/// Collects the crossings of a ray. Returns false if one is in doubt.
bool UnionSkipper::find_events(const Paths& paths, std::size_t lane, const core::WayInUnion& way) {
    events_.clear();
    if (!add_return(paths, lane, way)) return false;
    for (std::size_t pair = pairs_.first_of_ray[lane]; pair < pairs_.first_of_ray[lane + 1]; ++pair)
        for (std::size_t k = 2 * pair; k < 2 * pair + 2; ++k) {
            if ((pairs_.bits[k] & hit_none) != 0) continue;
            if ((pairs_.bits[k] & hit_doubtful) != 0) return false;
            add(pairs_.high[k], pairs_.off_by(k), (pairs_.bits[k] & hit_entering) != 0,
                scene_.record_of(pairs_.slot[pair]).id, way);
        }
    return true;
}

/// Adds the crossings of a ray with the shape that it starts on.
bool UnionSkipper::add_return(const Paths& paths, std::size_t lane, const core::WayInUnion& way) {
    if ((paths.origin_bits[lane] & origin_may_return) == 0) return true;
    const std::uint32_t slot = paths.origin_slot[lane];
    const core::ShapeId id = scene_.record_of(slot).id;
    const core::Ray<double> ray = ray_of(paths, lane);
    const core::Start start = origin_surfaces_of(scene_, paths, lane).start_on(id);
    return core::with_table(
        scene_.scene().shapes(), scene_.record_of(slot).kind, [&](const auto& table) {
            std::uint64_t widened = 0;
            bool leaves = !start.inward;
            for (const core::Crossing<double>& crossing :
                 core::solve(table.get(scene_.place_of(slot)), ray, start, widened)) {
                if (!std::isfinite(crossing.error) || !(crossing.t > crossing.error)) return false;
                leaves = leaves || !crossing.entering;
                add(crossing.t, crossing.error, crossing.entering, id, way);
            }
            return leaves;
        });
}

void UnionSkipper::add(double t, double error, bool entering, core::ShapeId shape,
                       const core::WayInUnion& way) {
    const double off = error * (1.0 + 0x1p-50) + 0x1p-50 * t;
    const core::Solids& solids = scene_.scene().solids();
    const bool is_part =
        solids.has(shape) && solids.node(solids.part_of(shape)).parent == way.counted;
    events_.push_back({t - off, t + off, is_part, entering});
}

/// Returns a t between the last crossing that is certainly hidden and the next one, or 0 unless
/// three such places in a row are far apart for doubles. Sets the number of parts around the place.
double UnionSkipper::find_place(const Paths& paths, std::size_t lane, core::WayInUnion& way) {
    std::sort(events_.begin(), events_.end(),
              [](const Event& a, const Event& b) { return a.low < b.low; });
    int inside = way.inside;
    double last = 0.0;
    for (std::size_t i = 0, end = 0; i < events_.size(); i = end) {
        // Crossings whose order is not certain.
        double high = events_[i].high;
        int entered = 0, left = 0;
        bool has_others = false;
        for (end = i; end < events_.size() && events_[end].low <= high; ++end) {
            high = std::max(high, events_[end].high);
            has_others = has_others || !events_[end].is_part;
            ++(events_[end].entering ? entered : left);
        }
        if (!has_others && inside - left > 0) {
            inside += entered - left;
            last = high;
            continue;
        }
        // Near a contact, the walk from crossing to crossing finds the surfaces.
        const double next = events_[i].low;
        const double after = end < events_.size() ? events_[end].low : core::infinity<double>;
        double size = high;
        for (int axis = 0; axis < 3; ++axis)
            size = std::max(size, std::abs(paths.origin[axis][lane]));
        const double far = 0x1p-40 * size;
        if (!(last > 0.0) || end - i > 1 || !(next - last > far) || !(after - high > far)) break;
        way.inside = inside;
        return 0.5 * last + 0.5 * next;
    }
    return 0.0;
}

} // namespace raylane::simd
