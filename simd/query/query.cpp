#include "simd/query/query.hpp"

#include <algorithm>
#include <limits>

namespace raylane::simd {

void Query::take_from(Arena& arena, std::size_t capacity) {
    search_.take_from(arena, capacity);
    certifier_.take_from(arena, capacity);
    hits_.take_from(arena, capacity, scene_.smooth());
    first_ = arena.take<float>(capacity);
    second_ = arena.take<float>(capacity);
}

void Query::nearest(const Paths& paths, const Coherence* coherence, EngineCounters& counters) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::size_t padded = (paths.count + 15) / 16 * 16;
    const Candidates candidates{first_, second_, hits_.slot};
    std::fill_n(candidates.first, padded, infinity);
    std::fill_n(candidates.second, padded, infinity);
    std::fill_n(candidates.slot, padded, no_slot);

    search_.take(paths.columns());
    certifier_.find_own_exits(paths, candidates);
    search_.nearest(coherence, candidates, counters);
    certifier_.certify(paths, search_, candidates, hits_, counters);
}

/// A distance, less what lies before where a ray has been brought, may be off by little more than
/// half an ulp of itself, which is what kernels grant it.
void Query::occluded(const RayColumns& rays, const double* distance, std::uint8_t* state,
                     const Coherence* coherence, EngineCounters& counters) {
    search_.take(rays);
    for (std::size_t lane = 0; lane < rays.count; ++lane)
        first_[lane] = search_.t_most(lane, distance[lane]);
    search_.occluded(coherence, {first_, state}, counters);
    if (!search_.approach().any()) return;
    for (std::size_t lane = 0; lane < rays.count; ++lane)
        if (state[lane] == blocked && search_.approach().before(lane) > 0.25 * distance[lane])
            state[lane] = doubtful;
}

} // namespace raylane::simd
