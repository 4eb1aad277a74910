#pragma once

#include "simd/scene_data.hpp"
#include "simd/shade_kernels.hpp"
#include "simd/trace_kernels.hpp"

namespace raylane::simd {

/// Coherence of a camera's rays, and of those to a light.
Coherence coherence_of(const CameraView& camera);
Coherence coherence_of(const LightView& light);

/// Rays from the camera that one flat shape has reflected seem to come from its mirror image. Of
/// others it says that they are neighbours. `surfaces` and `order`, the lanes that have hit them,
/// are by position, which is what the rays' parents are; `slots` are by lane.
Coherence coherence_off_mirror(const CameraView& camera, const SceneData& scene,
                               const Surfaces& surfaces, const std::uint32_t* order,
                               const std::uint32_t* slots, const SpawnedRays& reflected);

} // namespace raylane::simd
