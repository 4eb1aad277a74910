#pragma once

#include "core/counters.hpp"
#include "core/reference/departure.hpp"
#include "simd/wavefront/paths.hpp"
#include "simd/wavefront/scene_data.hpp"

namespace raylane::simd {

/// How core sees the ray of a lane, and what it leaves.
template <class Real = double>
core::Ray<Real> ray_of(const Paths& paths, std::size_t lane) {
    const auto vector = [lane](double* const(&columns)[3]) {
        return core::convert<Real>(
            core::Vec3d(columns[0][lane], columns[1][lane], columns[2][lane]));
    };
    return {vector(paths.origin), vector(paths.direction)};
}

template <class Real = double>
core::Departure<Real> departure_of(const SceneData& scene, const Paths& paths, std::size_t lane) {
    core::Departure<Real> departure;
    const std::uint32_t slot = paths.departed_slot[lane];
    if (slot == no_slot) return departure;
    core::Hit<Real> hit;
    const SceneData::Occupant shape = scene.occupant_of(slot);
    hit.shape = shape.id;
    hit.face = static_cast<core::Face>(paths.departure[lane] & departure_face);
    hit.kind = shape.kind;
    hit.slot = scene.place_of(slot);
    const bool inward = (paths.departure[lane] & departure_inward) != 0;
    departure.add({hit,
                   {paths.departed_first[lane], paths.departed_last[lane]},
                   core::Vec3<Real>(0),
                   inward,
                   inward});
    return departure;
}

/// What a kernel has done, among what core counts.
inline void count(const TraceCounters& traced, core::Counters& counters) {
    counters.nodes += traced.nodes;
    counters.shapes += traced.shapes;
    counters.one_by_one += traced.one_by_one;
    counters.in_frusta += traced.in_frusta;
    counters.in_streams += traced.in_streams;
    counters.in_flight += traced.in_flight;
}

} // namespace raylane::simd
