#include "core/scene/camera_rays.hpp"
#include "core/scene/pattern.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/solid.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/formats/pov/scanner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

/// Deepest nesting of solids that raylane's reader of POV-Ray scenes accepts.
constexpr int max_depth = 125;

using pov::is_letter;

/// Returns the identifier for a material's name, or "" if the name has characters that identifiers
/// cannot have. POV-Ray's reserved words, including those that later versions add, have no
/// capitals, and never begin with m and an underscore or a digit.
std::string identifier_of(std::string_view name) {
    constexpr std::size_t longest = 32;
    const bool is_identifier =
        !name.empty() && name.size() <= longest && is_letter(name.front()) &&
        std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
    if (!is_identifier) return "";
    const bool is_own =
        std::any_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; }) ||
        (name.size() > 1 && name[0] == 'm' && (name[1] == '_' || is_digit(name[1])));
    return (is_own ? "" : "m_") + std::string(name);
}

/// Returns an identifier for each material, from its name or its number. All differ.
std::vector<std::string> identifiers_of(const core::Scene& scene) {
    std::vector<std::string> identifiers(scene.materials().size());
    std::set<std::string> taken;
    std::map<std::string, std::size_t> last; // last suffix of a name that materials share
    const auto take = [&](std::size_t index, const std::string& wanted) {
        std::string name = wanted;
        while (!taken.insert(name).second)
            name = wanted + '_' + std::to_string(++last.try_emplace(wanted, 1).first->second);
        identifiers[index] = name;
    };
    for (std::size_t i = 0; i < identifiers.size(); ++i) {
        const std::string name =
            identifier_of(scene.material_name(static_cast<core::MaterialIndex>(i)));
        if (!name.empty()) take(i, name);
    }
    for (std::size_t i = 0; i < identifiers.size(); ++i)
        if (identifiers[i].empty()) take(i, "m" + std::to_string(i));
    return identifiers;
}

class PovWriter {
  public:
    PovWriter(TextFile& file, const core::Scene& scene, Differences& differences)
        : file_(file), scene_(scene), differences_(differences),
          identifiers_(identifiers_of(scene)),
          eye_(core::convert<core::Bounded<double>>(scene.camera().from)) {}

    void write() {
        const core::Settings& settings = scene_.settings();
        // Without assumed_gamma, or with POV-Ray's default, the colours would differ.
        const bool is_srgb = settings.transfer == core::Transfer::srgb;
        file_ << "// povray +W" << settings.width << " +H" << settings.height
              << " +A0.3\n#version 3.7;\nglobal_settings { assumed_gamma "
              << (is_srgb ? "1" : "srgb") << " max_trace_level " << trace_level() << " adc_bailout "
              << settings.min_weight << " }\nbackground { color rgb ";
        vector(scene_.background()) << " }\n";
        if (!scene_.wavelengths().empty())
            differences_.insert("the spectrum (glass has one index)");
        if (scene_.settings().outline.any()) differences_.insert("the outline");
        if (scene_.settings().alpha) differences_.insert("alpha (use +ua)");
        if (!scene_.settings().transparent_shadows)
            differences_.insert("transparent_shadows (all shadows are there)");
        if (!scene_.polygons().empty()) differences_.insert(lost_polygons);
        write_camera();
        write_fog();
        for (const core::Light& light : scene_.lights())
            write_light(light);
        for (std::size_t i = 0; i < scene_.materials().size(); ++i)
            write_material(i, scene_.materials()[i]);
        const auto write_solid_of_others = [&](const core::Solid& solid, core::ShapeId id) {
            if (const int depth = core::depth_of(solid); depth > max_depth)
                throw core::InvalidValue("", "must not have solids nested more than " +
                                                 std::to_string(max_depth) + " deep, got " +
                                                 std::to_string(depth));
            const core::MaterialIndex medium = scene_.medium_index_of(id);
            write_solid(solid, lets_light_pass(solid, medium));
            file_ << "\n";
            if (scene_.materials()[medium].transmits()) note_surfaces(solid, id);
            if (misleads(medium) && is_inside(solid)) differences_.insert(misled);
        };
        for_each_by_id(
            scene_,
            [&](const auto& shape, core::ShapeId id) {
                write_shape(shape);
                if (is_open(shape) && scene_.material_of(id).transmits())
                    differences_.insert(
                        "bodies enclosed by several transmissive surfaces (each becomes a body)");
                if (misleads(scene_.material_index_of(id)) &&
                    core::inside_of(shape, eye_) == core::Value::yes)
                    differences_.insert(misled);
                write_use(scene_.material_index_of(id));
                file_ << " }\n";
            },
            write_solid_of_others);
    }

