#include "simd/query/tie_breaker.hpp"

#include "simd/query/as_core.hpp"

#include <cmath>
#include <limits>

namespace raylane::simd {

TieBreaker::TieBreaker(const SceneData& scene, const Tracing& tracing) : scene_(scene) {
    if (core::is_single(tracing.precision))
        in_float_.emplace(scene.scene(), core::Search::hierarchy, tracing.precision);
    else
        in_double_.emplace(scene.scene(), core::Search::hierarchy, tracing.precision);
}

std::uint32_t TieBreaker::first_at(float t, const Paths& paths, std::size_t lane,
                                   std::uint32_t found) {
    core::Hit<float> first;
    in_float_->each(ray_of<float>(paths, lane), origin_surfaces_of<float>(scene_, paths, lane),
                    std::nextafter(t, std::numeric_limits<float>::infinity()),
                    [&](const core::Hit<float>& hit) {
                        if (hit.t == t && (!first.any() || hit.precedes(first))) first = hit;
                        return true;
                    });
    return first.any() ? scene_.slot_of(first.kind, first.place) : found;
}

TieBreaker::First TieBreaker::first_of(const Paths& paths, std::size_t lane) {
    const core::Encounter<double> encounter =
        in_double_->nearest(ray_of(paths, lane), origin_surfaces_of(scene_, paths, lane),
                            [](const core::Hit<double>&) { return true; });
    return {encounter.hit, encounter.contacts.size() <= 1};
}

} // namespace raylane::simd
