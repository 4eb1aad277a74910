#include "raylane/raylane.h"
#include "tests/fuzz/bytes.hpp"

#include <climits>

#include <array>
#include <cstring>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

/// Makes any calls of the interface for C, in any order and with any arguments: handles or NULL,
/// arrays or NULL, any values. A call must return a status that the header names, with a text if it
/// fails. A NULL that is not allowed must give RAYLANE_INVALID_VALUE.
using raylane::fuzz::Bytes, raylane::fuzz::found;

namespace {

constexpr int slots = 3;
constexpr float untouched = -7777.0F;

struct Handles {
    std::array<raylane_builder*, slots> builders{};
    std::array<raylane_transform*, slots> transforms{};
    std::array<raylane_solid*, slots> solids{};
    std::array<raylane_group*, slots> groups{};
    std::array<raylane_scene*, slots> scenes{};
    std::array<raylane_tracer*, slots> tracers{};

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        for (int i = 0; i < slots; ++i) {
            const auto slot = static_cast<std::size_t>(i);
            raylane_builder_release(builders[slot]);
            raylane_transform_release(transforms[slot]);
            raylane_solid_release(solids[slot]);
            raylane_group_release(groups[slot]);
            raylane_scene_release(scenes[slot]);
            raylane_tracer_release(tracers[slot]);
        }
    }
};

/// Checks the result of a call.
void check(raylane_status status, bool has_null = false) {
    if (status < RAYLANE_OK || status > RAYLANE_CANCELLED) found("no such status");
    if (status == RAYLANE_OUT_OF_MEMORY) found("out of memory");
    if (has_null && status != RAYLANE_INVALID_VALUE)
        found("a NULL is taken: " + std::to_string(status));
    if (status == RAYLANE_OK || status == RAYLANE_CANCELLED) return;
    const std::string text = raylane_error_text();
    if (text.empty()) found("no text");
    if (status == RAYLANE_INVALID_VALUE && text.find('\n') != std::string::npos)
        found("more than a line: " + text);
}

template <class Handle>
Handle*& slot_of(std::array<Handle*, slots>& handles, Bytes& bytes) {
    return handles[static_cast<std::size_t>(bytes.below(slots))];
}

/// Puts a handle in a slot, in place of another one, unless it is NULL.
template <class Handle>
void keep(Handle* made, std::array<Handle*, slots>& handles, void (*release)(Handle*),
          Bytes& bytes) {
    if (made == nullptr) return;
    Handle*& slot = slot_of(handles, bytes);
    release(slot);
    slot = made;
}

/// Returns an index of a material, or RAYLANE_NO_MATERIAL.
std::uint32_t material_of(Bytes& bytes) {
    return static_cast<std::uint32_t>(bytes.below(4) - 1);
}

raylane_double_vec3 double_vector_of(Bytes& bytes) {
    const double x = bytes.number<double>(), y = bytes.number<double>();
    return {x, y, bytes.number<double>()};
}

raylane_vec3 vector_of(Bytes& bytes) {
    const float x = bytes.any_float(), y = bytes.any_float();
    return {x, y, bytes.any_float()};
}
std::uint8_t enumerator(Bytes& bytes, int count) {
    const int any = bytes.byte();
    return static_cast<std::uint8_t>(any < 240 ? any % count : any);
}

/// Returns a shape of any numbers, in double if it has doubles.
template <class Shape>
Shape shape_of(Bytes& bytes) {
    using Number = std::conditional_t<alignof(Shape) == alignof(double), double, float>;
    Number numbers[sizeof(Shape) / sizeof(Number)];
    for (Number& number : numbers)
        number = static_cast<Number>(bytes.any_float());
    Shape shape;
    std::memcpy(&shape, numbers, sizeof shape);
    return shape;
}

template <class Shape>
using AddShapes = raylane_status (*)(raylane_builder*, const Shape*, size_t, uint32_t, uint32_t*);

template <class Shape>
void add(AddShapes<Shape> add_shapes, raylane_builder* builder, Bytes& bytes) {
    const auto count = static_cast<std::size_t>(bytes.below(8));
    std::vector<Shape> shapes(count);
    for (Shape& shape : shapes)
        shape = shape_of<Shape>(bytes);
    const bool leaves_out = bytes.below(16) == 15;
    const auto material = static_cast<std::uint32_t>(bytes.below(20) - 1);
    std::uint32_t first = 0;
    check(add_shapes(builder, leaves_out ? nullptr : shapes.data(), count, material,
                     bytes.flag() ? &first : nullptr),
          builder == nullptr || (leaves_out && count != 0));
}

template <auto add_shapes>
void add_by(raylane_builder* builder, Bytes& bytes) {
    add(add_shapes, builder, bytes);
}

void add_sphereflake(raylane_builder* builder, Bytes& bytes) {
    raylane_sphereflake flake = raylane_default_sphereflake();
    flake.center = vector_of(bytes);
    flake.radius = bytes.any_float();
    flake.depth = bytes.below(5) - 1;
    flake.up = vector_of(bytes);
    std::uint32_t first = 0;
    check(raylane_add_sphereflake(builder, &flake, material_of(bytes), &first), builder == nullptr);
}

void add_lattice(raylane_builder* builder, Bytes& bytes) {
    raylane_lattice lattice = raylane_default_lattice();
    lattice.corner = double_vector_of(bytes);
    lattice.n = bytes.below(6) - 1;
    for (float* number : {&lattice.spacing, &lattice.sphere_radius, &lattice.strut_radius})
        *number = bytes.any_float();
    const std::uint32_t material = material_of(bytes);
    check(raylane_add_lattice(builder, &lattice, material, material_of(bytes), nullptr),
          builder == nullptr);
}