  private:
    /// Returns true if a shape is a part of a body's surface, and not all of it.
    template <class Shape>
    static bool is_open(const Shape&) {
        return core::is_bounded<Shape> && !core::is_solid<Shape>;
    }

    /// POV-Ray needs an index for Fresnel reflection even of an opaque body. A camera inside that
    /// body is then in a medium of that index.
    static constexpr const char* misled =
        "opaque bodies with Fresnel reflection around the camera (their index fills the scene)";
    bool misleads(core::MaterialIndex index) const {
        const core::Material& material = scene_.materials()[index];
        return material.reflection != core::Reflection::constant && !material.lets_light_pass();
    }

    bool is_inside(const core::Solid& solid) const {
        const auto inside = [&](const core::Solid& part) { return is_inside(part); };
        switch (solid.made) {
        case core::Made::by_union:
            return std::any_of(solid.parts.begin(), solid.parts.end(), inside);
        case core::Made::by_intersection:
            return std::all_of(solid.parts.begin(), solid.parts.end(), inside);
        case core::Made::by_difference:
            return inside(solid.parts.front()) &&
                   std::none_of(solid.parts.begin() + 1, solid.parts.end(), inside);
        case core::Made::by_clip:
            return inside(solid.parts.front());
        case core::Made::of_shape:
            break;
        }
        return std::visit(
            [&](const auto& shape) { return core::inside_of(shape, eye_) == core::Value::yes; },
            solid.shape);
    }

    /// Returns true if the solid or one of its parts lets light pass. Parts without a material have
    /// `material`.
    bool lets_light_pass(const core::Solid& solid, core::MaterialIndex material) const {
        return scene_.materials()[material].lets_light_pass() ||
               std::any_of(solid.parts.begin(), solid.parts.end(), [&](const core::Solid& part) {
                   return lets_light_pass(part, part.material != core::no_material ? part.material
                                                                                   : material);
               });
    }

    /// Notes surfaces that two bodies share: in POV-Ray it is uncertain which body is behind such a
    /// surface.
    void note_surfaces(const core::Solid& solid, core::ShapeId id) {
        for (const core::Solid& part : solid.parts)
            note_surfaces(part, id);
        if (solid.made != core::Made::of_shape) return;
        const auto [known, is_new] = surfaces_.try_emplace(
            std::visit([](const auto& shape) { return surface_of(shape); }, solid.shape), id);
        if (!is_new && known->second != id)
            differences_.insert(
                "surfaces shared by two transmissive bodies (such as cemented lenses)");
    }
    /// Identifies a surface by its kind and numbers, regardless of its orientation and its bounds.
    using Surface = std::vector<double>;
    template <class Shape>
    static Surface surface_of(const Shape& shape) {
        Surface surface;
        const auto add = [&](const auto& numbers) {
            surface.insert(surface.end(), std::begin(numbers), std::end(numbers));
        };
        if constexpr (std::is_same_v<Shape, core::PlaneOf<double>>)
            add(std::array{shape.normal.x, shape.normal.y, shape.normal.z,
                           core::dot(shape.normal, shape.point)});
        else if constexpr (std::is_same_v<Shape, core::QuadricOf<double>>)
            add(std::array{shape.xx, shape.yy, shape.zz, shape.xy, shape.xz, shape.yz, shape.x,
                           shape.y, shape.z, shape.one});
        if (const auto sign = std::find_if(surface.begin(), surface.end(),
                                           [](double number) { return number != 0.0; });
            sign != surface.end() && *sign < 0.0)
            for (double& number : surface)
                number = 0.0 - number;
        if constexpr (std::is_same_v<Shape, core::QuadricOf<double>>)
            add(std::array{shape.center.x, shape.center.y, shape.center.z});
        else if constexpr (!std::is_same_v<Shape, core::PlaneOf<double>>)
            add(core::numbers_of(shape));
        surface.push_back(static_cast<double>(core::kind_of<Shape>));
        return surface;
    }

    template <class Real>
    TextFile& vector(const core::Vec3<Real>& v) {
        file_ << "<";
        return file_.list(v, ", ") << ">";
    }
    template <class Real>
    TextFile& vector(const char* word, const core::Vec3<Real>& v) {
        file_ << " " << word << " ";
        return vector(v);
    }
    TextFile& color(const core::Color& c) {
        file_ << "color rgb ";
        return vector(c);
    }

