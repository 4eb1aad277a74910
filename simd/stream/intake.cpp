#include "simd/stream/intake.hpp"

#include "simd/query/as_core.hpp"
#include "simd/stream/starts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

namespace raylane::simd {

namespace {

/// Returns whether a limit of a ray is NaN.
template <class Real>
bool has_invalid_limit(const RayStream<Real>& rays, std::size_t i) {
    return (rays.t_min != nullptr && std::isnan(rays.t_min[i])) ||
           (rays.t_max != nullptr && std::isnan(rays.t_max[i]));
}

/// Returns whether a ray is refused: see StreamIntake::refused.
template <class Real>
bool is_refused(const RayStream<Real>& rays, std::size_t i) {
    bool is_zero = true;
    for (int axis = 0; axis < 3; ++axis) {
        const Real origin = rays.origin[axis][i], direction = rays.direction[axis][i];
        if (!std::isfinite(origin) || !std::isfinite(direction)) return true;
        is_zero = is_zero && direction == Real(0);
    }
    return is_zero || has_invalid_limit(rays, i);
}

/// Returns the greatest float that is not above a number >= 0.
float float_below(double number) {
    constexpr float largest = std::numeric_limits<float>::max();
    if (std::isinf(number)) return std::numeric_limits<float>::infinity();
    if (!(number < static_cast<double>(largest))) return largest;
    const auto nearest = static_cast<float>(number);
    return static_cast<double>(nearest) <= number ? nearest : std::nextafter(nearest, 0.0F);
}

/// Returns a ray with its largest direction component in [1, 2), if scaling the direction by
/// 2^-exponent is exact. Otherwise returns the ray itself, and the exponent 0.
core::Ray<double> scaled(const core::Ray<double>& ray, int& exponent) {
    const core::Vec3d& d = ray.direction;
    exponent = std::ilogb(core::largest_component(d));
    core::Ray<double> result = ray;
    for (int axis = 0; axis < 3; ++axis) {
        result.direction[axis] = std::ldexp(d[axis], -exponent);
        if (std::ldexp(result.direction[axis], exponent) != d[axis]) {
            exponent = 0;
            return ray;
        }
    }
    return result;
}

/// Returns the columns from lane `to` on. `to` is a multiple of 16.
StreamRays from(StreamRays rays, std::size_t to) {
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] += to;
        rays.direction[axis] += to;
        rays.exact_direction[axis] += to;
    }
    for (double** const column : {&rays.exact_length, &rays.unit, &rays.per_unit, &rays.t_after,
                                  &rays.start, &rays.t_limit})
        *column += to;
    rays.bits += to;
    return rays;
}

} // namespace

void StreamIntake::take_from(Arena& arena) {
    paths_.take_from(arena, capacity_, false, /*for_others=*/true);
    taken_ = {{paths_.origin[0], paths_.origin[1], paths_.origin[2]},
              {paths_.direction[0], paths_.direction[1], paths_.direction[2]},
              {paths_.exact_direction[0], paths_.exact_direction[1], paths_.exact_direction[2]},
              paths_.exact_length,
              arena.take<double>(capacity_),
              arena.take<double>(capacity_),
              paths_.t_after,
              paths_.start,
              arena.take<double>(capacity_),
              paths_.origin_bits};
}

template <class Real>
RayStream<Real> StreamIntake::take(const RayStream<Real>& rays, std::size_t first) {
    paths_.t_after = taken_.t_after;
    paths_.start = taken_.start;
    apart_.clear();
    refused_ = 0;
    const std::size_t left = rays.count - first;
    std::size_t count = std::min(left, together);
    take(part_of(rays, first, count), count, 0);
    const bool coherent = finds_coherence(count);
    coherence_ = coherent ? &in_common_ : nullptr;
    if (!coherent && count < std::min(left, capacity_)) {
        const std::size_t more = std::min(left, capacity_) - count;
        take(part_of(rays, first + count, more), more, count);
        count += more;
    }
    // Only Precision::exact has lower limits in its search. Other precisions check the hits that
    // they find.
    if (tracing_.precision != core::Precision::exact || rays.t_min == nullptr || whole_lines_)
        paths_.t_after = paths_.start = nullptr;
    paths_.count = count;
    return part_of(rays, first, count);
}