constexpr void (*all_adding[])(raylane_builder*,
                               Bytes&) = {add_sphereflake,
                                          add_lattice,
                                          add_by<raylane_add_spheres>,
                                          add_by<raylane_add_spheres_doubles>,
                                          add_by<raylane_add_planes>,
                                          add_by<raylane_add_planes_doubles>,
                                          add_by<raylane_add_discs>,
                                          add_by<raylane_add_discs_doubles>,
                                          add_by<raylane_add_triangles>,
                                          add_by<raylane_add_triangles_doubles>,
                                          add_by<raylane_add_smooth_triangles>,
                                          add_by<raylane_add_smooth_triangles_doubles>,
                                          add_by<raylane_add_boxes>,
                                          add_by<raylane_add_boxes_doubles>,
                                          add_by<raylane_add_open_cylinders>,
                                          add_by<raylane_add_open_cylinders_doubles>,
                                          add_by<raylane_add_capped_cylinders>,
                                          add_by<raylane_add_capped_cylinders_doubles>,
                                          add_by<raylane_add_open_cones>,
                                          add_by<raylane_add_open_cones_doubles>,
                                          add_by<raylane_add_capped_cones>,
                                          add_by<raylane_add_capped_cones_doubles>,
                                          add_by<raylane_add_quadrics>,
                                          add_by<raylane_add_quadrics_doubles>,
                                          add_by<raylane_add_ellipsoids>,
                                          add_by<raylane_add_ellipsoids_doubles>,
                                          add_by<raylane_add_polygon>,
                                          add_by<raylane_add_polygon_doubles>};

/// Makes a solid of one shape. `to` may be NULL, as in the next functions.
template <class Shape>
raylane_status solid_by(raylane_status (*make)(const Shape*, uint32_t, raylane_solid**),
                        raylane_solid** to, Bytes& bytes) {
    const Shape shape = shape_of<Shape>(bytes);
    const auto material = static_cast<std::uint32_t>(bytes.below(4) - 1);
    const bool leaves_out = bytes.below(32) == 31;
    const raylane_status status = make(leaves_out ? nullptr : &shape, material, to);
    check(status, leaves_out || to == nullptr);
    return status;
}

template <auto make>
raylane_status solid_of(raylane_solid** to, Bytes& bytes) {
    return solid_by(make, to, bytes);
}

constexpr raylane_status (*all_solids[])(raylane_solid**,
                                         Bytes&) = {solid_of<raylane_solid_sphere>,
                                                    solid_of<raylane_solid_plane>,
                                                    solid_of<raylane_solid_disc>,
                                                    solid_of<raylane_solid_triangle>,
                                                    solid_of<raylane_solid_smooth_triangle>,
                                                    solid_of<raylane_solid_box>,
                                                    solid_of<raylane_solid_open_cylinder>,
                                                    solid_of<raylane_solid_capped_cylinder>,
                                                    solid_of<raylane_solid_open_cone>,
                                                    solid_of<raylane_solid_capped_cone>,
                                                    solid_of<raylane_solid_quadric>,
                                                    solid_of<raylane_solid_ellipsoid>,
                                                    solid_of<raylane_solid_lens>};

raylane_status combine(Handles& handles, raylane_solid** to, Bytes& bytes) {
    std::vector<const raylane_solid*> parts(static_cast<std::size_t>(bytes.below(4)));
    bool has_null = to == nullptr;
    for (const raylane_solid*& part : parts) {
        part = slot_of(handles.solids, bytes);
        has_null = has_null || part == nullptr;
    }
    const raylane_solid* const solid = slot_of(handles.solids, bytes);
    const bool leaves_out = bytes.below(32) == 31;
    has_null = has_null || (leaves_out && !parts.empty());
    const raylane_solid* const* const parts_or_null = leaves_out ? nullptr : parts.data();
    const auto material = static_cast<std::uint32_t>(bytes.below(4) - 1);
    const auto checked = [](raylane_status status, bool null) {
        check(status, null);
        return status;
    };
    switch (bytes.below(4)) {
    case 0:
        return checked(raylane_solid_union(parts_or_null, parts.size(), material, to), has_null);
    case 1:
        return checked(raylane_solid_intersection(parts_or_null, parts.size(), material, to),
                       has_null);
    case 2:
        return checked(raylane_solid_difference(solid, parts_or_null, parts.size(), material, to),
                       has_null || solid == nullptr);
    default:
        return checked(raylane_solid_clipped(solid, parts_or_null, parts.size(), material, to),
                       has_null || solid == nullptr);
    }
}

void make_solid(Handles& handles, Bytes& bytes) {
    if (bytes.below(4) == 0) {
        raylane_builder* const builder = slot_of(handles.builders, bytes);
        const raylane_solid* const solid = slot_of(handles.solids, bytes);
        std::uint32_t first = 0;
        return check(raylane_add_solid(builder, solid,
                                       static_cast<std::uint32_t>(bytes.below(4) - 1),
                                       bytes.flag() ? &first : nullptr),
                     builder == nullptr || solid == nullptr);
    }
    raylane_solid* made = nullptr;
    raylane_solid** const to = bytes.below(32) == 31 ? nullptr : &made;
    const raylane_solid* const solid = slot_of(handles.solids, bytes);
    const int how = bytes.below(16);
    if (how < 7) {
        combine(handles, to, bytes);
    } else if (how < 13) {
        all_solids[static_cast<std::size_t>(bytes.below(int(std::size(all_solids))))](to, bytes);
    } else if (how == 13) {
        const raylane_transform* const map = slot_of(handles.transforms, bytes);
        check(raylane_solid_transformed(solid, map, to),
              to == nullptr || solid == nullptr || map == nullptr);
    } else if (how == 14) {
        const raylane_group* const group = slot_of(handles.groups, bytes);
        check(raylane_solid_group(group, material_of(bytes), to),
              to == nullptr || group == nullptr);
    } else {
        check(raylane_solid_of_material(solid, material_of(bytes), to),
              to == nullptr || solid == nullptr);
    }
    keep(made, handles.solids, raylane_solid_release, bytes);
}

