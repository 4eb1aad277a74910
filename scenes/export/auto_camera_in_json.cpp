#include "core/scene/fields.hpp"
#include "core/scene/validate.hpp"
#include "scenes/export/json_parts.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

namespace raylane::scenes {

namespace {

/// Compares all bits: zeros have signs.
bool is_same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool is_same(const core::Vec3f& a, const core::Vec3f& b) {
    return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
}

template <class Enum>
requires std::is_enum_v<Enum>
bool is_same(Enum a, Enum b) {
    return a == b;
}

/// Compares only the numbers that a file holds for the struct's kind.
template <class Of>
bool is_same_in_files(const Of& a, const Of& b) {
    bool same = true;
    core::fields::for_each_field(
        [&, kind = core::fields::kind_of(a)](const core::fields::Field& field, const auto& one,
                                             const auto& other) {
            if ((field.use.used & kind) != 0) same = same && is_same(one, other);
        },
        a, b);
    return same;
}

/// Returns true if scenes/formats/json/surroundings.cpp accepts the fit.
bool is_read(const core::FitCamera& fit_camera) {
    try {
        core::validate(core::AutoCamera{.fit_camera = fit_camera});
        return true;
    } catch (const core::InvalidValue&) {
        return false;
    }
}

/// Returns nothing if the camera is to find its place by the shapes, and no shape has bounds.
std::optional<core::View> found_by(const core::Scene& scene, const core::AutoCamera& auto_camera) {
    core::Frame frame = core::empty_frame(scene, auto_camera, scene.settings());
    core::include_shapes(scene, frame);
    if (auto_camera.fit_camera && frame.empty()) return std::nullopt;
    return core::staged(scene, auto_camera, frame);
}

} // namespace

core::AutoCamera auto_camera_in_json(const core::Scene& scene) {
    core::AutoCamera said = scene.auto_camera();
    said.turning = false;
    std::optional<core::View> view;
    if (said.fit_camera && is_read(*said.fit_camera)) {
        // The file omits the angle of an orthographic camera, so the reader has the default angle.
        if (said.fit_camera->projection == core::Projection::orthographic)
            said.fit_camera->field_of_view = core::FitCamera{}.field_of_view;
        view = found_by(scene, said);
    }
    if (!view || !is_same_in_files(view->camera, scene.camera())) {
        said.fit_camera.reset();
        if (said.lights) view = found_by(scene, said);
    }
    const bool is_cue_read = said.fit_camera && said.depth_cue <= 0.99F;
    if (!is_cue_read || !is_same_in_files(view->fog, scene.fog())) said.depth_cue = 0.0F;
    const auto same = [](const core::Light& a, const core::Light& b) {
        return is_same_in_files(a, b);
    };
    const auto brought = std::span(scene.lights()).subspan(scene.own_light_count());
    said.lights = said.lights && std::equal(view->lights.begin(), view->lights.end(),
                                            brought.begin(), brought.end(), same);
    return said;
}

Differences lost_auto_camera(const core::AutoCamera& auto_camera, const core::AutoCamera& said) {
    Differences lost;
    if (auto_camera.fit_camera && !said.fit_camera) lost.insert("automatic camera");
    if (auto_camera.lights && !said.lights) lost.insert("automatic lights");
    if (auto_camera.depth_cue > 0.0F && !(said.depth_cue > 0.0F)) lost.insert("automatic fog");
    return lost;
}

} // namespace raylane::scenes
