#include "scenes/tool/window/mouse.hpp"

#include "core/numbers/more_functions.hpp"
#include "core/scene/camera_rays.hpp"
#include "core/scene/field_of_view.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "simd/stream/stream_tracer.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double highest = 89.0;

/// Returns the vector from the point that the camera looks at to the camera.
Vec3d arm_of(const core::Camera& camera) {
    return core::convert<double>(camera.from) - core::convert<double>(camera.at);
}

Vec3d right_of(const core::Camera& camera) {
    return core::normalized(core::cross(core::convert<double>(camera.up), arm_of(camera)));
}

double image_height(const core::Camera& camera) {
    if (camera.projection == core::Projection::orthographic)
        return static_cast<double>(camera.height);
    return 2.0 * core::length(arm_of(camera)) * core::slope_of_view(camera.field_of_view);
}

} // namespace

Orbit::Orbit(core::View start) : start_(std::move(start)), axis_(start_.camera.up) {
    const double sine = core::dot(core::normalized(arm_of(start_.camera)),
                                  core::normalized(core::convert<double>(axis_)));
    elevation_ = core::asin(std::clamp(sine, -1.0, 1.0)) * degrees;
}

core::View Orbit::view() const {
    const Vec3f right = core::convert<float>(right_of(start_.camera));
    return core::turned(core::turned(start_, right, -upwards_), axis_, turn_);
}

void Orbit::turn(double to_the_right, double upwards) {
    turn_ = std::fmod(turn_ + to_the_right, 360.0);
    const double lowest = std::min(-highest - elevation_, 0.0);
    upwards_ = std::clamp(upwards_ + upwards, lowest, std::max(highest - elevation_, 0.0));
}

void Orbit::pan(double to_the_right, double upwards) {
    const core::Camera now = view().camera;
    const Vec3d right = right_of(now), up = core::normalized(core::cross(arm_of(now), right));
    const Vec3d step = image_height(now) * (to_the_right * right + upwards * up);
    const auto moved = [&](Vec3f& point) {
        point = core::convert<float>(core::convert<double>(point) + step);
    };
    moved(start_.camera.from);
    moved(start_.camera.at);
    for (core::Light& light : start_.lights)
        moved(light.position);
}

void Orbit::zoom(double times) {
    core::Camera& camera = start_.camera;
    if (camera.projection == core::Projection::orthographic) {
        camera.height = static_cast<float>(static_cast<double>(camera.height) / times);
        return;
    }
    const Vec3d arm = arm_of(camera);
    camera.from = core::convert<float>(core::convert<double>(camera.at) + 1.0 / times * arm);
    // Linear fog keeps its place at the point that the camera looks at.
    const auto nearer = static_cast<float>(core::length(arm) * (1.0 - 1.0 / times));
    if (start_.fog.kind == core::FogKind::linear) {
        start_.fog.start = std::max(start_.fog.start - nearer, 0.0F);
        start_.fog.end =
            std::max(start_.fog.end - nearer, std::nextafter(start_.fog.start, INFINITY));
    }
}

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
