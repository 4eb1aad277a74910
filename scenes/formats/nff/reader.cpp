#include "scenes/formats/nff/reader.hpp"

#include "core/scene/validate.hpp"
#include "core/shapes/triangle.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/nff/fields.hpp"
#include "scenes/formats/nff/surface.hpp"
#include "scenes/formats/nff/view.hpp"
#include "scenes/formats/triangulate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace raylane::scenes {

namespace {

using core::InvalidValue;
using core::Vec3f;
using core::Visible;

/// A larger count of vertices is treated as an error.
constexpr int max_vertices = 10'000'000;

class Reader {
  public:
    Reader(InputFile& file, core::Workers* workers, const OnRemark& on_remark)
        : file_(file), fields_(file) {
        builder_.workers = workers;
        builder_.on_light_moved = [&](std::size_t i) {
            if (on_remark)
                on_remark(text_of({file_.name(),
                                   {static_cast<std::size_t>(lights_[i].line), 0},
                                   "",
                                   "l: a light on a surface is moved off it"}));
        };
    }
    core::Scene read();

  private:
    struct LightSource {
        Vec3f position;
        std::optional<core::Color> color;
        std::uint64_t line;
    };

    void read_entity();
    void read_view();
    void read_background();
    void read_light();
    void read_fill();
    void read_sphere();
    void read_cone();
    void read_polygon(bool with_normals);

    template <class Triangle>
    void add_polygon(const std::vector<Triangle>& triangles) {
        const core::MaterialIndex material_index = material(Visible::both);
        if (core::first_off_plane<Triangle>(triangles) == triangles.size()) {
            builder_.add_polygon<Triangle>(triangles, material_index);
            return;
        }
        for (const Triangle& triangle : triangles)
            builder_.add(triangle, material_index);
    }

    void require_no_objects() const;
    void begin_objects();
    void add_lights();
    core::MaterialIndex material(Visible visible);
    core::Scene build();

    InputFile& file_;
    NffFields fields_;
    core::SceneBuilder builder_;
    bool has_view_ = false;
    std::vector<LightSource> lights_;
    std::optional<NffMaterials> materials_; // set from the first object on
    NffFill fill_;
    std::optional<core::MaterialIndex> both_sides_, inside_; // fill_'s materials

    ShapeReserve reserve_;