    void write_camera() {
        const core::Camera& camera = scene_.camera();
        const core::Settings& settings = scene_.settings();
        const core::CameraRays<double> rays(camera, settings);
        const bool perspective = camera.projection == core::Projection::perspective;
        if (camera.lens_radius > 0.0F) differences_.insert("the camera's lens");
        // POV-Ray's direction has length 1. `right` points left, as the coordinates are
        // right-handed.
        const double height = 2.0 * settings.height * core::length(rays.up());
        const double width = 2.0 * settings.width * core::length(rays.right());
        file_ << "camera { " << (perspective ? "perspective" : "orthographic") << " right <"
              << -width << ", 0, 0> up <0, " << height << ", 0>";
        vector("sky", camera.up);
        vector("location", camera.from);
        vector("look_at", camera.at) << " }\n";
    }

    void write_fog() {
        const core::Fog& fog = scene_.fog();
        if (fog.kind == core::FogKind::none) return;
        if (fog.kind != core::FogKind::exponential) {
            differences_.insert("linear fog");
            return;
        }
        file_ << "fog { fog_type 1 distance " << 1.0F / fog.density << " ";
        color(fog.color) << " }\n";
    }

    void write_light(const core::Light& light) {
        switch (light.kind) {
        case core::LightKind::point:
            file_ << "light_source { ";
            vector(light.position) << " ";
            color(light.color) << " }\n";
            return;
        case core::LightKind::directional: {
            // Scales by a power of two, which keeps the direction exact.
            const Vec3d direction = core::convert<double>(light.direction);
            const double far = std::ldexp(1.0, 20 - std::ilogb(core::length(direction)));
            file_ << "light_source { ";
            vector(Vec3d(-far * direction)) << " ";
            color(light.color) << " parallel point_at <0, 0, 0> }\n";
            return;
        }
        case core::LightKind::sphere: {
            // POV-Ray's light fades by 2 / (1 + (d / fade_distance)^2), raylane's by (radius /
            // d)^2.
            constexpr float fade = 1.0F / 1024;
            file_ << "light_source { ";
            vector(light.position) << " ";
            color(light.color * (0.5F / (fade * fade)));
            vector("area_light", Vec3f(2.0F * light.radius, 0.0F, 0.0F)) << ",";
            vector("", Vec3f(0.0F, 2.0F * light.radius, 0.0F))
                << ", 9, 9 circular orient adaptive 1 jitter fade_power 2 fade_distance "
                << fade * light.radius << " }\n";
            return;
        }
        case core::LightKind::sky:
            differences_.insert("sky lights");
            return;
        case core::LightKind::disc:
        case core::LightKind::rectangle:
            differences_.insert("disc and rectangle lights");
            return;
        }
    }

    void write_pigment(const core::Material& material) {
        const core::Pattern& pattern = material.pattern;
        if (pattern.follows_objects() && pattern.kind != core::PatternKind::image)
            differences_.insert("patterns in object space");
        file_ << "pigment { ";
        switch (pattern.kind) {
        case core::PatternKind::formula:
        case core::PatternKind::image:
        case core::PatternKind::cutaway:
            differences_.insert(pattern.kind == core::PatternKind::image ? "images on surfaces"
                                : pattern.kind == core::PatternKind::formula
                                    ? "formula patterns"
                                    : "which of several parts colors a cut");
            [[fallthrough]];
        case core::PatternKind::solid:
            color(pattern.colors[0]);
            break;
        case core::PatternKind::checker: {
            // POV-Ray's checker always uses all three axes. Along unused axes, cells are too long
            // to see.
            Vec3f size, offset;
            for (int axis = 0; axis < 3; ++axis) {
                const bool counts = (pattern.axes >> axis & 1) != 0;
                size[axis] = counts ? pattern.size : 1e6F;
                offset[axis] = counts ? 0.0F : -0.5e6F;
                if (counts && core::holds_upper_edge(pattern, axis)) {
                    size[axis] = -pattern.size;
                    offset[axis] = pattern.size;
                }
            }
            file_ << "checker ";
            color(pattern.colors[0]) << ", ";
            color(pattern.colors[1]);
            vector("scale", size);
            vector("translate", offset);
            break;
        }
        case core::PatternKind::stripes:
            vector("gradient", pattern.direction) << " color_map { [0 ";
            color(pattern.colors[0]) << "] [0.5 ";
            color(pattern.colors[0]) << "] [0.5 ";
            color(pattern.colors[1]) << "] [1 ";
            color(pattern.colors[1]) << "] } scale " << 2.0F * pattern.size;
            break;
        case core::PatternKind::gradient:
            differences_.insert("the ends of gradients (they repeat)");
            vector("gradient", pattern.to - pattern.from) << " color_map { [0 ";
            color(pattern.colors[0]) << "] [1 ";
            color(pattern.colors[1]) << "] } scale " << core::length(pattern.to - pattern.from);
            vector("translate", pattern.from);
            break;
        }
        if (shows_behind(material) > 0.0F) file_ << " transmit " << shows_behind(material);
        file_ << " }";
    }

