#include "simd/wavefront/tie_breaker.hpp"

#include "simd/wavefront/as_core.hpp"

#include <cmath>
#include <limits>

namespace raylane::simd {

std::uint32_t TieBreaker::first_at(float t, const Paths& paths, std::size_t lane,
                                   std::uint32_t found) {
    core::Hit<float> first;
    searcher_.each(ray_of<float>(paths, lane), departure_of<float>(scene_, paths, lane),
                   std::nextafter(t, std::numeric_limits<float>::infinity()),
                   [&](const core::Hit<float>& hit) {
                       if (hit.t == t && (!first.any() || hit.precedes(first))) first = hit;
                       return true;
                   });
    return first.any() ? scene_.slot_of(first.kind, first.slot) : found;
}

} // namespace raylane::simd
