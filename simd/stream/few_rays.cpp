#include "simd/stream/few_rays.hpp"

#include "core/numbers/infinity.hpp"
#include "core/reference/rounding.hpp"
#include "simd/stream/starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace raylane::simd {

namespace {

constexpr float largest_float = std::numeric_limits<float>::max();

/// Returns true for 0 and magnitudes whose products with others of them are exact enough in double.
bool is_usual(double value) {
    const double size = std::abs(value);
    return size < 0x1p60 && (size >= 0x1p-149 || size == 0.0); // false for NaN
}

} // namespace

FewRays::FewRays(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes)
    : scene_(scene), tracing_(tracing), shapes_(shapes),
      works_(tracing.precision == core::Precision::exact && !scene.looks_through() &&
             scene.prototypes().empty()),
      least_slack_(least_slack(scene.view().rounding)) {
    const Approach approach(scene);
    center_ = approach.center();
    reach_ = scene.has_tree() ? approach.reach() : core::infinity<double>;
    arena_ = arena_for([&](Arena& arena) { workspace_ = workspace_for(scene, arena, 0); });
    for (int axis = 0; axis < 3; ++axis) {
        paths_.origin[axis] = ray_.origin[axis];
        paths_.direction[axis] = ray_.direction[axis];
        rounded_.origin[axis] = ray_.rounded_origin[axis];
        rounded_.direction[axis] = ray_.rounded_direction[axis];
        rounded_.exact_origin[axis] = found_.origin[axis] = ray_.origin[axis];
        rounded_.exact_direction[axis] = found_.direction[axis] = ray_.direction[axis];
        found_.normal[axis] = ray_.normal[axis];
    }
    rounded_.slack = ray_.slack;
    rounded_.before = found_.start = ray_.before;
    rounded_.origin_first = found_.origin_first = paths_.origin_first = ray_.origin_first;
    rounded_.origin_last = found_.origin_last = paths_.origin_last = ray_.origin_last;
    found_.origin_bits = paths_.origin_bits = ray_.origin_bits;
    paths_.origin_slot = ray_.origin_slot;
    paths_.start_nowhere(0, packet);
    found_.count = 1;
    found_.slot = ray_.slot;
    found_.t = ray_.t;
    found_.error = ray_.error;
    found_.hit = ray_.hit;
    found_.holds_points = false;
}

template <class Real>
bool FewRays::can_answer(const RayStream<Real>& rays) const {
    const bool has_limits = rays.t_min != nullptr || rays.t_max != nullptr;
    return works_ && rays.count <= most && (std::is_same_v<Real, float> || !has_limits);
}

/// Takes a ray into lane 0, in double and rounded to float. Returns false for unusual rays.
template <class Real>
bool FewRays::take(const RayStream<Real>& rays, std::size_t i) {
    double direction[3], squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto o = static_cast<double>(rays.origin[axis][i]);
        direction[axis] = static_cast<double>(rays.direction[axis][i]);
        squared += direction[axis] * direction[axis];
        if (!is_usual(o) || !is_usual(direction[axis]) || std::abs(o - center_[axis]) > reach_)
            return false;
        ray_.origin[axis][0] = o;
    }
    if (!(squared > 0x1p-120)) return false;
    length_ = std::sqrt(squared);
    per_unit_ = 1.0 / length_;
    for (int axis = 0; axis < 3; ++axis)
        ray_.direction[axis][0] = direction[axis] * per_unit_;
    ray_.before[0] = 0.0;
    t_limit_ = core::infinity<double>;
    if constexpr (std::is_same_v<Real, float>) {
        const float t_min = rays.t_min != nullptr ? rays.t_min[i] : 0.0F;
        const float t_max = rays.t_max != nullptr ? rays.t_max[i] : core::infinity<float>;
        if (!take_limits(t_min, t_max)) return false;
    }
    if (rays.origin_shape != nullptr)
        Starts(scene_, shapes_.slots()).start(paths_, 0, rays, i);
    else
        paths_.start_nowhere(0, 1);
    if ((ray_.origin_bits[0] & origin_may_return) != 0) return false;
    round();
    return true;
}

/// Takes in limits that are compared with the float nearest to t, as CallerStream does.
bool FewRays::take_limits(float t_min, float t_max) {
    if (!(t_min < largest_float && t_max > 0x1p-100F && t_min < t_max)) return false;
    const auto next = [](float t) {
        return static_cast<double>(std::nextafter(t, core::infinity<float>));
    };
    if (t_min > 0.0F) ray_.before[0] = 0.5 * (static_cast<double>(t_min) + next(t_min)) * length_;
    if (t_max < largest_float) t_limit_ = next(t_max) * length_ * (1.0 + 0x1p-50);
    return true;
}