    /// Returns max_trace_level. In POV-Ray a transparent surface is a level as well, and 256 is the
    /// most.
    int trace_level() const {
        const std::vector<core::Material>& materials = scene_.materials();
        const bool most = std::any_of(materials.begin(), materials.end(),
                                      [](const auto& m) { return m.is_transparent(); });
        return most ? 256 : scene_.settings().max_depth + 1;
    }

    /// Returns the share of the light from behind that a pigment transmits.
    static float shows_behind(const core::Material& material) {
        return material.transmits() ? material.transmission : 1.0F - material.opacity;
    }

    void write_material(std::size_t index, const core::Material& material) {
        file_ << "#declare " << identifiers_[index] << " = material { texture { ";
        write_pigment(material);
        // POV-Ray multiplies ambient and diffuse light by the share that the pigment does not
        // transmit. It does not do so for highlights and reflections.
        const float opacity = 1.0F - shows_behind(material);
        const float covered = material.transmits() ? 1.0F : material.opacity;
        const bool lit = material.ambient > 0.0F || material.diffuse > 0.0F;
        const float weight = opacity > 0.0F ? covered / opacity : 0.0F;
        if (lit && opacity <= 0.0F && material.transmits())
            differences_.insert("ambient and diffuse light of fully transmissive materials");
        const bool is_fresnel = material.reflection != core::Reflection::constant;
        file_ << " finish { ambient " << weight * material.ambient << " diffuse "
              << weight * material.diffuse;
        if (material.specular > 0.0F)
            file_ << " specular " << covered * material.specular << " roughness "
                  << 1.0F / std::max(material.exponent, 1.0F);
        if (is_fresnel)
            file_ << " reflection { 0, 1 fresnel on } conserve_energy";
        else if (material.reflectivity > 0.0F)
            file_ << " reflection { " << covered * material.reflectivity << " }";
        const bool bends = material.transmits() || (is_fresnel && !material.is_transparent());
        file_ << " } }";
        // Any other body around the camera, such as a sky, would refract the rays in POV-Ray.
        if (bends) file_ << " interior { ior " << material.index << " }";
        file_ << " }\n";
        if (material.transmits() && material.is_transparent())
            differences_.insert("opacity of transmissive materials");
        if (is_fresnel && !bends)
            differences_.insert("Fresnel reflection of transparent materials");
        if (material.visible != core::Visible::both) differences_.insert("one-sided surfaces");
        if (material.transmits() && material.absorption != Vec3f(0.0F))
            differences_.insert("absorption");
        if (material.reflection == core::Reflection::schlick)
            differences_.insert("Schlick reflection (written as Fresnel)");
    }

    /// Makes the object at hand of a material, and fills it with the scene's fog if fog fills it
    /// here.
    void write_use(core::MaterialIndex index) {
        const core::Material& material = scene_.materials()[index];
        file_ << " material { " << identifiers_[index] << " }";
        if (scene_.fog().kind == core::FogKind::exponential && material.is_transparent() &&
            !material.transmits())
            file_ << " hollow";
    }

