#include "scenes/export/staging_in_json.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/json/limits.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace raylane::scenes {

namespace {

/// Writes objects, one key after the other.
class Object {
  public:
    explicit Object(TextFile& file, const char* separator = ", ")
        : file_(file), separator_(separator) {
        file_ << "{";
    }
    ~Object() { file_ << "}"; }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    TextFile& key(const char* name) {
        if (!std::exchange(first_, false)) file_ << separator_;
        return file_ << "\"" << name << "\": ";
    }
    void text(const char* name, std::string_view value) { key(name) << "\"" << value << "\""; }
    void number(const char* name, auto value) { key(name) << value; }
    template <class Real>
    void vector(const char* name, const core::Vec3<Real>& value) {
        key(name) << "[";
        file_.list(value, ", ") << "]";
    }
    template <class Real>
    void vectors(const char* name, std::initializer_list<core::Vec3<Real>> values) {
        key(name) << "[";
        bool first = true;
        for (const core::Vec3<Real>& value : values) {
            file_ << (std::exchange(first, false) ? "[" : ", [");
            file_.list(value, ", ") << "]";
        }
        file_ << "]";
    }

  private:
    TextFile& file_;
    const char* separator_;
    bool first_ = true;
};

void write_pattern(Object& material, TextFile& file, const core::Pattern& pattern) {
    using core::PatternKind;
    if (pattern.kind == PatternKind::solid) {
        material.vector("color", pattern.colors[0]);
        return;
    }
    material.key("pattern");
    Object object(file);
    if (pattern.kind == PatternKind::back_plane) {
        object.text("type", "back-plane");
        return;
    }
    object.text("type", pattern.kind == PatternKind::checker   ? "checker"
                        : pattern.kind == PatternKind::stripes ? "stripes"
                                                               : "gradient");
    object.vectors("colors", {pattern.colors[0], pattern.colors[1]});
    if (pattern.kind == PatternKind::checker) {
        object.number("size", pattern.size);
        std::string axes;
        for (int axis = 0; axis < 3; ++axis)
            if ((pattern.axes >> axis & 1) != 0) axes += "xyz"[axis];
        object.text("axes", axes);
    } else if (pattern.kind == PatternKind::stripes) {
        object.number("width", pattern.size);
        object.vector("direction", pattern.direction);
    } else {
        object.vector("from", pattern.from);
        object.vector("to", pattern.to);
    }
}

void write_material(TextFile& file, const core::Material& material) {
    Object object(file);
    write_pattern(object, file, material.pattern);
    object.number("ambient", material.ambient);
    object.number("diffuse", material.diffuse);
    object.number("specular", material.specular);
    object.number("exponent", material.exponent);
    if (material.reflection == core::Reflection::constant)
        object.number("reflectivity", material.reflectivity);
    else
        object.text("reflection",
                    material.reflection == core::Reflection::schlick ? "schlick" : "dielectric");
    object.number("transmission", material.transmission);
    if (material.is_see_through()) object.number("opacity", material.opacity);
    if (material.glass.any()) {
        TextFile& glass = object.key("glass");
        const char* before = "{\"B\": [";
        for (const auto* numbers : {&material.glass.B, &material.glass.C}) {
            glass << before << (*numbers)[0] << ", " << (*numbers)[1] << ", " << (*numbers)[2];
            before = "], \"C\": [";
        }
        glass << "]}";
    } else {
        object.number("index", material.index);
    }
    object.vector("absorption", material.absorption);
    if (material.visible != core::Visible::both)
        object.text("visible", material.visible == core::Visible::outside ? "outside" : "inside");
}

void write_shape(Object& object, const core::SphereOf<double>& s) {
    object.vector("center", s.center);
    object.number("radius", s.radius);
}

void write_shape(Object& object, const core::PlaneOf<double>& s) {
    object.vector("point", s.point);
    object.vector("normal", s.normal);
}

void write_shape(Object& object, const core::DiscOf<double>& s) {
    object.vector("center", s.center);
    object.vector("normal", s.normal);
    object.number("radius", s.radius);
}

void write_corners(Object& object, const auto& s) {
    object.vector("a", s.a);
    object.vector("b", s.b);
    object.vector("c", s.c);
}

void write_shape(Object& object, const core::TriangleOf<double>& s) {
    write_corners(object, s);
}

void write_shape(Object& object, const core::SmoothTriangleOf<double>& s) {
    write_corners(object, s);
    object.vectors("normals", {s.normal_a, s.normal_b, s.normal_c});
}

void write_shape(Object& object, const core::BoxOf<double>& s) {
    object.vector("corner", s.corner);
    object.vectors("edges", {s.edge_u, s.edge_v, s.edge_w});
}

template <core::Ends ends>
void write_shape(Object& object, const core::CylinderOf<double, ends>& s) {
    object.vector("base", s.base);
    object.vector("axis", s.axis);
    object.number("radius", s.radius);
    object.key("capped") << (ends == core::Ends::capped ? "true" : "false");
}

template <core::Ends ends>
void write_shape(Object& object, const core::ConeOf<double, ends>& s) {
    object.vector("base", s.base);
    object.vector("axis", s.axis);
    object.number("base_radius", s.base_radius);
    object.number("top_radius", s.top_radius);
    object.key("capped") << (ends == core::Ends::capped ? "true" : "false");
}

void write_form(Object& object, const core::QuadricOf<double>& s) {
    object.vector("center", s.center);
    const double rows[4][4] = {{s.xx, s.xy, s.xz, s.x},
                               {s.xy, s.yy, s.yz, s.y},
                               {s.xz, s.yz, s.zz, s.z},
                               {s.x, s.y, s.z, s.one}};
    TextFile& file = object.key("matrix");
    for (int row = 0; row < 4; ++row) {
        file << (row == 0 ? "[[" : ", [");
        for (int column = 0; column < 4; ++column)
            file << (column == 0 ? "" : ", ") << rows[row][column];
        file << "]";
    }
    file << "]";
}

void write_shape(Object& object, const core::QuadricOf<double>& s) {
    write_form(object, s);
    object.vector("lower", s.lower);
    object.vector("upper", s.upper);
}

void write_shape(Object& object, const core::EllipsoidOf<double>& s) {
    object.vector("center", s.center);
    object.vectors("axes", {s.axis_u, s.axis_v, s.axis_w});
}

void write_settings(Object& root, TextFile& file, const core::Settings& settings) {
    root.key("image");
    {
        Object image(file);
        image.number("width", settings.width);
        image.number("height", settings.height);
        image.text("transfer", settings.transfer == core::Transfer::srgb ? "srgb" : "linear");
        if (settings.alpha) image.key("alpha") << "true";
    }
    root.key("sampling");
    {
        Object sampling(file);
        sampling.number("grid", settings.grid);
        sampling.text("pattern",
                      settings.samples == core::SamplePattern::regular ? "regular" : "stratified");
        if (settings.filter != core::PixelFilter::box)
            sampling.text("filter", settings.filter == core::PixelFilter::gaussian
                                        ? "gaussian"
                                        : "blackman-harris");
        if (settings.light_samples != core::Settings{}.light_samples)
            sampling.number("light_samples", settings.light_samples);
        if (settings.quality != 0.0F) sampling.number("quality", settings.quality);
    }
    root.key("limits");
    {
        Object limits(file);
        limits.number("max_depth", settings.max_depth);
        limits.number("min_weight", settings.min_weight);
        if (settings.max_see_through != core::Settings::see_through_limit)
            limits.number("max_see_through", settings.max_see_through);
    }
    // Also of lines that are not there, for whoever asks for some.
    const core::Outline &outline = settings.outline, usual{};
    if (outline.any() || outline.color != usual.color || outline.creases != usual.creases) {
        root.key("outline");
        Object object(file);
        object.number("width", outline.width);
        object.vector("color", outline.color);
        object.number("creases", outline.creases);
    }
}

void write_camera(Object& object, const core::Camera& camera) {
    const bool perspective = camera.projection == core::Projection::perspective;
    object.text("type", perspective ? "perspective" : "orthographic");
    object.vector("from", camera.from);
    object.vector("at", camera.at);
    object.vector("up", camera.up);
    if (perspective)
        object.number("field_of_view", camera.field_of_view);
    else
        object.number("height", camera.height);
    if (camera.lens_radius > 0.0F) object.number("lens_radius", camera.lens_radius);
    if (camera.focus_distance > 0.0F) object.number("focus_distance", camera.focus_distance);
}

void write_framing(Object& object, const core::Framing& framing, float depth_cue) {
    const core::Framing usual;
    object.text("type", "auto");
    object.vector("view", framing.direction);
    object.vector("up", framing.up);
    if (framing.zoom != usual.zoom) object.number("zoom", framing.zoom);
    if (framing.projection == core::Projection::orthographic)
        object.key("orthographic") << "true";
    else if (framing.field_of_view != usual.field_of_view)
        object.number("field_of_view", framing.field_of_view);
    if (depth_cue > 0.0F) object.number("depth_cue", depth_cue);
}

/// What of it follows from `staging` is left for the reader to find.
void write_surroundings(Object& root, TextFile& file, const core::Scene& scene,
                        const core::Staging& staging) {
    root.key("camera");
    {
        Object object(file);
        if (staging.framing)
            write_framing(object, *staging.framing, staging.depth_cue);
        else
            write_camera(object, scene.camera());
    }
    root.vector("background", scene.background());
    if (!scene.wavelengths().empty()) {
        TextFile& list = root.key("spectrum");
        const char* before = "{\"wavelengths\": [";
        for (const double wavelength : scene.wavelengths())
            list << std::exchange(before, ", ") << wavelength;
        list << "]}";
    }
    const core::Fog& fog = scene.fog();
    if (fog.kind != core::FogKind::none && !(staging.depth_cue > 0.0F)) {
        root.key("fog");
        Object object(file);
        object.text("type", fog.kind == core::FogKind::linear_z ? "linear-z"
                            : fog.kind == core::FogKind::linear ? "linear"
                                                                : "exponential");
        object.vector("color", fog.color);
        if (fog.kind == core::FogKind::exponential) {
            object.number("density", fog.density);
        } else {
            object.number("start", fog.start);
            object.number("end", fog.end);
        }
    }
}

/// Without those that the camera brings along, if the reader is to find them.
void write_lights(Object& root, TextFile& file, const core::Scene& scene,
                  const core::Staging& staging) {
    root.key("lights") << "[";
    const char* separator = "\n";
    const std::size_t count = staging.lights ? scene.own_light_count() : scene.lights().size();
    for (std::size_t i = 0; i < count; ++i) {
        const core::Light& light = scene.lights()[i];
        file << std::exchange(separator, ",\n");
        Object object(file);
        switch (light.kind) {
        case core::LightKind::point:
            object.text("type", "point");
            object.vector("position", light.position);
            break;
        case core::LightKind::directional:
            object.text("type", "directional");
            object.vector("direction", light.direction);
            break;
        case core::LightKind::sky:
            object.text("type", "sky");
            object.vector("direction", light.direction);
            object.vector("ground", light.ground);
            if (light.reach < std::numeric_limits<float>::infinity())
                object.number("reach", light.reach);
            break;
        case core::LightKind::sphere:
            object.text("type", "sphere");
            object.vector("position", light.position);
            object.number("radius", light.radius);
            break;
        case core::LightKind::disc:
            object.text("type", "disc");
            object.vector("position", light.position);
            object.vector("direction", light.direction);
            object.number("radius", light.radius);
            break;
        case core::LightKind::rectangle:
            object.text("type", "rectangle");
            object.vector("position", light.position);
            object.vector("edge_u", light.edge_u);
            object.vector("edge_v", light.edge_v);
            break;
        }
        object.vector("color", light.color);
    }
    if (staging.lights) file << separator << R"({"type": "camera"})";
    file << "]";
}

/// Without the box of a quadric, which is a half-space there.
void write_part(Object& object, const core::QuadricOf<double>& s) {
    write_form(object, s);
}
template <class Shape>
void write_part(Object& object, const Shape& shape) {
    write_shape(object, shape);
}

/// Levels of objects and lists that it is written with.
std::size_t levels_of(const core::Solid& solid) {
    if (solid.made == core::Made::of_shape)
        return std::visit(
            []<class Shape>(const Shape&) {
                constexpr core::Kind kind = core::kind_of<Shape>;
                constexpr bool has_rows = kind == core::Kind::box ||
                                          kind == core::Kind::ellipsoid ||
                                          kind == core::Kind::quadric;
                return std::size_t{has_rows ? 3 : 2};
            },
            solid.shape);
    std::size_t levels = 0;
    for (const core::Solid& part : solid.parts)
        levels = std::max(levels, levels_of(part));
    return levels + 2;
}

void write_solid(TextFile& file, const core::Solid& solid) {
    static constexpr std::string_view types[] = {"", "union", "intersection", "difference", "clip"};
    Object object(file);
    if (solid.material != core::no_material)
        object.text("material", std::to_string(solid.material));
    if (solid.made == core::Made::of_shape) {
        std::visit(
            [&]<class Shape>(const Shape& shape) {
                object.text("type", core::type_name_of(core::kind_of<Shape>));
                write_part(object, shape);
            },
            solid.shape);
        return;
    }
    object.text("type", types[static_cast<int>(solid.made)]);
    object.key("objects") << "[";
    const char* separator = "";
    for (const core::Solid& part : solid.parts) {
        file << std::exchange(separator, ",\n");
        write_solid(file, part);
    }
    file << "]";
}

void write_materials(Object& root, TextFile& file, const core::Scene& scene) {
    root.key("materials") << "{";
    const char* separator = "\n";
    for (std::size_t i = 0; i < scene.materials().size(); ++i) {
        file << std::exchange(separator, ",\n") << "\"" << std::to_string(i) << "\": ";
        write_material(file, scene.materials()[i]);
    }
    file << "}";
}

void write_all_but_objects(Object& root, TextFile& file, const core::Scene& scene,
                           const core::Staging& staging) {
    write_settings(root, file, scene.settings());
    write_surroundings(root, file, scene, staging);
    write_lights(root, file, scene, staging);
    write_materials(root, file, scene);
}

} // namespace

