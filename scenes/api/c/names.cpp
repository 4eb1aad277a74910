#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

/// Values that files know by name, and cameras.
using namespace raylane;
using namespace raylane::c;

namespace {

raylane_auto_camera to_c(const AutoCamera& camera) {
    return {static_cast<std::uint8_t>(camera.projection),
            converted<raylane_vec3>(camera.direction),
            converted<raylane_vec3>(camera.up),
            camera.field_of_view,
            camera.zoom,
            camera.depth_cue};
}

AutoCamera from_c(const raylane_auto_camera& camera) {
    return {static_cast<Projection>(camera.projection),
            converted<Vec3>(camera.direction),
            converted<Vec3>(camera.up),
            camera.field_of_view,
            camera.zoom,
            camera.depth_cue};
}

} // namespace

raylane_auto_camera raylane_default_auto_camera(void) {
    return to_c(AutoCamera{});
}

raylane_status raylane_material_preset(const char* name, raylane_material* material) {
    return guarded([&] {
        Material found = material_preset(&checked("name", name));
        checked("material", material) = kept_in_c(std::move(found));
    });
}

raylane_status raylane_catalogue_glass(const char* name, double* B, double* C) {
    return guarded([&] {
        const Sellmeier glass = catalogue_glass(&checked("name", name));
        std::copy(glass.B.begin(), glass.B.end(), &checked("B", B));
        std::copy(glass.C.begin(), glass.C.end(), &checked("C", C));
    });
}

raylane_status raylane_named_view(const char* name, raylane_auto_camera* camera) {
    return guarded([&] { checked("camera", camera) = to_c(named_view(&checked("name", name))); });
}

raylane_status raylane_color_from_srgb(const char* text, raylane_vec3* color) {
    return guarded([&] {
        checked("color", color) = converted<raylane_vec3>(color_from_srgb(&checked("text", text)));
    });
}

raylane_status raylane_aligned_box(raylane_double_vec3 lower, raylane_double_vec3 upper,
                                   raylane_double_box* box) {
    return guarded([&] {
        const auto corner = [](const raylane_double_vec3& v) {
            return Vec3Of<double>{v.x, v.y, v.z};
        };
        checked("box", box) =
            std::bit_cast<raylane_double_box>(aligned_box(corner(lower), corner(upper)));
    });
}

raylane_status raylane_set_auto_camera(raylane_builder* builder,
                                       const raylane_auto_camera* camera) {
    return guarded([&] {
        std::optional<AutoCamera>& to = checked("builder", builder).builder.auto_camera;
        to.reset();
        if (camera != nullptr) to = from_c(*camera);
    });
}

raylane_status raylane_set_camera_lights(raylane_builder* builder, int lights) {
    return guarded([&] { checked("builder", builder).builder.camera_lights = lights != 0; });
}

raylane_status raylane_seen_by(const raylane_scene* scene, const raylane_camera* camera,
                               raylane_scene** seen) {
    return handle_of("seen", seen, [&] {
        return checked("scene", scene).scene.seen_by(converted<Camera>(checked("camera", camera)));
    });
}

raylane_status raylane_camera_on_all(const raylane_scene* scene, raylane_vec3 direction,
                                     float aspect, raylane_camera* camera) {
    return guarded([&] {
        const Camera found =
            checked("scene", scene).scene.camera_on_all(converted<Vec3>(direction), aspect);
        checked("camera", camera) = converted<raylane_camera>(found);
    });
}

raylane_status raylane_camera_rays(const raylane_camera* camera, int width, int height,
                                   double* origins, double* directions) {
    return guarded([&] {
        static_cast<void>(checked("origins", origins));
        static_cast<void>(checked("directions", directions));
        const PixelRays rays =
            camera_rays(converted<Camera>(checked("camera", camera)), width, height);
        std::copy(rays.origins.begin(), rays.origins.end(), origins);
        std::copy(rays.directions.begin(), rays.directions.end(), directions);
    });
}