    std::vector<Vec3f> vertices_;
    std::vector<Vec3f> normals_;
    Triangulator triangulator_;
    std::vector<core::Triangle> triangles_;
    std::vector<core::SmoothTriangle> smooth_triangles_;
};

core::Scene Reader::read() {
    while (fields_.next_entity()) {
        try {
            read_entity();
        } catch (const InvalidValue& invalid) {
            fields_.refuse(invalid);
        }
        reserve_.update(builder_, fields_.bytes_passed(), file_);
    }
    return build();
}

void Reader::read_entity() {
    const std::string& entity = fields_.entity();
    if (entity == "s") return read_sphere();
    if (entity == "c") return read_cone();
    if (entity == "p") return read_polygon(false);
    if (entity == "pp") return read_polygon(true);
    if (entity == "f") return read_fill();
    if (entity == "l") return read_light();
    if (entity == "b") return read_background();
    if (entity == "v") return read_view();
    fields_.fail(fields_.line(),
                 "must be one of v, b, l, f, s, c, p and pp, got " + quoted_word(entity));
}

/// Reads the view. If there are several views, the last one counts: NFF's text expects a single
/// view.
void Reader::read_view() {
    require_no_objects();
    const NffView view = read_nff_view(fields_);
    builder_.camera = view.camera;
    builder_.settings.width = view.width;
    builder_.settings.height = view.height;
    // The databases' conventions: no transfer curve, and ray trees of depth 5 including the eye
    // ray.
    builder_.settings.transfer = core::Transfer::linear;
    builder_.settings.max_depth = 4;
    builder_.settings.min_weight = 0.0F;
    core::validate(builder_.settings);
    has_view_ = true;
}

/// Reads the background, which may come anywhere. If there are several backgrounds, the last one
/// counts.
void Reader::read_background() {
    builder_.background = fields_.triple("color");
    core::validate_color("color", builder_.background);
}

/// Reads a light. It has a colour if its line has more words.
void Reader::read_light() {
    require_no_objects();
    LightSource light{fields_.triple("position"), std::nullopt, fields_.line()};
    if (!fields_.at_line_end()) light.color = fields_.vector_on_line("color");
    core::validate(
        core::Light{.position = light.position, .color = light.color.value_or(core::Color(1.0F))});
    lights_.push_back(light);
}

void Reader::read_fill() {
    fill_.color = fields_.triple("color");
    fill_.kd = fields_.number("Kd");
    fill_.ks = fields_.number("Ks");
    fill_.shine = fields_.number("Shine");
    fill_.t = fields_.number("T");
    fill_.index = fields_.number("index of refraction");
    validate(fill_);
    both_sides_.reset();
    inside_.reset();
}

void Reader::read_sphere() {
    begin_objects();
    core::Sphere sphere{fields_.triple("center"), fields_.number("radius")};
    const Visible visible = sphere.radius < 0.0F ? Visible::inside : Visible::both;
    sphere.radius = std::abs(sphere.radius);
    builder_.add(sphere, material(visible));
}

void Reader::read_cone() {
    begin_objects();
    const Vec3f base = fields_.triple("base");
    const float base_radius = fields_.number("base radius");
    const Vec3f apex = fields_.triple("apex");
    const float apex_radius = fields_.number("apex radius");
    if (base == apex) throw InvalidValue("apex", "must differ from the base, got the same point");
    if (std::min(base_radius, apex_radius) < 0.0F && std::max(base_radius, apex_radius) > 0.0F)
        throw InvalidValue("radii", "must not be of different signs, got " + to_text(base_radius) +
                                        " and " + to_text(apex_radius));

    const bool inside = base_radius < 0.0F || apex_radius < 0.0F;
    const core::MaterialIndex index = material(inside ? Visible::inside : Visible::both);
    // NFF's text puts the smaller radius at the apex. This reader accepts either order.
    if (base_radius == apex_radius)
        builder_.add(core::OpenCylinder{base, apex - base, std::abs(base_radius)}, index);
    else
        builder_.add(
            core::OpenCone{base, apex - base, std::abs(base_radius), std::abs(apex_radius)}, index);
}

/// Takes as the front the side from which the vertices run counter-clockwise, by the area of the
/// whole polygon. NFF's text decides by the turn at the second vertex. Both rules agree for the
/// polygons that the text permits.
void Reader::read_polygon(bool with_normals) {
    begin_objects();
    vertices_.clear();
    normals_.clear();
    const int count = fields_.whole_number("number of vertices", 3, max_vertices);
    for (int i = 1; i <= count; ++i) {
        fields_.begin_vertex(i, count);
        vertices_.push_back(fields_.triple("position"));
        for (int axis = 0; axis < 3; ++axis)
            if (const float coordinate = vertices_.back()[axis];
                std::abs(coordinate) > core::coordinate_limit)
                fields_.refuse("position", "must be numbers from -1e30 to 1e30",
                               to_text(coordinate));
        if (!with_normals) continue;
        normals_.push_back(fields_.triple("normal"));
        if (normals_.back() == Vec3f(0.0F))
            fields_.refuse("normal", "must not be the zero vector", "0 0 0");
    }
    const std::span<const Triangulator::Corners> corners = triangulator_.triangulate(vertices_);
    if (corners.empty())
        throw InvalidValue("", "must have an area, got " + std::to_string(count) +
                                   " vertices without one");
    const auto& v = vertices_;
    const auto& n = normals_;
    if (with_normals) {
        smooth_triangles_.clear();
        for (const auto& [a, b, c] : corners)
            smooth_triangles_.push_back({v[a], v[b], v[c], n[a], n[b], n[c]});
        add_polygon(smooth_triangles_);
    } else {
        triangles_.clear();
        for (const auto& [a, b, c] : corners)
            triangles_.push_back({v[a], v[b], v[c]});
        add_polygon(triangles_);
    }
}

void Reader::require_no_objects() const {
    if (materials_) throw InvalidValue("", "must come before the objects, got it after them");
}

/// Requires a view, then adds the lights. Views and lights "must be defined before any objects",
/// and a material's ambient light depends on the number of lights.
void Reader::begin_objects() {
    if (materials_) return;
    if (!has_view_) throw InvalidValue("", "must come after the v entity, got it before");
    add_lights();
    materials_.emplace(builder_, nff_intensity(lights_.size()));
}

void Reader::add_lights() {
    const core::Color usual(nff_intensity(lights_.size()));
    for (const LightSource& light : lights_)
        builder_.add_light({.position = light.position, .color = light.color.value_or(usual)});
}

/// Returns the index of the current fill's material. NFF's text says "Objects are normally
/// considered one sided". This permits culling, but no image of the databases shows it, and the
/// Readme withdraws it for the teapot. So only a negative radius, which asks for one side, hides
/// the other side.
core::MaterialIndex Reader::material(Visible visible) {
    std::optional<core::MaterialIndex>& index = visible == Visible::inside ? inside_ : both_sides_;
    if (!index) index = materials_->index_of(fill_, visible);
    return *index;
}

core::Scene Reader::build() {
    if (!has_view_) throw BadInput(file_.name(), "", "must have a v entity, got none");
    if (!materials_) add_lights();
    try {
        return std::move(builder_).build();
    } catch (const InvalidValue& invalid) {
        constexpr std::string_view lights = "lights/";
        std::size_t light = 0;
        const char* const end = invalid.field.data() + invalid.field.size();
        if (!invalid.field.starts_with(lights)) throw BadInput(file_.name(), "", invalid.what());
        const char* const rest =
            std::from_chars(invalid.field.data() + lights.size(), end, light).ptr;
        const std::string field(std::min(rest + 1, end), end);
        fields_.fail(lights_.at(light).line, "l: " + field + ": " + invalid.expectation);
    }
}

} // namespace

core::Scene read_nff(InputFile& file, core::Workers* workers, const OnRemark& on_remark) {
    return Reader(file, workers, on_remark).read();
}

} // namespace raylane::scenes
