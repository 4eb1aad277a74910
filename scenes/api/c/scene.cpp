#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace raylane;
using namespace raylane::c;

namespace {

/// `positions` holds three numbers for each of `count` centres.
template <class Number, class Positions>
raylane_status with_positions(const raylane_scene* scene, const Positions* positions,
                              std::size_t count, raylane_scene** moved) noexcept {
    return scene_of(moved, [&] {
        const auto* const centers =
            reinterpret_cast<const Vec3Of<Number>*>(span_of("positions", positions, count).data());
        return checked("scene", scene).scene.with_positions(std::span(centers, count));
    });
}

} // namespace

raylane_status raylane_build(raylane_builder* builder, raylane_scene** scene) {
    return scene_of(scene, [&] { return checked("builder", builder).builder.build(); });
}

void raylane_scene_release(raylane_scene* scene) {
    delete scene;
}

size_t raylane_shape_count(const raylane_scene* scene) {
    return scene != nullptr ? scene->scene.shape_count() : 0;
}

size_t raylane_material_count(const raylane_scene* scene) {
    return scene != nullptr ? scene->scene.material_count() : 0;
}

raylane_status raylane_scene_material(const raylane_scene* scene, uint32_t index,
                                      raylane_material* material) {
    return guarded([&] {
        Material found = checked("scene", scene).scene.material(index);
        checked("material", material) = kept_in_c(std::move(found));
    });
}

raylane_status raylane_scene_material_name(const raylane_scene* scene, uint32_t index, char* name,
                                           size_t size, size_t* length) {
    return guarded([&] {
        const std::string found = checked("scene", scene).scene.material_name(index);
        if (length != nullptr) *length = found.size();
        if (size == 0) return;
        const std::size_t copied = std::min(size - 1, found.size());
        std::copy_n(found.data(), copied, &checked("name", name));
        name[copied] = '\0';
    });
}

raylane_status raylane_scene_material_of(const raylane_scene* scene, uint32_t shape_id,
                                         uint32_t* material) {
    return guarded([&] {
        const MaterialIndex found = checked("scene", scene).scene.material_of(shape_id);
        checked("material", material) = found;
    });
}

raylane_status raylane_scene_solid_of(const raylane_scene* scene, uint32_t shape_id,
                                      uint32_t* solid) {
    return guarded([&] {
        const ShapeId found = checked("scene", scene).scene.solid_of(shape_id);
        checked("solid", solid) = found;
    });
}

void raylane_scene_bounds(const raylane_scene* scene, raylane_vec3* lower, raylane_vec3* upper) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    if (scene != nullptr) bounds = scene->scene.bounds();
    if (lower != nullptr) *lower = converted<raylane_vec3>(bounds.lower);
    if (upper != nullptr) *upper = converted<raylane_vec3>(bounds.upper);
}

raylane_status raylane_with_positions(const raylane_scene* scene, const raylane_vec3* positions,
                                      size_t count, raylane_scene** moved) {
    return with_positions<float>(scene, positions, count, moved);
}

raylane_status raylane_with_positions_doubles(const raylane_scene* scene, const double* positions,
                                              size_t count, raylane_scene** moved) {
    return with_positions<double>(scene, positions, count, moved);
}

raylane_settings raylane_scene_settings(const raylane_scene* scene) {
    return converted<raylane_settings>(scene != nullptr ? scene->scene.settings() : Settings{});
}

raylane_camera raylane_scene_camera(const raylane_scene* scene) {
    return converted<raylane_camera>(scene != nullptr ? scene->scene.camera() : Camera{});
}

raylane_fog raylane_scene_fog(const raylane_scene* scene) {
    return converted<raylane_fog>(scene != nullptr ? scene->scene.fog() : Fog{});
}

raylane_vec3 raylane_scene_background(const raylane_scene* scene) {
    return converted<raylane_vec3>(scene != nullptr ? scene->scene.background() : Color{});
}

raylane_status raylane_scene_lights(const raylane_scene* scene, raylane_light* lights, size_t size,
                                    size_t* count) {
    return guarded([&] {
        const std::vector<Light> found = checked("scene", scene).scene.lights();
        const std::size_t copied = std::min(size, found.size());
        for (raylane_light& to : span_of("lights", lights, copied))
            to = converted<raylane_light>(found[static_cast<std::size_t>(&to - lights)]);
        if (count != nullptr) *count = found.size();
    });
}
