#pragma once

#include "simd/query/scene_data.hpp"
#include "simd/units/shade_kernels.hpp"
#include "simd/units/trace_kernels.hpp"

namespace raylane::simd {

/// Return the coherence of a camera's rays, and of rays to a light.
Coherence coherence_of(const CameraView& camera);
Coherence coherence_of(const LightView& light);

/// Returns the coherence of camera rays that have been reflected. If one flat shape reflected them,
/// they seem to come from the camera's mirror image; otherwise they are neighbours. `surfaces` and
/// `order` (lanes that have hit them) are by position, to which the rays' parents refer. `slots`
/// are by lane.
Coherence coherence_off_mirror(const CameraView& camera, const SceneData& scene,
                               const Surfaces& surfaces, const std::uint32_t* order,
                               const std::uint32_t* slots, const SpawnedRays& reflected);

} // namespace raylane::simd
