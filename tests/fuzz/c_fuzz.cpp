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
    std::array<raylane_solid*, slots> solids{};
    std::array<raylane_scene*, slots> scenes{};
    std::array<raylane_tracer*, slots> tracers{};

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        for (int i = 0; i < slots; ++i) {
            const auto slot = static_cast<std::size_t>(i);
            raylane_builder_release(builders[slot]);
            raylane_solid_release(solids[slot]);
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

constexpr void (*all_adding[])(raylane_builder*,
                               Bytes&) = {add_by<raylane_add_spheres>,
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
    const raylane_solid* const whole = slot_of(handles.solids, bytes);
    const bool leaves_out = bytes.below(32) == 31;
    has_null = has_null || (leaves_out && !parts.empty());
    const raylane_solid* const* const all = leaves_out ? nullptr : parts.data();
    const auto material = static_cast<std::uint32_t>(bytes.below(4) - 1);
    const auto checked = [](raylane_status status, bool null) {
        check(status, null);
        return status;
    };
    switch (bytes.below(4)) {
    case 0:
        return checked(raylane_solid_union(all, parts.size(), material, to), has_null);
    case 1:
        return checked(raylane_solid_intersection(all, parts.size(), material, to), has_null);
    case 2:
        return checked(raylane_solid_difference(whole, all, parts.size(), material, to),
                       has_null || whole == nullptr);
    default:
        return checked(raylane_solid_clipped(whole, all, parts.size(), material, to),
                       has_null || whole == nullptr);
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
    if (bytes.flag())
        combine(handles, to, bytes);
    else
        all_solids[static_cast<std::size_t>(bytes.below(int(std::size(all_solids))))](to, bytes);
    if (made == nullptr) return;
    raylane_solid*& slot = slot_of(handles.solids, bytes);
    raylane_solid_release(slot);
    slot = made;
}

void add_material(raylane_builder* builder, Bytes& bytes) {
    raylane_material material = raylane_default_material();
    const int changes = bytes.byte();
    if ((changes & 1) != 0) material.pattern.kind = enumerator(bytes, 5);
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
    const std::uint64_t all = first[count];
    const int columns = reads(raylane_rows_t(rows), all) + reads(raylane_rows_length(rows), all) +
                        reads(raylane_rows_on_surface(rows), all);
    if (columns != (all != 0 ? 1 : 0)) found("columns of another query");
    reads(raylane_rows_shape_id(rows), all);
    reads(raylane_rows_material(rows), all);
    reads(raylane_rows_entering(rows), all);
    reads(raylane_rows_face(rows), all);
    reads(raylane_rows_tied(rows), all);
    reads(raylane_rows_touching(rows), all);
    for (const auto normal : {raylane_rows_normal_x, raylane_rows_normal_y, raylane_rows_normal_z})
        reads(normal(rows), all);
    raylane_rows_release(rows);
}

template <class CRays, class Crossings, class Lengths>
void ask_rows(const raylane_tracer* tracer, const CRays& rays, bool has_null, Bytes& bytes,
              const Crossings& crossings, const Lengths& lengths) {
    raylane_rows* rows = nullptr;
    const auto most = static_cast<std::size_t>(bytes.below(4));
    const int normals = bytes.flag() ? 1 : 0;
    check_rows(crossings(tracer, &rays, most, normals, &rows), has_null, rows, rays.count);
    rows = nullptr;
    check_rows(lengths(tracer, &rays, &rows), has_null, rows, rays.count);
    check(crossings(tracer, &rays, most, normals, nullptr), true);
}

template <class Real, class CPoints, class Contains>
void ask_points(const raylane_tracer* tracer, Bytes& bytes, const Contains& contains) {
    const auto count = static_cast<std::size_t>(bytes.below(20));
    Arrays<Real> reals(count, bytes);
    std::uint64_t refused = 0;
    CPoints points{};
    points.count = count;
    points.refused = bytes.flag() ? &refused : nullptr;
    bool has_null = tracer == nullptr;
    for (const Real** array : {&points.x, &points.y, &points.z}) {
        *array = reals.make(false, [&] { return static_cast<Real>(bytes.any_float()); });
        has_null = has_null || (*array == nullptr && count != 0);
    }
    raylane_rows* rows = nullptr;
    check_rows(contains(tracer, &points, &rows), has_null, rows, count);
    if (refused > count) found("more refused points than points");
}

template <class Real, class CRays, class Intersect, class Occluded, class Count, class Crossings,
          class Lengths>
void ask(const raylane_tracer* tracer, Bytes& bytes, const Intersect& intersect,
         const Occluded& occluded, const Count& count_crossings, const Crossings& crossings,
         const Lengths& lengths) {
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
    for (double** array :
         {&hits.t_double, &hits.normal_double_x, &hits.normal_double_y, &hits.normal_double_z})
        *array = doubles.make(true, [] { return -7777.0; });
    const raylane_status status = intersect(tracer, &rays, &hits);
    check(status, has_null);
    std::uint8_t* const blocked = flags.make(false, [] { return std::uint8_t{77}; });
    const raylane_status of_blocked = occluded(tracer, &rays, blocked);
    check(of_blocked, has_null || (blocked == nullptr && count != 0));
    ask_rows(tracer, rays, has_null, bytes, crossings, lengths);
    Arrays<std::uint64_t> numbers(count, bytes);
    std::uint64_t* const counts = numbers.make(false, [] { return std::uint64_t{777777}; });
    const raylane_status of_counts = count_crossings(tracer, &rays, counts);
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
    const auto id = static_cast<std::uint32_t>(bytes.below(20));
    raylane_material material;
    std::uint32_t index = 0;
    check(raylane_scene_material(scene, id, &material), scene == nullptr);
    check(raylane_scene_material_of(scene, id, &index), scene == nullptr);
    check(raylane_scene_solid_of(scene, id, &index), scene == nullptr);
    check(raylane_scene_material(scene, id, nullptr), true);
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
    switch (bytes.below(20)) {
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
                                        raylane_occluded, raylane_count_crossings,
                                        raylane_crossings, raylane_path_lengths);
    case 12:
        return ask<double, raylane_double_rays>(
            slot_of(handles.tracers, bytes), bytes, raylane_intersect_doubles,
            raylane_occluded_doubles, raylane_count_crossings_doubles, raylane_crossings_doubles,
            raylane_path_lengths_doubles);
    case 19:
        return bytes.flag() ? ask_points<float, raylane_points>(slot_of(handles.tracers, bytes),
                                                                bytes, raylane_contains)
                            : ask_points<double, raylane_double_points>(
                                  slot_of(handles.tracers, bytes), bytes, raylane_contains_doubles);
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