void change_transform(Handles& handles, Bytes& bytes) {
    raylane_transform* const map = slot_of(handles.transforms, bytes);
    switch (bytes.below(6)) {
    case 0:
        return check(raylane_transform_scale(map, double_vector_of(bytes)), map == nullptr);
    case 1:
        return check(raylane_transform_rotate(map, double_vector_of(bytes)), map == nullptr);
    case 2:
        return check(raylane_transform_translate(map, double_vector_of(bytes)), map == nullptr);
    case 3: {
        const raylane_transform* const next = slot_of(handles.transforms, bytes);
        return check(raylane_transform_then(map, next), map == nullptr || next == nullptr);
    }
    default: {
        raylane_transform* made = nullptr;
        if (bytes.flag()) {
            check(raylane_transform_create(&made));
        } else {
            double rows[12];
            for (double& number : rows)
                number = static_cast<double>(bytes.any_float());
            const bool leaves_out = bytes.below(16) == 15;
            check(raylane_transform_matrix(leaves_out ? nullptr : rows, &made), leaves_out);
        }
        return keep(made, handles.transforms, raylane_transform_release, bytes);
    }
    }
}

template <auto add_shapes>
void add_to_group(raylane_group* group, Bytes& bytes) {
    const auto add = [&]<class Shape>(
                         raylane_status (*call)(raylane_group*, const Shape*, size_t, uint32_t)) {
        std::vector<Shape> shapes(static_cast<std::size_t>(bytes.below(4)));
        for (Shape& shape : shapes)
            shape = shape_of<Shape>(bytes);
        const bool leaves_out = bytes.below(16) == 15;
        check(call(group, leaves_out ? nullptr : shapes.data(), shapes.size(), material_of(bytes)),
              group == nullptr || (leaves_out && !shapes.empty()));
    };
    add(add_shapes);
}

constexpr void (*all_members[])(raylane_group*,
                                Bytes&) = {add_to_group<raylane_group_add_spheres>,
                                           add_to_group<raylane_group_add_planes>,
                                           add_to_group<raylane_group_add_discs>,
                                           add_to_group<raylane_group_add_triangles>,
                                           add_to_group<raylane_group_add_smooth_triangles>,
                                           add_to_group<raylane_group_add_boxes>,
                                           add_to_group<raylane_group_add_open_cylinders>,
                                           add_to_group<raylane_group_add_capped_cylinders>,
                                           add_to_group<raylane_group_add_open_cones>,
                                           add_to_group<raylane_group_add_capped_cones>,
                                           add_to_group<raylane_group_add_quadrics>,
                                           add_to_group<raylane_group_add_ellipsoids>};

/// Members of a group, which is added several times, are limited by this number.
constexpr std::size_t most_members = 64;

void make_group(Handles& handles, Bytes& bytes) {
    raylane_group* made = nullptr;
    raylane_group** const to = bytes.below(32) == 31 ? nullptr : &made;
    const raylane_group* const group = slot_of(handles.groups, bytes);
    switch (bytes.below(4)) {
    case 0: {
        const raylane_transform* const map = slot_of(handles.transforms, bytes);
        check(raylane_group_transformed(group, map, to),
              to == nullptr || group == nullptr || map == nullptr);
        break;
    }
    case 1:
        check(raylane_group_of_material(group, material_of(bytes), to),
              to == nullptr || group == nullptr);
        break;
    default:
        check(raylane_group_create(to), to == nullptr);
    }
    keep(made, handles.groups, raylane_group_release, bytes);
}

void add_copies(Handles& handles, Bytes& bytes) {
    raylane_builder* const builder = slot_of(handles.builders, bytes);
    const raylane_group* const group = slot_of(handles.groups, bytes);
    if (bytes.flag())
        check(raylane_set_keep_from(builder, static_cast<std::size_t>(bytes.below(8))),
              builder == nullptr);
    std::vector<raylane_placement> placements(static_cast<std::size_t>(bytes.below(4)),
                                              raylane_default_placement());
    for (raylane_placement& placement : placements) {
        placement.translate = double_vector_of(bytes);
        if (bytes.flag()) placement.rotate = double_vector_of(bytes);
        if (bytes.flag()) placement.scale = static_cast<double>(bytes.any_float());
    }
    const bool leaves_out = bytes.below(16) == 15;
    std::uint32_t first = 0;
    check(raylane_add_copies(builder, group, leaves_out ? nullptr : placements.data(),
                             placements.size(), material_of(bytes),
                             bytes.flag() ? &first : nullptr),
          builder == nullptr || group == nullptr || (leaves_out && !placements.empty()));
}

void change_group(Handles& handles, Bytes& bytes) {
    raylane_group* const group = slot_of(handles.groups, bytes);
    switch (bytes.below(8)) {
    case 0:
    case 1:
        return make_group(handles, bytes);
    case 2: {
        raylane_builder* const builder = slot_of(handles.builders, bytes);
        return check(raylane_add_group(builder, group, material_of(bytes), nullptr),
                     builder == nullptr || group == nullptr);
    }
    case 3:
        return add_copies(handles, bytes);
    case 4: {
        const raylane_solid* const solid = slot_of(handles.solids, bytes);
        return check(raylane_group_add_solid(group, solid, material_of(bytes)),
                     group == nullptr || solid == nullptr);
    }
    case 5: {
        const raylane_group* const members = slot_of(handles.groups, bytes);
        if (raylane_group_size(group) + raylane_group_size(members) > most_members) return;
        return check(raylane_group_add_group(group, members, material_of(bytes)),
                     group == nullptr || members == nullptr);
    }
    default:
        return all_members[static_cast<std::size_t>(bytes.below(int(std::size(all_members))))](
            group, bytes);
    }
}

/// Returns an image, or NULL if the call must fail.
raylane_texture* texture_of(Bytes& bytes) {
    const int width = bytes.below(4), height = bytes.below(4);
    const bool leaves_out = bytes.below(16) == 15 || width == 0 || height == 0;
    raylane_texture* made = nullptr;
    if (bytes.flag()) {
        float linear[27];
        for (float& number : linear)
            number = bytes.any_float();
        check(raylane_texture_from_floats(width, height, leaves_out ? nullptr : linear, &made),
              leaves_out);
    } else {
        std::uint8_t codes[27];
        for (std::uint8_t& code : codes)
            code = static_cast<std::uint8_t>(bytes.byte());
        check(raylane_texture_from_codes(width, height, leaves_out ? nullptr : codes, &made),
              leaves_out);
    }
    return made;
}