Differences write_json(TextFile& file, const core::Scene& scene) {
    const core::Staging staging = staging_in_json(scene);
    Differences differences = lost_staging(scene.staging(), staging);
    if (!scene.polygons().empty()) differences.insert(lost_polygons);
    Object root(file, ",\n");
    file << "\n";
    write_all_but_objects(root, file, scene, staging);
    root.key("objects") << "[";
    const char* separator = "\n";
    for_each_by_id(
        scene,
        [&]<class Shape>(const Shape& shape, core::ShapeId id) {
            file << std::exchange(separator, ",\n");
            Object object(file);
            object.text("type", core::type_name_of(core::kind_of<Shape>));
            write_shape(object, shape);
            object.text("material", std::to_string(scene.material_index_of(id)));
        },
        [&](const core::Solid& solid, core::ShapeId) {
            if (const std::size_t levels = levels_of(solid); levels > most_levels)
                throw core::InvalidValue(
                    "", "cannot have a solid of more than " + std::to_string(most_levels) +
                            " levels of objects and lists, for none is read, got " +
                            std::to_string(levels));
            file << std::exchange(separator, ",\n");
            write_solid(file, solid);
        });
    file << "\n]";
    return differences;
}

void write_json_without_objects(TextFile& file, const core::Scene& scene) {
    Object root(file, ",\n");
    file << "\n";
    write_all_but_objects(root, file, scene, {});
    root.key("objects") << "[]";
}

void write_json_settings(TextFile& file, const core::Settings& settings) {
    Object root(file);
    write_settings(root, file, settings);
}

void write_json_without_shapes(TextFile& file, const core::Scene& scene) {
    Object root(file, ",\n");
    file << "\n";
    write_surroundings(root, file, scene, {});
    write_lights(root, file, scene, {});
    write_materials(root, file, scene);
    root.key("objects") << "[";
    const char* separator = "\n";
    for (core::ShapeId id = 0; scene.solids().any() && id < scene.shape_count(); ++id) {
        if (!scene.solids().has(id) || scene.solids().solid_of(id) != id) continue;
        file << std::exchange(separator, ",\n");
        write_solid(
            file, core::description_of(scene, scene.solids().root_of(scene.solids().part_of(id))));
    }
    file << "\n]";
}

} // namespace raylane::scenes