/// Rounds the ray to float from its lower limit on, as Prepare::round_rays does.
void FewRays::round() {
    const double before = ray_.before[0];
    double size = before, off = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray_.origin[axis][0], direction = ray_.direction[axis][0];
        const double coordinate = before * direction + origin;
        const auto rounded = static_cast<float>(coordinate);
        ray_.rounded_origin[axis][0] = rounded;
        ray_.rounded_direction[axis][0] = static_cast<float>(direction);
        size += std::abs(origin);
        off += std::abs(static_cast<double>(rounded) - coordinate);
    }
    if (before > 0.0) off += 0x1p-50 * size;
    ray_.slack[0] = static_cast<float>(off) * (1.0F + 0x1p-15F) + least_slack_;
}

/// Solves the candidate. Returns true if it is certainly the first hit, and its normal is certain
/// to float. The roundings are those of Prepare::list_uncertain.
bool FewRays::solve() {
    tracing_.method().solve_all(scene_.view(), found_);
    constexpr std::uint32_t unknown =
        hit_doubtful | hit_none | hit_normal_doubtful | hit_normal_unknown;
    const float last =
        (static_cast<float>(ray_.t[0] - ray_.before[0]) + static_cast<float>(ray_.error[0])) *
        (1.0F + 0x1p-21F);
    const float bound = std::min(ray_.second[0], ray_.first[0] * culling_slack);
    return (ray_.hit[0] & unknown) == 0 && last <= bound && bound >= min_length;
}

template <class Real>
bool FewRays::nearest(const RayStream<Real>& rays, std::size_t i, const HitStream& hits) {
    if (!take(rays, i)) return false;
    ray_.first[0] = rounded_up(static_cast<float>(t_limit_ - ray_.before[0]));
    ray_.second[0] = core::infinity<float>;
    ray_.slot[0] = no_slot;
    TraceCounters counters{};
    tracing_.method().trace.nearest(scene_.view(), scene_.listed_kinds(), nullptr, 1, rounded_,
                                    {ray_.first, ray_.second, ray_.slot}, workspace_, counters);
    if (ray_.slot[0] == no_slot) {
        store_none(hits, i);
        return true;
    }
    if (!solve()) return false;
    const double t = ray_.t[0] * per_unit_;
    // The length and all operations are off by a few ulps.
    const double error = ray_.error[0] * per_unit_ * (1.0 + 0x1p-50) + 0x1p-49 * t;
    float rounded = 0.0F;
    if (!core::rounds_surely(t, error, rounded) || !(rounded > 0.0F && rounded <= largest_float))
        return false;
    if (rays.t_max != nullptr && !(static_cast<Real>(rounded) <= rays.t_max[i])) {
        store_none(hits, i);
        return true;
    }
    const core::Vec3f normal(static_cast<float>(ray_.normal[0][0]),
                             static_cast<float>(ray_.normal[1][0]),
                             static_cast<float>(ray_.normal[2][0]));
    store(hits, i, rounded, 0.0, normal + core::Vec3f(0.0F), scene_.id_of(ray_.slot[0]),
          (ray_.hit[0] & hit_entering) != 0, ray_.hit[0] & hit_face);
    return true;
}

template <class Real>
std::optional<bool> FewRays::occluded(const RayStream<Real>& rays, std::size_t i) {
    if (!take(rays, i)) return std::nullopt;
    ray_.first[0] = static_cast<float>(t_limit_ - ray_.before[0]);
    if (ray_.first[0] < min_length || ray_.before[0] > 0.25 * t_limit_) return std::nullopt;
    ray_.state[0] = unblocked;
    TraceCounters counters{};
    tracing_.method().trace.occluded(scene_.view(), scene_.listed_kinds(), nullptr, 1, rounded_,
                                     {ray_.first, ray_.state}, workspace_, counters);
    if (ray_.state[0] == doubtful) return std::nullopt;
    return ray_.state[0] == blocked;
}

#define RAYLANE_INSTANTIATE(Real)                                                                  \
    template bool FewRays::can_answer(const RayStream<Real>&) const;                               \
    template bool FewRays::nearest(const RayStream<Real>&, std::size_t, const HitStream&);         \
    template std::optional<bool> FewRays::occluded(const RayStream<Real>&, std::size_t);
RAYLANE_INSTANTIATE(float)
RAYLANE_INSTANTIATE(double)
#undef RAYLANE_INSTANTIATE

} // namespace raylane::simd