void add_material(raylane_builder* builder, Bytes& bytes) {
    raylane_material material = raylane_default_material();
    const int changes = bytes.byte();
    if ((changes & 1) != 0) material.pattern.kind = enumerator(bytes, 6);
    raylane_texture* const image =
        material.pattern.kind == RAYLANE_IMAGE ? texture_of(bytes) : nullptr;
    material.pattern.image = image;
    if (image != nullptr) {
        material.pattern.width = bytes.any_float();
        material.pattern.height = bytes.any_float();
        material.pattern.wrap = enumerator(bytes, 2);
        material.pattern.axis = vector_of(bytes);
    }
    if (material.pattern.kind == RAYLANE_FORMULA) material.pattern.space = enumerator(bytes, 2);
    if (material.pattern.kind == RAYLANE_FORMULA)
        for (const char*& text : material.pattern.formula)
            text = bytes.below(4) == 0 ? "cos(" : "abs(sin(u)) / noise(x, y, z) ^ v";
    if ((changes & 2) != 0) material.pattern.colors[bytes.below(2)] = vector_of(bytes);
    if ((changes & 4) != 0) material.pattern.direction = vector_of(bytes);
    if ((changes & 8) != 0) material.reflection = enumerator(bytes, 3);
    if ((changes & 16) != 0) material.transmission = 1.0F;
    if ((changes & 32) != 0) material.visible = enumerator(bytes, 3);
    if ((changes & 64) != 0)
        for (float* number : {&material.ambient, &material.exponent, &material.index,
                              &material.reflectivity, &material.pattern.size, &material.opacity})
            *number = bytes.any_float();
    if ((changes & 128) != 0) material.pattern.axes = static_cast<std::uint8_t>(bytes.byte());
    std::uint32_t index = 0;
    const bool leaves_out = bytes.below(16) == 15;
    check(raylane_add_material(builder, leaves_out ? nullptr : &material,
                               bytes.flag() ? &index : nullptr),
          builder == nullptr || leaves_out);
    raylane_texture_release(image);
}

void set_surroundings(raylane_builder* builder, Bytes& bytes) {
    switch (bytes.below(8)) {
    case 0: {
        raylane_light light = raylane_default_light();
        light.kind = enumerator(bytes, 6);
        for (raylane_vec3* vector : {&light.position, &light.direction, &light.color, &light.edge_u,
                                     &light.edge_v, &light.ground})
            *vector = vector_of(bytes);
        light.radius = bytes.any_float();
        light.reach = bytes.any_float();
        return check(raylane_add_light(builder, &light), builder == nullptr);
    }
    case 1: {
        raylane_fog fog = raylane_default_fog();
        fog.kind = enumerator(bytes, 4);
        fog.start = bytes.any_float();
        fog.end = bytes.any_float();
        fog.density = bytes.any_float();
        return check(raylane_set_fog(builder, &fog), builder == nullptr);
    }
    case 2: {
        raylane_camera camera = raylane_default_camera();
        camera.projection = enumerator(bytes, 2);
        camera.from = vector_of(bytes);
        camera.at = vector_of(bytes);
        if (bytes.flag()) camera.field_of_view = bytes.any_float();
        if (bytes.flag()) camera.lens_radius = bytes.any_float();
        return check(raylane_set_camera(builder, bytes.below(16) == 15 ? nullptr : &camera),
                     builder == nullptr);
    }
    case 3: {
        raylane_auto_camera camera = raylane_default_auto_camera();
        const bool is_named = bytes.flag();
        if (is_named) check(raylane_named_view(bytes.flag() ? "corner" : "nowhere", &camera));
        if (bytes.flag()) camera.direction = vector_of(bytes);
        if (bytes.flag()) camera.zoom = bytes.any_float();
        return check(raylane_set_auto_camera(builder, bytes.below(16) == 15 ? nullptr : &camera),
                     builder == nullptr);
    }
    case 4:
        return check(raylane_set_camera_lights(builder, bytes.flag()), builder == nullptr);
    case 5: {
        const double waves[] = {550.0, static_cast<double>(bytes.any_float())};
        return check(
            raylane_set_wavelengths(builder, waves, static_cast<std::size_t>(bytes.below(3))),
            builder == nullptr);
    }
    case 6:
        return check(raylane_set_merge_duplicates(builder, bytes.flag()), builder == nullptr);
    default:
        return check(raylane_set_background(builder, vector_of(bytes)), builder == nullptr);
    }
}

/// Returns settings that render quickly or are refused.
raylane_settings any_settings(Bytes& bytes) {
    raylane_settings settings = raylane_default_settings();
    constexpr int sizes[] = {1, 2, 7, 8, 12, 0, -1, INT_MAX, INT_MIN};
    const auto any_of = [&](int small) {
        const int any = bytes.byte();
        return any < 240 ? any % small : any < 248 ? -1 : INT_MAX;
    };
    settings.width = sizes[bytes.below(9)];
    settings.height = sizes[bytes.below(9)];
    settings.grid = 1 + bytes.below(2);
    settings.samples = enumerator(bytes, 2);
    settings.transfer = enumerator(bytes, 2);
    settings.filter = enumerator(bytes, 3);
    settings.max_depth = bytes.below(4);
    settings.light_samples = 1 + bytes.below(2);
    settings.max_transparent = 1 + bytes.below(4);
    settings.transparent_shadows = static_cast<std::uint8_t>(bytes.below(3));
    if (bytes.below(8) == 0) settings.grid = any_of(1);
    if (bytes.below(8) == 0) settings.quality = bytes.flag() ? 25.0F : bytes.any_float();
    if (settings.quality > 30.0F) settings.quality = 30.0F;
    if (bytes.below(8) == 0) settings.outline = {bytes.any_float(), vector_of(bytes), 30.0F};
    if (bytes.below(8) == 0) settings.min_weight = bytes.any_float();
    return settings;
}

int stop_after(const raylane_progress* progress, void* user) {
    if (progress->rgb == nullptr || progress->pixels > progress->total_pixels)
        found("progress of nothing");
    return --*static_cast<int*>(user) > 0 ? 1 : 0;
}

