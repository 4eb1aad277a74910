#include "simd/wavefront/coherence.hpp"

#include "core/numbers/vector.hpp"

#include <cmath>

namespace raylane::simd {

Coherence coherence_of(const CameraView& camera) {
    Coherence coherence{};
    for (int axis = 0; axis < 3; ++axis)
        coherence.apex[axis] = static_cast<float>(camera.from[axis]);
    coherence.parallel = camera.orthographic;
    return coherence;
}

Coherence coherence_of(const LightView& light) {
    Coherence coherence{};
    for (int axis = 0; axis < 3; ++axis)
        coherence.apex[axis] = static_cast<float>(light.position[axis]);
    coherence.converging = light.is_point;
    coherence.parallel = !light.is_point;
    return coherence;
}

Coherence coherence_off_mirror(const CameraView& camera, const SceneData& scene,
                               const Surfaces& surfaces, const std::uint32_t* order,
                               const std::uint32_t* slots, const SpawnedRays& reflected) {
    if (camera.orthographic || reflected.count == 0) return neighbours;
    const auto vector_at = [](double* const(&columns)[3], std::size_t position) {
        return core::Vec3d(columns[0][position], columns[1][position], columns[2][position]);
    };
    const auto first = static_cast<std::size_t>(reflected.parent[0]);
    const core::Kind kind = scene.record_of(slots[order[first]]).kind;
    if (!core::traits_of(kind).flat_faces) return neighbours;
    const core::Vec3d from(camera.from[0], camera.from[1], camera.from[2]);
    const core::Vec3d normal = vector_at(surfaces.normal, first);
    const double height = core::dot(vector_at(surfaces.point, first) - from, normal);
    for (std::size_t k = 0; k < reflected.count; ++k) {
        const auto position = static_cast<std::size_t>(reflected.parent[k]);
        if (vector_at(surfaces.normal, position) != normal) return neighbours;
        // In one plane, with an error below a frustum's tolerance for rounding its rays to float.
        const core::Vec3d point = vector_at(surfaces.point, position);
        const double size = std::abs(point.x) + std::abs(point.y) + std::abs(point.z);
        if (!(std::abs(core::dot(point - from, normal) - height) <= 0x1p-28 * size))
            return neighbours;
    }
    const core::Vec3d image = from + 2.0 * height * normal;
    Coherence coherence{};
    for (int axis = 0; axis < 3; ++axis)
        coherence.apex[axis] = static_cast<float>(image[axis]);
    coherence.beyond = true;
    return coherence;
}

} // namespace raylane::simd
