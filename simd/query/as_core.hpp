#pragma once

#include "core/reference/origin_surfaces.hpp"
#include "simd/query/hits.hpp"
#include "simd/query/scene_data.hpp"

namespace raylane::simd {

/// Returns the exact ray of a lane.
template <class Real = double>
core::Ray<Real> ray_of(const Paths& paths, std::size_t lane) {
    const auto vector = [lane](double* const(&columns)[3]) {
        return core::convert<Real>(
            core::Vec3d(columns[0][lane], columns[1][lane], columns[2][lane]));
    };
    return {vector(paths.origin),
            vector(paths.stand_for_others() ? paths.exact_direction : paths.direction)};
}

/// Returns the hit of a lane. Its t is per unit of the exact direction.
inline core::Hit<double> hit_of(const SceneData& scene, const Paths& paths, const Hits& hits,
                                std::size_t lane) {
    core::Hit<double> hit;
    const std::uint32_t slot = hits.slot[lane];
    const SceneData::ShapeRecord shape = scene.record_of(slot);
    const double length = paths.length_of(lane);
    hit.t = hits.t[lane] / length;
    hit.error = hits.error[lane] / length;
    if (paths.stand_for_others()) hit.error = hit.error * (1.0 + 0x1p-50) + 0x1p-50 * hit.t;
    hit.shape = shape.id;
    hit.face = static_cast<core::Face>(hits.hit[lane] & hit_face);
    hit.entering = (hits.hit[lane] & hit_entering) != 0;
    hit.kind = shape.kind;
    hit.place = scene.place_of(slot);
    hit.reversed = shape.reversed;
    return hit;
}

/// Returns the surfaces that a lane's ray leaves.
template <class Real = double>
core::OriginSurfaces<Real> origin_surfaces_of(const SceneData& scene, const Paths& paths,
                                              std::size_t lane) {
    const std::uint32_t slot = paths.origin_slot[lane];
    if (slot == no_slot) return {};
    core::Hit<Real> hit;
    const SceneData::ShapeRecord shape = scene.record_of(slot);
    hit.shape = shape.id;
    hit.face = static_cast<core::Face>(paths.origin_bits[lane] & origin_face);
    hit.kind = shape.kind;
    hit.place = scene.place_of(slot);
    hit.reversed = shape.reversed;
    const bool inward = (paths.origin_bits[lane] & origin_inward) != 0;
    const core::Contact<Real> surface{hit,
                                      {paths.origin_first[lane], paths.origin_last[lane]},
                                      shape.material,
                                      core::Vec3<Real>(0),
                                      inward,
                                      inward,
                                      scene.solid_with(shape.id)};
    return core::OriginSurfaces<Real>(std::span(&surface, 1));
}

} // namespace raylane::simd