void render(const raylane_scene* scene, Bytes& bytes) {
    const raylane_settings own = raylane_scene_settings(scene), any = any_settings(bytes);
    const bool takes_own = bytes.below(4) == 0;
    const raylane_settings& settings = takes_own ? own : any;
    const bool is_small =
        settings.width > 0 && settings.width <= 16 && settings.height > 0 && settings.height <= 16;
    if (takes_own && !is_small) return;
    const auto width = static_cast<std::size_t>(is_small ? settings.width : 1);
    const auto height = static_cast<std::size_t>(is_small ? settings.height : 1);
    std::vector<float> rgb(3 * width * height, untouched);
    int calls = bytes.below(4);
    const bool listens = bytes.flag(), leaves_out = bytes.below(16) == 15;
    const int threads = bytes.below(4) == 0 ? bytes.byte() - 100 : 1;
    const int precision = bytes.below(4) == 0 ? bytes.byte() - 2 : int(RAYLANE_EXACT);
    const raylane_status status =
        raylane_render(scene, takes_own ? nullptr : &settings, threads > 3 ? 5000 : threads,
                       precision, listens ? stop_after : nullptr, listens ? &calls : nullptr,
                       leaves_out ? nullptr : rgb.data());
    check(status, scene == nullptr || leaves_out);
    for (const float component : rgb)
        if ((component == untouched) == (status == RAYLANE_OK)) found("another picture");
}

/// Makes arrays of exactly `count` values, or NULL for some that may be left out.
template <class Value>
class Arrays {
  public:
    Arrays(std::size_t count, Bytes& bytes) : count_(count), bytes_(bytes) {}
    template <class Make>
    Value* make(bool may_be_left_out, const Make& value) {
        const int any = bytes_.byte();
        if (may_be_left_out ? any % 2 == 0 : any >= 250) return nullptr;
        arrays_.push_back(std::make_unique<Value[]>(count_));
        for (std::size_t i = 0; i < count_; ++i)
            arrays_.back()[i] = value();
        return arrays_.back().get();
    }

  private:
    std::size_t count_;
    Bytes& bytes_;
    std::vector<std::unique_ptr<Value[]>> arrays_;
};

/// Reads all of a column, or nothing if it is absent. Returns whether it is there.
template <class Element>
bool reads(const Element* column, std::uint64_t count) {
    Element sum{};
    for (std::uint64_t i = 0; column != nullptr && i < count; ++i)
        sum = static_cast<Element>(sum + column[i]);
    volatile Element used = sum;
    static_cast<void>(used);
    return column != nullptr;
}

/// Checks rows that a query has made, or failed to make, and releases them.
void check_rows(raylane_status status, bool has_null, raylane_rows* rows, std::size_t count) {
    check(status, has_null);
    if ((status == RAYLANE_OK) != (rows != nullptr)) found("rows of a call that failed");
    if (rows == nullptr) return;
    const std::uint64_t* const first = raylane_rows_first(rows);
    if (raylane_rows_count(rows) != count || first[0] != 0) found("other rows");
    for (std::size_t i = 0; i < count; ++i)
        if (first[i] > first[i + 1]) found("row offsets that fall");
    const std::uint64_t row_count = first[count];
    const int columns = reads(raylane_rows_t(rows), row_count) +
                        reads(raylane_rows_length(rows), row_count) +
                        reads(raylane_rows_on_surface(rows), row_count);
    if (columns != (row_count != 0 ? 1 : 0)) found("columns of another query");
    reads(raylane_rows_shape_id(rows), row_count);
    reads(raylane_rows_material(rows), row_count);
    reads(raylane_rows_entering(rows), row_count);
    reads(raylane_rows_face(rows), row_count);
    reads(raylane_rows_tied(rows), row_count);
    reads(raylane_rows_touching(rows), row_count);
    for (const auto normal : {raylane_rows_normal_x, raylane_rows_normal_y, raylane_rows_normal_z})
        reads(normal(rows), row_count);
    reads(raylane_rows_inside(rows), row_count);
    for (const auto normal :
         {raylane_rows_normal_double_x, raylane_rows_normal_double_y, raylane_rows_normal_double_z})
        reads(normal(rows), row_count);
    if (raylane_rows_statistics(rows).refused > count) found("more refused rays than rays");
    raylane_rows_release(rows);
}

/// The calls for rays or points of one type of numbers.
struct OfFloats {
    using Real = float;
    using Rays = raylane_rays;
    using Points = raylane_points;
    static constexpr auto intersect = raylane_intersect;
    static constexpr auto occluded = raylane_occluded;
    static constexpr auto count_crossings = raylane_count_crossings;
    static constexpr auto crossings = raylane_crossings;
    static constexpr auto path_lengths = raylane_path_lengths;
    static constexpr auto solid_lengths = raylane_solid_lengths;
    static constexpr auto onward = raylane_onward;
    static constexpr auto contains = raylane_contains;
    static constexpr auto cells = raylane_cells;
    static constexpr auto closest = raylane_closest;
};
struct OfDoubles {
    using Real = double;
    using Rays = raylane_double_rays;
    using Points = raylane_double_points;
    static constexpr auto intersect = raylane_intersect_doubles;
    static constexpr auto occluded = raylane_occluded_doubles;
    static constexpr auto count_crossings = raylane_count_crossings_doubles;
    static constexpr auto crossings = raylane_crossings_doubles;
    static constexpr auto path_lengths = raylane_path_lengths_doubles;
    static constexpr auto solid_lengths = raylane_solid_lengths_doubles;
    static constexpr auto onward = raylane_onward_doubles;
    static constexpr auto contains = raylane_contains_doubles;
    static constexpr auto cells = raylane_cells_doubles;
    static constexpr auto closest = raylane_closest_doubles;
};

template <class Of>
void ask_rows(const raylane_tracer* tracer, const typename Of::Rays& rays, bool has_null,
              Bytes& bytes) {
    raylane_rows* rows = nullptr;
    const auto most = static_cast<std::size_t>(bytes.below(4));
    const int normals = bytes.below(4);
    check_rows(Of::crossings(tracer, &rays, most, normals, &rows), has_null, rows, rays.count);
    rows = nullptr;
    check_rows(Of::path_lengths(tracer, &rays, &rows), has_null, rows, rays.count);
    rows = nullptr;
    check_rows(Of::solid_lengths(tracer, &rays, &rows), has_null, rows, rays.count);
    check(Of::crossings(tracer, &rays, most, normals, nullptr), true);
}

