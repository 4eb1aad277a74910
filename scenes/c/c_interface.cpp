#include "raylane/raylane.h"
#include "raylane/raylane.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

struct raylane_builder {
    raylane::SceneBuilder builder;
};
struct raylane_scene {
    raylane::Scene scene;
};
struct raylane_tracer {
    raylane::Tracer tracer;
};

namespace {

using namespace raylane;

thread_local std::string error_text; // NOLINT: what C has for an exception's text

/// Keeps the text. Without the memory for it there is a shorter one.
raylane_status failed(raylane_status status, const char* text) noexcept {
    try {
        error_text = text;
    } catch (...) {
        error_text.clear();
    }
    return status;
}

/// Calls it, and turns what it throws into what C understands.
template <class Call>
raylane_status guarded(const Call& call) noexcept {
    try {
        if constexpr (std::is_void_v<decltype(call())>) {
            call();
            return RAYLANE_OK;
        } else {
            return call();
        }
    } catch (const InvalidValue& error) {
        return failed(RAYLANE_INVALID_VALUE, error.what());
    } catch (const BadInput& error) {
        return failed(RAYLANE_BAD_INPUT, error.what());
    } catch (const SystemRefused& error) {
        return failed(RAYLANE_SYSTEM_REFUSED, error.what());
    } catch (const std::bad_alloc&) {
        return failed(RAYLANE_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return failed(RAYLANE_UNKNOWN, error.what());
    } catch (...) {
        return failed(RAYLANE_UNKNOWN, "unknown");
    }
}

/// What a pointer points to, which must be there.
template <class Value>
Value& checked(const char* name, Value* pointer) {
    if (pointer == nullptr) throw InvalidValue(name, "must not be NULL");
    return *pointer;
}

Vec3 from_c(const raylane_vec3& v) {
    return {v.x, v.y, v.z};
}
raylane_vec3 to_c(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Enumerators have the same numbers; which are none is for the library to say.
template <class Enum>
Enum enum_from(std::uint8_t number) {
    return static_cast<Enum>(number);
}
template <class Enum>
std::uint8_t number_of(Enum value) {
    return static_cast<std::uint8_t>(value);
}
/// One that C has as an int.
template <class Enum>
Enum enum_from_int(const char* name, int number) {
    if (number < 0 || number > 255)
        throw InvalidValue(name, "must be one of its enumerators, got " + std::to_string(number));
    return static_cast<Enum>(number);
}

Material from_c(const raylane_material& m) {
    Material material;
    material.pattern.kind = enum_from<PatternKind>(m.pattern.kind);
    for (int i = 0; i < 2; ++i)
        material.pattern.colors[i] = from_c(m.pattern.colors[i]);
    material.pattern.size = m.pattern.size;
    material.pattern.axes = m.pattern.axes;
    material.pattern.direction = from_c(m.pattern.direction);
    material.pattern.from = from_c(m.pattern.from);
    material.pattern.to = from_c(m.pattern.to);
    material.ambient = m.ambient;
    material.diffuse = m.diffuse;
    material.specular = m.specular;
    material.exponent = m.exponent;
    material.reflection = enum_from<Reflection>(m.reflection);
    material.reflectivity = m.reflectivity;
    material.transmission = m.transmission;
    material.index = m.index;
    material.absorption = from_c(m.absorption);
    material.visible = enum_from<Visible>(m.visible);
    material.opacity = m.opacity;
    return material;
}

Light from_c(const raylane_light& light) {
    return {enum_from<LightKind>(light.kind),
            from_c(light.position),
            from_c(light.direction),
            from_c(light.color),
            light.radius,
            from_c(light.edge_u),
            from_c(light.edge_v),
            from_c(light.ground),
            light.reach};
}

Fog from_c(const raylane_fog& fog) {
    return {enum_from<FogKind>(fog.kind), from_c(fog.color), fog.start, fog.end, fog.density};
}

Camera from_c(const raylane_camera& camera) {
    return {enum_from<Projection>(camera.projection),
            from_c(camera.from),
            from_c(camera.at),
            from_c(camera.up),
            camera.field_of_view,
            camera.height,
            camera.lens_radius,
            camera.focus_distance};
}

Settings from_c(const raylane_settings& s) {
    Settings settings;
    settings.width = s.width;
    settings.height = s.height;
    settings.grid = s.grid;
    settings.samples = enum_from<SamplePattern>(s.samples);
    settings.transfer = enum_from<Transfer>(s.transfer);
    settings.max_depth = s.max_depth;
    settings.max_see_through = s.max_see_through;
    settings.min_weight = s.min_weight;
    settings.quality = s.quality;
    settings.filter = enum_from<PixelFilter>(s.filter);
    settings.light_samples = s.light_samples;
    settings.outline = {s.outline.width, from_c(s.outline.color), s.outline.creases};
    return settings;
}

raylane_settings to_c(const Settings& s) {
    return {s.width,
            s.height,
            s.grid,
            number_of(s.samples),
            number_of(s.transfer),
            s.max_depth,
            s.min_weight,
            s.quality,
            number_of(s.filter),
            s.light_samples,
            s.max_see_through,
            {s.outline.width, to_c(s.outline.color), s.outline.creases}};
}

raylane_progress to_c(const Progress& progress) {
    const Tile& tile = progress.tile;
    return {progress.pixels, progress.total_pixels, progress.rays, tile.x,           tile.y,
            tile.width,      tile.height,           tile.rgb,      tile.floats_a_row};
}

/// Adds shapes that have the same floats in the same order.
template <class Shape, class CShape>
raylane_status add(raylane_builder* builder, const CShape* shapes, std::size_t count,
                   std::uint32_t material, std::uint32_t* first) noexcept {
    return guarded([&] {
        SceneBuilder& to = checked("builder", builder).builder;
        if (count != 0) static_cast<void>(checked("shapes", shapes));
        if (first != nullptr) *first = static_cast<std::uint32_t>(to.shape_count());
        for (std::size_t i = 0; i < count; ++i)
            try {
                to.add(std::bit_cast<Shape>(shapes[i]), material);
            } catch (const InvalidValue& error) {
                std::string field = std::to_string(i);
                if (!error.field.empty()) field.append("/").append(error.field);
                throw InvalidValue(field, error.expectation);
            }
    });
}

template <class Value>
std::span<Value> span_of(Value* values, std::size_t count) {
    return values == nullptr ? std::span<Value>() : std::span<Value>(values, count);
}

/// The arrays of rays or hits that must be there: without them there are no rays to speak of.
template <class Value>
std::span<Value> span_of(const char* name, Value* values, std::size_t count) {
    if (count == 0) return {};
    return {&checked(name, values), count};
}

template <class Real, class CRays>
BasicRaySpan<Real> rays_from(const CRays* from) {
    const CRays& rays = checked("rays", from);
    const std::size_t n = rays.count;
    return {span_of("origin_x", rays.origin_x, n),
            span_of("origin_y", rays.origin_y, n),
            span_of("origin_z", rays.origin_z, n),
            span_of("direction_x", rays.direction_x, n),
            span_of("direction_y", rays.direction_y, n),
            span_of("direction_z", rays.direction_z, n),
            span_of(rays.t_min, n),
            span_of(rays.t_max, n),
            span_of(rays.origin_shape, n),
            span_of(rays.origin_face, n),
            span_of(rays.origin_inward, n)};
}

template <class Real, class CRays>
raylane_status intersect(const raylane_tracer* tracer, const CRays* rays,
                         const raylane_hits* hits) noexcept {
    return guarded([&] {
        const BasicRaySpan<Real> asked = rays_from<Real>(rays);
        const raylane_hits& to = checked("hits", hits);
        const std::size_t n = rays->count;
        checked("tracer", tracer)
            .tracer.intersect(asked, HitSpan{span_of(to.t, n), span_of(to.normal_x, n),
                                             span_of(to.normal_y, n), span_of(to.normal_z, n),
                                             span_of(to.shape, n), span_of(to.entering, n),
                                             span_of(to.face, n), span_of(to.t_double, n)});
    });
}

template <class Real, class CRays>
raylane_status occluded(const raylane_tracer* tracer, const CRays* rays,
                        std::uint8_t* result) noexcept {
    return guarded([&] {
        const BasicRaySpan<Real> asked = rays_from<Real>(rays);
        checked("tracer", tracer).tracer.occluded(asked, span_of("occluded", result, rays->count));
    });
}

/// A scene that `make` makes, as a handle.
template <class Make>
raylane_status scene_of(raylane_scene** scene, const Make& make) noexcept {
    return guarded([&] {
        raylane_scene*& to = checked("scene", scene);
        to = nullptr;
        to = std::make_unique<raylane_scene>(raylane_scene{make()}).release();
    });
}

} // namespace

const char* raylane_version(void) {
    return version();
}

const char* raylane_error_text(void) {
    return error_text.c_str();
}

raylane_material raylane_default_material(void) {
    const Material m;
    return {{number_of(m.pattern.kind),
             {to_c(m.pattern.colors[0]), to_c(m.pattern.colors[1])},
             m.pattern.size,
             m.pattern.axes,
             to_c(m.pattern.direction),
             to_c(m.pattern.from),
             to_c(m.pattern.to)},
            m.ambient,
            m.diffuse,
            m.specular,
            m.exponent,
            number_of(m.reflection),
            m.reflectivity,
            m.transmission,
            m.index,
            to_c(m.absorption),
            number_of(m.visible),
            m.opacity};
}

raylane_light raylane_default_light(void) {
    const Light light;
    return {number_of(light.kind), to_c(light.position), to_c(light.direction),
            to_c(light.color),     light.radius,         to_c(light.edge_u),
            to_c(light.edge_v),    to_c(light.ground),   light.reach};
}

raylane_fog raylane_default_fog(void) {
    const Fog fog;
    return {number_of(fog.kind), to_c(fog.color), fog.start, fog.end, fog.density};
}

raylane_camera raylane_default_camera(void) {
    const Camera camera;
    return {
        number_of(camera.projection), to_c(camera.from), to_c(camera.at),    to_c(camera.up),
        camera.field_of_view,         camera.height,     camera.lens_radius, camera.focus_distance};
}

raylane_settings raylane_default_settings(void) {
    return to_c(Settings{});
}

raylane_status raylane_builder_create(raylane_builder** builder) {
    return guarded([&] {
        raylane_builder*& to = checked("builder", builder);
        to = nullptr;
        to = new raylane_builder;
    });
}

void raylane_builder_release(raylane_builder* builder) {
    delete builder;
}

raylane_status raylane_add_material(raylane_builder* builder, const raylane_material* material,
                                    uint32_t* index) {
    return guarded([&] {
        const MaterialIndex added =
            checked("builder", builder).builder.add_material(from_c(checked("material", material)));
        if (index != nullptr) *index = added;
    });
}

raylane_status raylane_add_light(raylane_builder* builder, const raylane_light* light) {
    return guarded(
        [&] { checked("builder", builder).builder.add_light(from_c(checked("light", light))); });
}

raylane_status raylane_set_fog(raylane_builder* builder, const raylane_fog* fog) {
    return guarded([&] { checked("builder", builder).builder.fog = from_c(checked("fog", fog)); });
}

raylane_status raylane_set_camera(raylane_builder* builder, const raylane_camera* camera) {
    return guarded(
        [&] { checked("builder", builder).builder.camera = from_c(checked("camera", camera)); });
}

raylane_status raylane_set_background(raylane_builder* builder, raylane_vec3 color) {
    return guarded([&] { checked("builder", builder).builder.background = from_c(color); });
}

raylane_status raylane_set_settings(raylane_builder* builder, const raylane_settings* settings) {
    return guarded([&] {
        checked("builder", builder).builder.settings = from_c(checked("settings", settings));
    });
}

#define RAYLANE_ADD(name, Shape, c_shape)                                                          \
    raylane_status name(raylane_builder* builder, const c_shape* shapes, size_t count,             \
                        uint32_t material, uint32_t* first) {                                      \
        return add<Shape>(builder, shapes, count, material, first);                                \
    }
RAYLANE_ADD(raylane_add_spheres, Sphere, raylane_sphere)
RAYLANE_ADD(raylane_add_planes, Plane, raylane_plane)
RAYLANE_ADD(raylane_add_discs, Disc, raylane_disc)
RAYLANE_ADD(raylane_add_triangles, Triangle, raylane_triangle)
RAYLANE_ADD(raylane_add_smooth_triangles, SmoothTriangle, raylane_smooth_triangle)
RAYLANE_ADD(raylane_add_boxes, Box, raylane_box)
RAYLANE_ADD(raylane_add_open_cylinders, OpenCylinder, raylane_cylinder)
RAYLANE_ADD(raylane_add_capped_cylinders, CappedCylinder, raylane_cylinder)
RAYLANE_ADD(raylane_add_open_cones, OpenCone, raylane_cone)
RAYLANE_ADD(raylane_add_capped_cones, CappedCone, raylane_cone)
RAYLANE_ADD(raylane_add_quadrics, Quadric, raylane_quadric)
RAYLANE_ADD(raylane_add_ellipsoids, Ellipsoid, raylane_ellipsoid)
#undef RAYLANE_ADD

raylane_status raylane_add_polygon(raylane_builder* builder, const raylane_triangle* triangles,
                                   size_t count, uint32_t material, uint32_t* first) {
    return guarded([&] {
        std::vector<Triangle> all;
        for (const raylane_triangle& triangle : span_of("triangles", triangles, count))
            all.push_back(std::bit_cast<Triangle>(triangle));
        const ShapeId id = checked("builder", builder).builder.add_polygon(all, material);
        if (first != nullptr) *first = id;
    });
}

raylane_status raylane_build(raylane_builder* builder, raylane_scene** scene) {
    return scene_of(scene, [&] { return checked("builder", builder).builder.build(); });
}

raylane_status raylane_load(const char* path, raylane_scene** scene) {
    return scene_of(scene, [&] { return load(&checked("path", path)); });
}

raylane_status raylane_parse(const char* text, size_t length, const char* name,
                             raylane_scene** scene) {
    return scene_of(scene, [&] {
        return parse({length != 0 ? &checked("text", text) : "", length}, &checked("name", name));
    });
}

raylane_status raylane_save(const raylane_scene* scene, const char* path) {
    return guarded([&] { save(checked("scene", scene).scene, &checked("path", path)); });
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

void raylane_scene_bounds(const raylane_scene* scene, raylane_vec3* lower, raylane_vec3* upper) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    if (scene != nullptr) bounds = scene->scene.bounds();
    if (lower != nullptr) *lower = to_c(bounds.lower);
    if (upper != nullptr) *upper = to_c(bounds.upper);
}

raylane_settings raylane_scene_settings(const raylane_scene* scene) {
    return to_c(scene != nullptr ? scene->scene.settings() : Settings{});
}

raylane_status raylane_tracer_create(const raylane_scene* scene, int threads, int precision,
                                     raylane_tracer** tracer) {
    return guarded([&] {
        raylane_tracer*& to = checked("tracer", tracer);
        to = nullptr;
        to =
            new raylane_tracer{Tracer(checked("scene", scene).scene,
                                      {threads, enum_from_int<Precision>("precision", precision)})};
    });
}

void raylane_tracer_release(raylane_tracer* tracer) {
    delete tracer;
}

raylane_status raylane_intersect(const raylane_tracer* tracer, const raylane_rays* rays,
                                 const raylane_hits* hits) {
    return intersect<float>(tracer, rays, hits);
}

raylane_status raylane_intersect_doubles(const raylane_tracer* tracer,
                                         const raylane_double_rays* rays,
                                         const raylane_hits* hits) {
    return intersect<double>(tracer, rays, hits);
}

raylane_status raylane_occluded(const raylane_tracer* tracer, const raylane_rays* rays,
                                uint8_t* result) {
    return occluded<float>(tracer, rays, result);
}

raylane_status raylane_occluded_doubles(const raylane_tracer* tracer,
                                        const raylane_double_rays* rays, uint8_t* result) {
    return occluded<double>(tracer, rays, result);
}

raylane_status raylane_render(const raylane_scene* scene, const raylane_settings* settings,
                              int threads, int precision, raylane_progress_callback progress,
                              void* user, float* rgb) {
    return guarded([&] {
        static_cast<void>(checked("rgb", rgb));
        RenderOptions options;
        if (settings != nullptr) options.settings = from_c(*settings);
        options.threads = threads;
        options.precision = enum_from_int<Precision>("precision", precision);
        const std::optional<Image> image =
            render(checked("scene", scene).scene, options, [&](const Progress& done) {
                if (progress == nullptr) return true;
                const raylane_progress told = to_c(done);
                return progress(&told, user) != 0;
            });
        if (!image) return failed(RAYLANE_CANCELLED, "cancelled");
        std::copy(image->rgb.begin(), image->rgb.end(), rgb);
        return RAYLANE_OK;
    });
}

raylane_status raylane_write_image(const char* path, int width, int height, const float* rgb,
                                   int transfer) {
    return guarded([&] {
        Image image{width, height, {}};
        if (width > 0 && height > 0) {
            const std::size_t count =
                3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
            const std::span<const float> all = span_of("rgb", rgb, count);
            image.rgb.assign(all.begin(), all.end());
        }
        write_image(&checked("path", path), image, enum_from_int<Transfer>("transfer", transfer));
    });
}