    void write_shape(const core::SphereOf<double>& s) {
        file_ << "sphere { ";
        vector(s.center) << ", " << s.radius;
    }
    void write_shape(const core::PlaneOf<double>& s) {
        const Vec3d normal = core::normalized(s.normal);
        file_ << "plane { ";
        vector(normal) << ", " << core::dot(normal, s.point);
    }
    void write_shape(const core::DiscOf<double>& s) {
        file_ << "disc { ";
        vector(s.center) << ", ";
        vector(s.normal) << ", " << s.radius;
    }
    void write_shape(const core::TriangleOf<double>& s) {
        file_ << "triangle { ";
        vector(s.a) << ", ";
        vector(s.b) << ", ";
        vector(s.c);
    }
    void write_shape(const core::SmoothTriangleOf<double>& s) {
        file_ << "smooth_triangle { ";
        const char* between = "";
        for (const Vec3d& v : {s.a, s.normal_a, s.b, s.normal_b, s.c, s.normal_c}) {
            file_ << between;
            vector(v);
            between = ", ";
        }
    }
    void write_shape(const core::BoxOf<double>& s) {
        file_ << "box { <0, 0, 0>, <1, 1, 1>";
        matrix({s.edge_u, s.edge_v, s.edge_w, s.corner});
    }
    void write_shape(const core::EllipsoidOf<double>& s) {
        file_ << "sphere { <0, 0, 0>, 1";
        matrix({s.axis_u, s.axis_v, s.axis_w, s.center});
    }
    void matrix(std::initializer_list<Vec3d> rows) {
        file_ << " matrix <";
        const char* between = "";
        for (const Vec3d& v : rows) {
            file_ << between;
            file_.list(v, ", ");
            between = ", ";
        }
        file_ << ">";
    }
    template <core::Ends ends>
    void write_shape(const core::CylinderOf<double, ends>& s) {
        file_ << "cylinder { ";
        vector(s.base) << ", ";
        vector(s.base + s.axis) << ", " << s.radius;
        if (ends == core::Ends::open) file_ << " open";
    }
    template <core::Ends ends>
    void write_shape(const core::ConeOf<double, ends>& s) {
        file_ << "cone { ";
        vector(s.base) << ", " << s.base_radius << ", ";
        vector(s.base + s.axis) << ", " << s.top_radius;
        if (ends == core::Ends::open) file_ << " open";
    }
    void write_form(const core::QuadricOf<double>& s, bool is_clipped) {
        file_ << "quadric { ";
        vector(Vec3d(s.xx, s.yy, s.zz)) << ", ";
        vector(Vec3d(2.0 * s.xy, 2.0 * s.xz, 2.0 * s.yz)) << ", ";
        vector(Vec3d(2.0 * s.x, 2.0 * s.y, 2.0 * s.z)) << ", " << s.one;
        if (is_clipped) {
            file_ << " clipped_by { box { ";
            vector(s.lower) << ", ";
            vector(s.upper) << " } }";
        }
        vector("translate", s.center);
    }
    void write_shape(const core::QuadricOf<double>& s) { write_form(s, /*is_clipped=*/true); }

    /// Writes a quadric without its box: the half-space of its inside.
    void write_part(const core::QuadricOf<double>& s) { write_form(s, /*is_clipped=*/false); }
    void write_part(const auto& shape) { write_shape(shape); }

    /// `transparent`: writes unions as merges, since POV-Ray would show the inner walls of a union.
    /// Inner walls would also be visible in a solid that is cut open.
    void write_solid(const core::Solid& solid, bool transparent) {
        switch (solid.made) {
        case core::Made::of_shape:
            std::visit([&](const auto& shape) { write_part(shape); }, solid.shape);
            break;
        case core::Made::by_union:
            file_ << (transparent ? "merge {" : "union {");
            break;
        case core::Made::by_intersection:
            file_ << "intersection {";
            break;
        case core::Made::by_difference:
            file_ << "difference {";
            break;
        case core::Made::by_clip:
            file_ << "object {";
            break;
        }
        const bool clips = solid.made == core::Made::by_clip;
        for (std::size_t i = 0; i < solid.parts.size(); ++i) {
            if (clips && i != 0) file_ << " clipped_by {";
            file_ << " ";
            write_solid(solid.parts[i], transparent || clips);
            if (clips && i != 0) file_ << " }";
        }
        if (!is_cutaway(solid.material)) {
            if (solid.material != core::no_material) write_use(solid.material);
            for (const core::Solid& part : solid.parts)
                if (is_cutaway(part.material)) differences_.insert("colors of cut faces");
        } else if (!solid.parts.empty()) {
            file_ << " cutaway_textures"; // POV-Ray mixes those of several parts around a point
        }
        file_ << " }";
    }
    bool is_cutaway(core::MaterialIndex material) const {
        return material != core::no_material &&
               scene_.materials()[material].pattern.kind == core::PatternKind::cutaway;
    }

    TextFile& file_;
    const core::Scene& scene_;
    Differences& differences_;
    std::vector<std::string> identifiers_; // of materials
    core::Somewhere eye_;
    std::map<Surface, core::ShapeId> surfaces_; // id of the first solid with each surface
};

} // namespace

void write_pov(TextFile& file, const core::Scene& scene, Differences& differences) {
    PovWriter(file, scene, differences).write();
}

} // namespace raylane::scenes