/// Asks for cells and closest points. Scenes with kept copies have neither, and such with
/// constructed solids no closest points.
template <class Of>
void ask_columns(const raylane_tracer* tracer, const typename Of::Points& points, bool has_null,
                 Bytes& bytes) {
    const std::size_t count = points.count;
    Arrays<std::uint32_t> ids(count, bytes);
    Arrays<std::uint8_t> flags(count, bytes);
    Arrays<double> doubles(count, bytes);
    raylane_cell_columns cells{};
    for (std::uint32_t** array : {&cells.shape_id, &cells.material})
        *array = ids.make(true, [] { return std::uint32_t{77777}; });
    cells.on_surface = flags.make(true, [] { return std::uint8_t{77}; });
    const raylane_status of_cells = Of::cells(tracer, &points, &cells);
    check(of_cells, has_null);
    raylane_closest_points closest{};
    for (double** array : {&closest.distance, &closest.point_x, &closest.point_y, &closest.point_z})
        *array = doubles.make(true, [] { return -7777.0; });
    closest.shape_id = ids.make(true, [] { return std::uint32_t{77777}; });
    closest.face = flags.make(true, [] { return std::uint8_t{77}; });
    const double* const max_distance =
        doubles.make(true, [&] { return static_cast<double>(bytes.any_float()); });
    const raylane_status of_closest = Of::closest(tracer, &points, max_distance, &closest);
    check(of_closest, has_null);
    for (std::size_t i = 0; i < count; ++i) {
        if (cells.on_surface != nullptr && (cells.on_surface[i] == 77) == (of_cells == RAYLANE_OK))
            found("another cell");
        if (closest.distance != nullptr &&
            (closest.distance[i] == -7777.0) == (of_closest == RAYLANE_OK))
            found("another distance");
    }
}

template <class Of>
void ask_points(const raylane_tracer* tracer, Bytes& bytes) {
    using Real = typename Of::Real;
    const auto count = static_cast<std::size_t>(bytes.below(20));
    Arrays<Real> reals(count, bytes);
    std::uint64_t refused = 0;
    typename Of::Points points{};
    points.count = count;
    points.refused = bytes.flag() ? &refused : nullptr;
    bool has_null = tracer == nullptr;
    for (const Real** array : {&points.x, &points.y, &points.z}) {
        *array = reals.make(false, [&] { return static_cast<Real>(bytes.any_float()); });
        has_null = has_null || (*array == nullptr && count != 0);
    }
    raylane_rows* rows = nullptr;
    check_rows(Of::contains(tracer, &points, &rows), has_null, rows, count);
    ask_columns<Of>(tracer, points, has_null, bytes);
    if (refused > count) found("more refused points than points");
}

/// Makes rays that continue from hits, and asks whether something occludes them. Hits that were
/// computed belong to their shapes, so no such ray is an error.
template <class Of>
void go_on(const raylane_tracer* tracer, const typename Of::Rays& rays, const raylane_hits& hits,
           bool has_null, Bytes& bytes) {
    using Real = typename Of::Real;
    const std::size_t count = rays.count;
    Arrays<Real> reals(count, bytes);
    Arrays<std::uint8_t> flags(count, bytes);
    const Real* directions[3];
    Real* origins[3];
    for (const Real*& array : directions) {
        array = reals.make(false, [&] { return bytes.number<Real>(); });
        has_null = has_null || array == nullptr;
    }
    for (Real*& array : origins) {
        array = reals.make(false, [] { return Real(-7777); });
        has_null = has_null || array == nullptr;
    }
    std::uint8_t* const inward = flags.make(false, [] { return std::uint8_t{77}; });
    has_null = has_null || inward == nullptr || (hits.t == nullptr && hits.t_double == nullptr) ||
               hits.normal_x == nullptr || hits.normal_y == nullptr || hits.normal_z == nullptr ||
               hits.shape_id == nullptr || hits.face == nullptr;
    const raylane_status status =
        Of::onward(&rays, &hits, directions[0], directions[1], directions[2], origins[0],
                   origins[1], origins[2], inward);
    check(status, has_null && count != 0);
    if (status != RAYLANE_OK || tracer == nullptr) return;
    typename Of::Rays next{};
    next.count = count;
    next.origin_x = origins[0];
    next.origin_y = origins[1];
    next.origin_z = origins[2];
    next.direction_x = directions[0];
    next.direction_y = directions[1];
    next.direction_z = directions[2];
    next.origin_shape = hits.shape_id;
    next.origin_face = hits.face;
    next.origin_inward = inward;
    std::vector<std::uint8_t> blocked(count + 1);
    check(Of::occluded(tracer, &next, blocked.data()));
}

