#include "raylane/raylane.h"
#include "tests/fuzz/bytes.hpp"

#include <climits>

#include <array>
#include <memory>
#include <string>
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
    std::array<raylane_scene*, slots> scenes{};
    std::array<raylane_tracer*, slots> tracers{};

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        for (int i = 0; i < slots; ++i) {
            const auto slot = static_cast<std::size_t>(i);
            raylane_builder_release(builders[slot]);
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

raylane_vec3 vector_of(Bytes& bytes) {
    const float x = bytes.any_float(), y = bytes.any_float();
    return {x, y, bytes.any_float()};
}
std::uint8_t enumerator(Bytes& bytes, int count) {
    const int any = bytes.byte();
    return static_cast<std::uint8_t>(any < 240 ? any % count : any);
}

template <class Shape>
using AddShapes = raylane_status (*)(raylane_builder*, const Shape*, size_t, uint32_t, uint32_t*);

template <class Shape>
void add(AddShapes<Shape> add_shapes, raylane_builder* builder, Bytes& bytes) {
    const auto count = static_cast<std::size_t>(bytes.below(8));
    std::vector<Shape> shapes(count);
    for (Shape& shape : shapes) {
        float numbers[sizeof(Shape) / sizeof(float)];
        for (float& number : numbers)
            number = bytes.any_float();
        std::memcpy(&shape, numbers, sizeof shape);
    }
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

constexpr void (*all_adding[])(raylane_builder*, Bytes&) = {add_by<raylane_add_spheres>,
                                                            add_by<raylane_add_planes>,
                                                            add_by<raylane_add_discs>,
                                                            add_by<raylane_add_triangles>,
                                                            add_by<raylane_add_smooth_triangles>,
                                                            add_by<raylane_add_boxes>,
                                                            add_by<raylane_add_open_cylinders>,
                                                            add_by<raylane_add_capped_cylinders>,
                                                            add_by<raylane_add_open_cones>,
                                                            add_by<raylane_add_capped_cones>,
                                                            add_by<raylane_add_quadrics>,
                                                            add_by<raylane_add_ellipsoids>,
                                                            add_by<raylane_add_polygon>};

void add_material(raylane_builder* builder, Bytes& bytes) {
    raylane_material material = raylane_default_material();
    const int changes = bytes.byte();
    if ((changes & 1) != 0) material.pattern.kind = enumerator(bytes, 5);
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
}

void set_surroundings(raylane_builder* builder, Bytes& bytes) {
    switch (bytes.below(4)) {
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

template <class Real, class CRays, class Intersect, class Occluded>
void ask(const raylane_tracer* tracer, Bytes& bytes, const Intersect& intersect,
         const Occluded& occluded) {
    const auto count = static_cast<std::size_t>(bytes.below(40));
    Arrays<Real> reals(count, bytes);
    Arrays<std::uint32_t> ids(count, bytes);
    Arrays<std::uint8_t> flags(count, bytes);
    const auto number = [&] { return static_cast<Real>(bytes.any_float()); };
    CRays rays{};
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
    hits.shape = ids.make(true, [] { return std::uint32_t{77777}; });
    hits.entering = flags.make(true, [] { return std::uint8_t{77}; });
    hits.face = flags.make(true, [] { return std::uint8_t{77}; });
    hits.t_double = doubles.make(true, [] { return -7777.0; });
    const raylane_status status = intersect(tracer, &rays, &hits);
    check(status, has_null);
    std::uint8_t* const blocked = flags.make(false, [] { return std::uint8_t{77}; });
    const raylane_status of_blocked = occluded(tracer, &rays, blocked);
    check(of_blocked, has_null || (blocked == nullptr && count != 0));
    for (std::size_t i = 0; i < count; ++i) {
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
    switch (bytes.below(4)) {
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
    raylane_scene*& slot = slot_of(handles.scenes, bytes);
    if (made == nullptr) return;
    raylane_scene_release(slot);
    slot = made;
}

void look_at(raylane_scene* scene, Bytes& bytes) {
    raylane_vec3 lower{}, upper{};
    raylane_scene_bounds(scene, bytes.flag() ? &lower : nullptr, bytes.flag() ? &upper : nullptr);
    if (raylane_shape_count(scene) != 0 && raylane_material_count(scene) == 0)
        found("shapes of no material");
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

void call(Handles& handles, Bytes& bytes) {
    switch (bytes.below(16)) {
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
        return all_adding[bytes.below(13)](slot_of(handles.builders, bytes), bytes);
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
    case 10: {
        raylane_tracer*& slot = slot_of(handles.tracers, bytes);
        const raylane_scene* const scene = slot_of(handles.scenes, bytes);
        raylane_tracer_release(slot);
        slot = nullptr;
        const int precision = bytes.below(4) == 0 ? bytes.byte() - 2 : int(RAYLANE_EXACT);
        return check(raylane_tracer_create(scene, bytes.below(4) - 1, precision, &slot),
                     scene == nullptr);
    }
    case 11:
        return ask<float, raylane_rays>(slot_of(handles.tracers, bytes), bytes, raylane_intersect,
                                        raylane_occluded);
    case 12:
        return ask<double, raylane_double_rays>(slot_of(handles.tracers, bytes), bytes,
                                                raylane_intersect_doubles,
                                                raylane_occluded_doubles);
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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    Handles handles;
    check(raylane_builder_create(&handles.builders.front()));
    for (int calls = 0; calls < 60 && bytes.any(); ++calls)
        call(handles, bytes);
    return 0;
}
