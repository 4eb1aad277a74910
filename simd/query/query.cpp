#include "simd/query/query.hpp"

#include "core/numbers/infinity.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::simd {

void Query::take_from(Arena& arena, std::size_t capacity) {
    search_.take_from(arena, capacity);
    certifier_.take_from(arena, capacity);
    hits_.take_from(arena, capacity, scene_.smooth());
    first_ = arena.take<float>(capacity);
    second_ = arena.take<float>(capacity);
}

void Query::nearest(const Paths& paths, const Coherence* coherence, EngineCounters& counters,
                    const double* t_limit) {
    const std::size_t padded = (paths.count + 15) / 16 * 16;
    const Candidates candidates{first_, second_, hits_.slot};
    std::fill_n(candidates.second, padded, core::infinity<float>);
    std::fill_n(candidates.slot, padded, no_slot);

    const bool few = tracing_.method().nearest_of_few != nullptr && !scene_.has_tree();
    if (!few) search_.take(paths.columns());
    if (t_limit == nullptr)
        std::fill_n(candidates.first, padded, core::infinity<float>);
    else // like an unknown candidate there
        for (std::size_t lane = 0; lane < paths.count; ++lane)
            first_[lane] = rounded_up(search_.t_limit(lane, t_limit[lane]));
    certifier_.find_own_exits(paths, search_, candidates);
    if (few) return certifier_.find_of_few(paths, candidates, hits_, counters);
    search_.nearest(coherence, candidates, counters);
    certifier_.certify(paths, search_, candidates, hits_, counters);
}

bool Query::is_apart(const Paths& paths, std::size_t lane) const {
    if (!tracing_.certifies()) return true;
    if (certifier_.was_refined(lane)) return false;
    const double second = static_cast<double>(second_[lane]) + search_.approach().before(lane);
    return second > hits_.t[lane] + error_of_point(paths, lane);
}

double Query::error_of_point(const Paths& paths, std::size_t lane) const {
    double reach = hits_.t[lane];
    for (int axis = 0; axis < 3; ++axis)
        reach = std::max(reach, std::abs(paths.origin[axis][lane]));
    return 0x1p-44 * reach; // several times the rounding errors of a point, its t and its ray
}

/// The difference between a distance and the length by which its ray was moved may have an error of
/// little more than half an ulp of itself. The kernels tolerate that.
void Query::occluded(const RayColumns& rays, const double* distance, std::uint8_t* state,
                     const Coherence* coherence, EngineCounters& counters) {
    search_.take(rays);
    for (std::size_t lane = 0; lane < rays.count; ++lane)
        first_[lane] = search_.t_limit(lane, distance[lane]);
    search_.occluded(coherence, {first_, state}, distance, counters);
    for (std::size_t lane = 0; lane < rays.count; ++lane)
        if (first_[lane] < min_length && first_[lane] >= 0.0F) state[lane] = doubtful;
    if (!search_.approach().any()) return;
    for (std::size_t lane = 0; lane < rays.count; ++lane)
        if (state[lane] == blocked && search_.approach().before(lane) > 0.25 * distance[lane])
            state[lane] = doubtful;
}

} // namespace raylane::simd