/// Returns true if the first rays share a property that makes them faster.
bool StreamIntake::finds_coherence(std::size_t count) {
    // Rays in flight wait for memory in large scenes, so lists pay there for rays that are farther
    // apart. Steps of random rays are 1.1 radii.
    const float max_spread = scene_.is_large() ? 0.5F : 0.2F;
    if (tracing_.precision != core::Precision::exact ||
        !kernels().find_coherence(count, taken_, scene_.radius(), max_spread, in_common_))
        return false;
    constexpr std::size_t fewest_in_large = 512; // near origins alone do not pay for fewer rays
    return !in_common_.loose || !in_common_.scattered || !scene_.is_large() ||
           count >= fewest_in_large;
}

/// Takes all these rays into the lanes from `to` on.
template <class Real>
void StreamIntake::take(const RayStream<Real>& rays, std::size_t count, std::size_t to) {
    RayStream<Real> lines = rays;
    if (whole_lines_) lines.t_min = lines.t_max = nullptr;
    std::size_t none = 0;
    if constexpr (std::is_same_v<Real, float>)
        none = kernels().take(lines, from(taken_, to));
    else {
        none = kernels().take_doubles(lines, from(taken_, to));
        if (floats_) limit_floats(rays, count, to);
    }
    if (whole_lines_) none += refuse_limits(rays, count, to);
    if (rays.origin_shape == nullptr)
        for (std::uint32_t* const column :
             {paths_.origin_first, paths_.origin_last, paths_.origin_slot})
            std::fill_n(column + to, count, no_slot);
    else
        start_on(rays, count, to);
    if (none == 0) return;
    sort_out(rays, count, to);
    stand_in(to, to + count);
}

/// Replaces the limits of rays in double by the floats at or below them: a float is beyond both or
/// neither.
void StreamIntake::limit_floats(const RayStream<double>& rays, std::size_t count, std::size_t to) {
    constexpr float endless = std::numeric_limits<float>::infinity();
    constexpr float largest = std::numeric_limits<float>::max();
    float_t_max_.resize(capacity_);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t lane = to + i;
        const Limits limits = limits_of(rays, i);
        const float after = float_below(limits.t_min), most = float_below(limits.t_max);
        float_t_max_[lane] = most;
        if (!is_ray(lane)) continue;
        const auto next = static_cast<double>(std::nextafter(after, endless));
        const double middle = after > 0.0F ? 0.5 * (static_cast<double>(after) + next) : 0.0;
        const double unit = taken_.unit[lane], length = taken_.exact_length[lane];
        taken_.t_after[lane] = middle / unit;
        taken_.start[lane] = taken_.t_after[lane] * length;
        const bool is_odd = (std::bit_cast<std::uint32_t>(after) & 1) != 0;
        taken_.bits[lane] = after > 0.0F && is_odd ? stream_tie_counts : 0;
        const auto beyond = static_cast<double>(std::nextafter(most, endless));
        taken_.t_limit[lane] = !(after < most)  ? -1.0
                               : most < largest ? beyond / unit * length * (1.0 + 0x1p-50)
                                                : std::numeric_limits<double>::infinity();
    }
}

/// Refuses rays that kernels took in without limits and that have one that is NaN. Returns their
/// number.
template <class Real>
std::size_t StreamIntake::refuse_limits(const RayStream<Real>& rays, std::size_t count,
                                        std::size_t to) {
    std::size_t refused = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_ray(to + i) || !has_invalid_limit(rays, i)) continue;
        taken_.t_limit[to + i] = -1.0;
        ++refused;
    }
    return refused;
}

/// Counts the refused rays, and lists the rays apart. The others have no interval between their
/// limits.
template <class Real>
void StreamIntake::sort_out(const RayStream<Real>& rays, std::size_t count, std::size_t to) {
    constexpr auto most = static_cast<double>(std::numeric_limits<Real>::max());
    for (std::size_t i = 0; i < count; ++i) {
        if (is_ray(to + i)) continue;
        if (is_refused(rays, i)) {
            ++refused_;
        } else if (const Limits limits = limits_of(rays, i);
                   whole_lines_ || limits.t_min < std::min(limits.t_max, most)) {
            taken_.t_limit[to + i] = apart;
            apart_.push_back(static_cast<std::uint32_t>(to + i));
        }
    }
}