template <class Of>
void ask(const raylane_tracer* tracer, Bytes& bytes) {
    using Real = typename Of::Real;
    const auto count = static_cast<std::size_t>(bytes.below(40));
    Arrays<Real> reals(count, bytes);
    Arrays<std::uint32_t> ids(count, bytes);
    Arrays<std::uint8_t> flags(count, bytes);
    const auto number = [&] { return static_cast<Real>(bytes.any_float()); };
    typename Of::Rays rays{};
    rays.count = count;
    bool has_null = tracer == nullptr;
    for (const Real** array : {&rays.origin_x, &rays.origin_y, &rays.origin_z, &rays.direction_x,
                               &rays.direction_y, &rays.direction_z}) {
        *array = reals.make(false, number);
        has_null = has_null || (*array == nullptr && count != 0);
    }
    rays.t_min = reals.make(true, number);
    rays.t_max = reals.make(true, number);
    // Ids without a shape: rays that cannot start on their shape would be errors.
    rays.origin_shape = ids.make(true, [&] { return ~static_cast<std::uint32_t>(bytes.byte()); });
    rays.origin_face = flags.make(true, [&] { return static_cast<std::uint8_t>(bytes.byte()); });
    rays.origin_inward = flags.make(true, [&] { return static_cast<std::uint8_t>(bytes.byte()); });
    Arrays<float> floats(count, bytes);
    Arrays<double> doubles(count, bytes);
    raylane_hits hits{};
    for (float** array : {&hits.t, &hits.normal_x, &hits.normal_y, &hits.normal_z})
        *array = floats.make(true, [] { return untouched; });
    hits.shape_id = ids.make(true, [] { return std::uint32_t{77777}; });
    hits.entering = flags.make(true, [] { return std::uint8_t{77}; });
    hits.face = flags.make(true, [] { return std::uint8_t{77}; });
    for (double** array :
         {&hits.t_double, &hits.normal_double_x, &hits.normal_double_y, &hits.normal_double_z})
        *array = doubles.make(true, [] { return -7777.0; });
    const raylane_status status = Of::intersect(tracer, &rays, &hits);
    check(status, has_null);
    std::uint8_t* const blocked = flags.make(false, [] { return std::uint8_t{77}; });
    const raylane_status of_blocked = Of::occluded(tracer, &rays, blocked);
    check(of_blocked, has_null || (blocked == nullptr && count != 0));
    ask_rows<Of>(tracer, rays, has_null, bytes);
    if (status == RAYLANE_OK) go_on<Of>(tracer, rays, hits, false, bytes);
    Arrays<std::uint64_t> numbers(count, bytes);
    std::uint64_t* const counts = numbers.make(false, [] { return std::uint64_t{777777}; });
    const raylane_status of_counts = Of::count_crossings(tracer, &rays, counts);
    check(of_counts, has_null || (counts == nullptr && count != 0));
    for (std::size_t i = 0; i < count; ++i) {
        if (counts != nullptr && (counts[i] == 777777) == (of_counts == RAYLANE_OK))
            found("another count");
        if (hits.normal_double_x != nullptr &&
            (hits.normal_double_x[i] == -7777.0) == (status == RAYLANE_OK))
            found("another normal");
        if (hits.t != nullptr && (hits.t[i] == untouched) == (status == RAYLANE_OK))
            found("another t");
        if (hits.entering != nullptr && (hits.entering[i] == 77) == (status == RAYLANE_OK))
            found("another side");
        if (blocked != nullptr && (blocked[i] == 77) == (of_blocked == RAYLANE_OK))
            found("another answer");
    }
}

void make_scene(Handles& handles, Bytes& bytes) {
    raylane_scene* made = nullptr;
    const bool leaves_out = bytes.below(32) == 31;
    raylane_scene** const to = leaves_out ? nullptr : &made;
    switch (bytes.below(5)) {
    case 0:
    case 1: {
        raylane_builder* const builder = slot_of(handles.builders, bytes);
        check(raylane_build(builder, to), leaves_out || builder == nullptr);
        break;
    }
    case 2: {
        constexpr const char* paths[] = {"", ".", "nothing.json", "/nowhere/of.nff"};
        const int which = bytes.below(5);
        check(raylane_load(which == 4 ? nullptr : paths[which], to), leaves_out || which == 4);
        break;
    }
    case 3: {
        constexpr raylane_atom_option options[] = {{"style", "sticks"},
                                                   {"representations", "element O: spheres"},
                                                   {"style", "none"},
                                                   {"cell", "on"},
                                                   {"", ""},
                                                   {nullptr, "on"}};
        const std::string atoms = "2\n\nC 0 0 0\nO 1.2 0 0\n";
        const int first = bytes.below(6), count = bytes.below(7 - first);
        const bool has_null = leaves_out || (count != 0 && first + count == 6);
        check(raylane_parse_atoms(atoms.data(), atoms.size(), "a.xyz", options + first,
                                  static_cast<std::size_t>(count), to),
              has_null);
        break;
    }
    default: {
        std::string text = R"({"camera": "auto", "objects": [{"type": "sphere", "radius": 1}]})";
        for (int i = bytes.below(4); i > 0; --i)
            text[static_cast<std::size_t>(bytes.byte()) % text.size()] =
                static_cast<char>(bytes.byte());
        const bool has_none = bytes.below(16) == 15;
        const std::vector<char> exactly(text.begin(), text.end()); // without a 0 at the end
        check(raylane_parse(has_none ? nullptr : exactly.data(), exactly.size(),
                            bytes.flag() ? "a.json" : "scene", to),
              leaves_out || has_none);
    }
    }
    const std::string remarks = raylane_remarks();
    if (!remarks.empty() && (remarks.back() == '\n' || remarks.front() == '\n'))
        found("an empty remark");
    keep(made, handles.scenes, raylane_scene_release, bytes);
}

/// Asks for the rays of a scene's camera, or of any other one.
void ask_camera(const raylane_scene* scene, Bytes& bytes) {
    raylane_camera camera = raylane_scene_camera(scene);
    if (bytes.flag()) camera.from = vector_of(bytes);
    if (bytes.flag()) camera.field_of_view = bytes.any_float();
    const int width = bytes.below(6) - 1, height = bytes.below(6) - 1;
    std::vector<double> origins(3 * 5 * 5), directions(3 * 5 * 5);
    const bool leaves_out = bytes.below(16) == 15;
    const raylane_status status = raylane_camera_rays(&camera, width, height, origins.data(),
                                                      leaves_out ? nullptr : directions.data());
    check(status, leaves_out);
    check(raylane_camera_on_all(scene, vector_of(bytes), bytes.any_float(), &camera),
          scene == nullptr);
}

void look_at(raylane_scene* scene, Bytes& bytes) {
    raylane_vec3 lower{}, upper{};
    raylane_scene_bounds(scene, bytes.flag() ? &lower : nullptr, bytes.flag() ? &upper : nullptr);
    if (raylane_shape_count(scene) != 0 && raylane_material_count(scene) == 0)
        found("shapes of no material");
    const auto id = static_cast<std::uint32_t>(bytes.below(20));
    raylane_material material;
    std::uint32_t index = 0;
    check(raylane_scene_material(scene, id, &material), scene == nullptr);
    check(raylane_scene_material_of(scene, id, &index), scene == nullptr);
    check(raylane_scene_solid_of(scene, id, &index), scene == nullptr);
    check(raylane_scene_material(scene, id, nullptr), true);
    char name[8];
    std::size_t length = 0, count = 0;
    check(raylane_scene_material_name(scene, id, name, static_cast<std::size_t>(bytes.below(9)),
                                      &length),
          scene == nullptr);
    raylane_light lights[4];
    check(raylane_scene_lights(scene, lights, static_cast<std::size_t>(bytes.below(5)), &count),
          scene == nullptr);
    int type = -1;
    double numbers[RAYLANE_MAX_NUMBERS];
    check(raylane_scene_shape(scene, id, &type, numbers), scene == nullptr);
    raylane_double_sphere spheres[4];
    check(raylane_scene_spheres(scene, nullptr, nullptr, spheres,
                                static_cast<std::size_t>(bytes.below(5)), &count),
          scene == nullptr);
}

