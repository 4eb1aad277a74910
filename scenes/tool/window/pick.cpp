#include "scenes/tool/window/pick.hpp"

#include "core/scene/camera_rays.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "simd/stream/stream_tracer.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace raylane::scenes {

namespace {

std::string kind_of_shape(const core::Scene& scene, core::ShapeId wanted) {
    if (scene.material_indices().stored_index(wanted) == core::MaterialIndices::no_index) {
        const core::Copies::Copy copy = scene.copies()->copy_with(wanted);
        return kind_of_shape(*copy.set.prototype, wanted - core::Copies::first_id_of(copy));
    }
    std::string kind;
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        core::for_each_shape(table, [&](const auto&, core::ShapeId id) {
            if (id == wanted) kind = core::name_of(core::kind_of<Shape>);
        });
    });
    return kind;
}

/// Returns "3", or "3 (glass)".
std::string material_text(const core::Scene& scene, core::ShapeId shape) {
    const core::MaterialIndex material = scene.material_index_of(shape);
    const std::string_view name = scene.material_name(material);
    const std::string number = std::to_string(material);
    return name.empty() ? number : number + " (" + printable(name) + ")";
}

std::string place_text(const core::Vec3d& place) {
    char text[96];
    std::snprintf(text, sizeof text, "%.9g %.9g %.9g", place.x, place.y, place.z);
    return text;
}

} // namespace

std::string what_is_at(const core::Scene& scene, const core::Settings& settings, int x, int y,
                       const Legend& legend) {
    core::Settings plain = settings;
    plain.grid = 1;
    plain.samples = core::SamplePattern::regular;
    plain.filter = core::PixelFilter::box;
    core::Camera camera = scene.camera();
    camera.lens_radius = 0.0F;
    const core::Ray<double> ray = core::CameraRays<double>(camera, plain).ray(x, y, 0);
    simd::RayStream<double> rays;
    rays.count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = &ray.origin[axis];
        rays.direction[axis] = &ray.direction[axis];
    }
    core::ShapeId shape = core::no_shape;
    double t = 0.0;
    simd::HitStream hits;
    hits.shape = &shape;
    hits.t_double = &t;
    simd::StreamTracer(scene, 1).nearest(rays, hits);
    if (shape == core::no_shape) return "background";
    char distance[64];
    std::snprintf(distance, sizeof distance, "%.17g", t);
    std::string atoms = legend.of(shape);
    if (!atoms.empty()) atoms += ": ";
    return atoms + kind_of_shape(scene, shape) + " " + std::to_string(shape) + " of material " +
           material_text(scene, shape) + ", at " + place_text(ray.origin + t * ray.direction) +
           ", " + distance + " away (rounded to nearest double)";
}

std::string camera_text(const core::Camera& camera) {
    const auto list = [](const core::Vec3f& v) {
        return nlohmann::ordered_json{as_printed(v.x), as_printed(v.y), as_printed(v.z)};
    };
    nlohmann::ordered_json json = {
        {"from", list(camera.from)}, {"at", list(camera.at)}, {"up", list(camera.up)}};
    if (camera.projection == core::Projection::orthographic) {
        json["type"] = "orthographic";
        json["height"] = as_printed(camera.height);
    } else {
        json["field_of_view"] = as_printed(camera.field_of_view);
    }
    return "\"camera\": " + json.dump();
}

} // namespace raylane::scenes