template <class Real>
void StreamIntake::start_on(const RayStream<Real>& rays, std::size_t count, std::size_t to) {
    const Starts starts(scene_, shapes_.slots());
    constexpr std::size_t ahead = 16;
    const bool fetches = scene_.is_large(); // otherwise all spheres are in the cache
    LeftSpheres spheres;
    std::array<std::uint32_t, LeftSpheres::size> slots{};
    for (std::size_t first = 0; first < count; first += LeftSpheres::size) {
        const std::size_t some = std::min(count - first, LeftSpheres::size);
        for (std::size_t k = 0; k < some; ++k) {
            const std::size_t i = first + k;
            if (fetches && i + 2 * ahead < count)
                starts.prefetch_slot(rays.origin_shape[i + 2 * ahead]);
            if (fetches && i + ahead < count) starts.prefetch_sphere(rays.origin_shape[i + ahead]);
            slots[k] = starts.find_sphere(rays, i, spheres, k);
        }
        const DepartureSides sides = kernels().find_sides(some, from(taken_, to + first), spheres,
                                                          Starts::rounding_in<Real>);
        for (std::size_t k = 0; k < some; ++k) {
            const std::size_t i = first + k, lane = to + i;
            const std::uint32_t of_limits = paths_.origin_bits[lane];
            const bool inside = (sides.inside >> k & 1) != 0;
            if (!is_ray(lane) && is_refused(rays, i))
                paths_.start_nowhere(lane, lane + 1);
            else if (!is_ray(lane) || slots[k] == no_slot ||
                     (!inside && (sides.outside >> k & 1) == 0) ||
                     !Starts::start_on_sphere(paths_, lane, rays, i, slots[k], inside))
                starts.start_on_any(paths_, lane, rays, i);
            paths_.origin_bits[lane] |= of_limits;
        }
    }
}

/// Replaces each invalid ray by a copy of a valid one, so that it does not destroy the property
/// that the valid rays share (Coherence). Does nothing if no ray is valid.
void StreamIntake::stand_in(std::size_t begin, std::size_t end) {
    std::size_t other = begin;
    while (other < end && !is_ray(other))
        ++other;
    if (other == end) return;
    for (std::size_t lane = begin; lane < end; ++lane)
        if (is_ray(lane))
            other = lane;
        else
            paths_.copy_ray(paths_, other, lane);
}

void StreamIntake::keep(const std::uint32_t* lanes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        paths_.copy_ray(paths_, lanes[k], k);
        for (double* const column : {taken_.unit, taken_.per_unit, taken_.t_limit})
            column[k] = column[lanes[k]];
    }
    paths_.count = count;
}

template <class Real>
LoneRay StreamIntake::lone(const RayStream<Real>& rays, std::size_t i, std::size_t lane) {
    if (is_apart(lane)) return alone(rays, i, lane);
    return limited(rays, i, lane, ray_of(paths_, lane), -std::ilogb(taken_.unit[lane]));
}

template <class Real>
LoneRay StreamIntake::alone(const RayStream<Real>& rays, std::size_t i, std::size_t lane) {
    if (rays.origin_shape != nullptr)
        Starts(scene_, shapes_.slots()).start(paths_, lane, rays, i);
    else
        paths_.start_nowhere(lane, lane + 1);
    int exponent = 0;
    const core::Ray<double> ray = scaled(ray_in_double(rays, i), exponent);
    return limited(rays, i, lane, ray, exponent);
}

/// Returns a ray, scaled by 2^-exponent, with its limits and the shapes that the lane's ray leaves.
template <class Real>
LoneRay StreamIntake::limited(const RayStream<Real>& rays, std::size_t i, std::size_t lane,
                              const core::Ray<double>& ray, int exponent) {
    const Limits limits = limits_of(rays, i);
    // Beyond all t that round to the limit. A crossing's t may be off by 2^-27 of itself.
    const double beyond = std::max(std::ldexp(limits.t_max * (1.0 + 0x1p-20) + 0x1p-149, exponent),
                                   std::numeric_limits<double>::min());
    return {ray,
            origin_surfaces_of(scene_, paths_, lane),
            -exponent,
            limits.t_min,
            limits.t_max,
            std::is_same_v<Real, float> || floats_,
            limits.t_max < static_cast<double>(std::numeric_limits<Real>::max())
                ? beyond
                : std::numeric_limits<double>::infinity()};
}

template RayStream<float> StreamIntake::take(const RayStream<float>&, std::size_t);
template RayStream<double> StreamIntake::take(const RayStream<double>&, std::size_t);
template LoneRay StreamIntake::lone(const RayStream<float>&, std::size_t, std::size_t);
template LoneRay StreamIntake::lone(const RayStream<double>&, std::size_t, std::size_t);
template LoneRay StreamIntake::alone(const RayStream<float>&, std::size_t, std::size_t);
template LoneRay StreamIntake::alone(const RayStream<double>&, std::size_t, std::size_t);

} // namespace raylane::simd