void write(Bytes& bytes) {
    constexpr const char* paths[] = {"a.png", "a.pfm", "a.tga", "a.hdr",         "a.nothing",
                                     "",      ".",     "/",     "/nowhere/a.png"};
    constexpr int sizes[] = {1, 3, 4, 0, -1};
    const int width = sizes[bytes.below(5)], height = sizes[bytes.below(5)];
    std::vector<float> rgb(36 + 12);
    for (float& component : rgb)
        component = bytes.any_float();
    const int which = bytes.below(10),
              transfer = bytes.below(4) == 0 ? bytes.byte() - 10 : int(RAYLANE_SRGB);
    check(raylane_write_image(which == 9 ? nullptr : paths[which], width, height,
                              bytes.below(16) == 15 ? nullptr : rgb.data(), transfer),
          which == 9);
}

void make_tracer(Handles& handles, Bytes& bytes) {
    raylane_tracer*& slot = slot_of(handles.tracers, bytes);
    const raylane_scene* const scene = slot_of(handles.scenes, bytes);
    raylane_tracer_release(slot);
    slot = nullptr;
    const int precision = bytes.below(4) == 0 ? bytes.byte() - 2 : int(RAYLANE_EXACT);
    check(raylane_tracer_create(scene, bytes.below(4) - 1, precision, &slot), scene == nullptr);
}

void call(Handles& handles, Bytes& bytes) {
    switch (bytes.below(24)) {
    case 16:
    case 17:
    case 18:
        return make_solid(handles, bytes);
    case 0: {
        raylane_builder*& slot = slot_of(handles.builders, bytes);
        raylane_builder_release(slot);
        slot = nullptr;
        if (bytes.below(4) != 0) check(raylane_builder_create(&slot));
        return;
    }
    case 1:
    case 2:
        return add_material(slot_of(handles.builders, bytes), bytes);
    case 3:
    case 4:
    case 5:
        return all_adding[static_cast<std::size_t>(bytes.below(int(std::size(all_adding))))](
            slot_of(handles.builders, bytes), bytes);
    case 6:
        return set_surroundings(slot_of(handles.builders, bytes), bytes);
    case 7: {
        raylane_builder* const builder = slot_of(handles.builders, bytes);
        const raylane_settings settings = any_settings(bytes);
        return check(raylane_set_settings(builder, &settings), builder == nullptr);
    }
    case 8:
    case 9:
        return make_scene(handles, bytes);
    case 10:
        return make_tracer(handles, bytes);
    case 11:
        return ask<OfFloats>(slot_of(handles.tracers, bytes), bytes);
    case 12:
        return ask<OfDoubles>(slot_of(handles.tracers, bytes), bytes);
    case 19:
        return bytes.flag() ? ask_points<OfFloats>(slot_of(handles.tracers, bytes), bytes)
                            : ask_points<OfDoubles>(slot_of(handles.tracers, bytes), bytes);
    case 20:
        return change_transform(handles, bytes);
    case 21:
    case 22:
        return change_group(handles, bytes);
    case 23:
        return ask_camera(slot_of(handles.scenes, bytes), bytes);
    case 13:
        return render(slot_of(handles.scenes, bytes), bytes);
    case 14:
        return bytes.flag() ? write(bytes) : look_at(slot_of(handles.scenes, bytes), bytes);
    default: {
        raylane_scene*& slot = slot_of(handles.scenes, bytes); // tracers keep it
        raylane_scene_release(slot);
        slot = nullptr;
    }
    }
}

/// Fills the first slots, so that few calls have NULL for a handle: a solid, a group, and a scene
/// of shapes, copies or, if `has_solid`, a cut ball, with its tracer.
void fill(Handles& handles, bool has_copies, bool has_solid) {
    raylane_builder* const builder = handles.builders.front();
    const raylane_double_sphere balls[] = {{{0, 0, 0}, 1}, {{2, 0, 0}, 1.5}};
    const raylane_double_box box{{-4, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    const raylane_material material = raylane_default_material();
    check(raylane_add_material(builder, &material, nullptr));
    check(raylane_transform_create(&handles.transforms.front()));
    check(raylane_solid_sphere(&balls[0], 0, &handles.solids.front()));
    check(raylane_solid_box(&box, 0, &handles.solids.back()));
    check(raylane_group_create(&handles.groups.front()));
    check(raylane_group_add_spheres(handles.groups.front(), balls, 2, 0));
    check(raylane_add_boxes_doubles(builder, &box, 1, 0, nullptr));
    raylane_placement placements[2] = {raylane_default_placement(), raylane_default_placement()};
    placements[1].translate.y = 4;
    check(raylane_set_keep_from(builder, has_copies ? 0 : 1000));
    check(raylane_add_copies(builder, handles.groups.front(), placements, 2, 0, nullptr));
    raylane_solid* cut = nullptr;
    check(raylane_solid_difference(handles.solids.front(), &handles.solids.back(), 1, 0, &cut));
    if (has_solid) check(raylane_add_solid(builder, cut, 0, nullptr));
    raylane_solid_release(cut);
    check(raylane_build(builder, &handles.scenes.front()));
    check(
        raylane_tracer_create(handles.scenes.front(), 1, RAYLANE_EXACT, &handles.tracers.front()));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    Handles handles;
    check(raylane_builder_create(&handles.builders.front()));
    if (const int how = bytes.byte(); how % 4 != 0) fill(handles, how % 4 == 1, how % 4 == 2);
    for (int calls = 0; calls < 60 && bytes.any(); ++calls)
        call(handles, bytes);
    return 0;
}
