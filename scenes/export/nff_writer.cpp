#include "core/scene/field_of_view.hpp"
#include "scenes/export/writers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

class NffWriter {
  public:
    NffWriter(TextFile& file, const core::Scene& scene, Differences& differences)
        : file_(file), scene_(scene), differences_(differences), reach_(1000.0 * size_of(scene)) {}

    void write() {
        write_view();
        file_ << "b ";
        file_.list(scene_.background(), " ") << "\n";
        if (scene_.fog().kind != core::FogKind::none) differences_.insert("fog");
        bool has_light = false;
        for (const core::Light& light : scene_.lights()) {
            if (light.kind != core::LightKind::point) {
                differences_.insert(core::is_soft(light.kind) ? "area and sky lights"
                                                              : "directional lights");
                continue;
            }
            has_light = true;
            file_ << "l ";
            file_.list(light.position, " ") << " ";
            file_.list(light.color, " ") << "\n";
        }
        if (!has_light)
            differences_.insert("a scene without lights (raylane does not read the file)");
        if (!scene_.polygons().empty()) differences_.insert(lost_polygons);
        core::MaterialIndex filled = ~core::MaterialIndex{0};
        for_each_by_id(
            scene_,
            [&](const auto& shape, core::ShapeId id) {
                const core::MaterialIndex material = scene_.material_index_of(id);
                if (material != filled) write_fill(scene_.materials()[material]);
                filled = material;
                is_inside_ = scene_.materials()[material].visible == core::Visible::inside;
                write_shape(shape);
            },
            [](const core::Solid&, core::ShapeId) {
                throw core::InvalidValue("", "cannot store constructed solids: use .pov or .json");
            });
    }

  private:
    /// Returns the approximate size of the visible scene, including the camera.
    static double size_of(const core::Scene& scene) {
        double size = static_cast<double>(core::length(scene.camera().at - scene.camera().from));
        core::Bounds bounds = scene.hierarchy().bounds;
        if (scene.copies() != nullptr) bounds.include(scene.copies()->bounds());
        for (int axis = 0; axis < 3; ++axis)
            if (bounds.lower[axis] <= bounds.upper[axis])
                size = std::max(size, static_cast<double>(bounds.upper[axis]) -
                                          static_cast<double>(bounds.lower[axis]));
        return size;
    }

    /// Writes the view. NFF's angle spans from the middle of the first row to the middle of the
    /// last.
    void write_view() {
        const core::Camera& camera = scene_.camera();
        if (camera.projection != core::Projection::perspective)
            throw core::InvalidValue("camera", "must be perspective in NFF, got orthographic");
        if (camera.lens_radius > 0.0F) differences_.insert("the camera's lens");
        const int rows = scene_.settings().height;
        double slope = core::slope_of_view(camera.field_of_view);
        if (rows > 1) slope *= static_cast<double>(rows - 1) / rows;
        file_ << "v\nfrom ";
        file_.list(camera.from, " ") << "\nat ";
        file_.list(camera.at, " ") << "\nup ";
        file_.list(camera.up, " ")
            << "\nangle " << core::field_of_view(slope) << "\nhither 0\nresolution "
            << scene_.settings().width << " " << rows << "\n";
    }

    void write_fill(const core::Material& m) {
        if (m.pattern.kind != core::PatternKind::solid) differences_.insert("patterns");
        if (m.reflection != core::Reflection::constant) differences_.insert("Fresnel reflection");
        if (m.absorption != Vec3f(0.0F)) differences_.insert("absorption");
        if (m.visible == core::Visible::outside)
            differences_.insert("surfaces seen from outside only");
        if (m.specular != m.reflectivity) differences_.insert("specular coefficients");
        if (m.is_transparent()) differences_.insert("opacity");
        differences_.insert("ambient coefficients");
        file_ << "f ";
        file_.list(m.pattern.colors[0], " ")
            << " " << m.diffuse << " " << m.reflectivity << " " << m.exponent << " "
            << m.transmission * (1.0F - m.reflectivity) << " " << m.index << "\n";
    }

    double signed_radius(double radius) const { return is_inside_ ? -radius : radius; }

    void write_shape(const core::SphereOf<double>& s) {
        file_ << "s ";
        file_.list(s.center, " ") << " " << signed_radius(s.radius) << "\n";
    }
    void write_frustum(const Vec3d& base, double base_radius, const Vec3d& axis,
                       double top_radius) {
        file_ << "c ";
        file_.list(base, " ") << " " << signed_radius(base_radius) << " ";
        file_.list(base + axis, " ") << " " << signed_radius(top_radius) << "\n";
    }
    template <core::Ends ends>
    void write_shape(const core::CylinderOf<double, ends>& s) {
        if (ends == core::Ends::capped) differences_.insert("caps");
        write_frustum(s.base, s.radius, s.axis, s.radius);
    }
    template <core::Ends ends>
    void write_shape(const core::ConeOf<double, ends>& s) {
        if (ends == core::Ends::capped) differences_.insert("caps");
        write_frustum(s.base, s.base_radius, s.axis, s.top_radius);
    }
    void write_shape(const core::TriangleOf<double>& s) {
        file_ << "p 3\n";
        for (const Vec3d& corner : {s.a, s.b, s.c})
            file_.list(corner, " ") << "\n";
    }
    void write_shape(const core::SmoothTriangleOf<double>& s) {
        file_ << "pp 3\n";
        for (const auto& [corner, normal] :
             {std::pair(s.a, s.normal_a), std::pair(s.b, s.normal_b), std::pair(s.c, s.normal_c)}) {
            file_.list(corner, " ") << " ";
            file_.list(normal, " ") << "\n";
        }
    }
    /// Writes the box's faces, counter-clockwise as seen from outside.
    void write_shape(const core::BoxOf<double>& s) {
        const Vec3d diagonal = s.edge_u + s.edge_v + s.edge_w;
        const bool left_handed = core::dot(core::cross(s.edge_u, s.edge_v), s.edge_w) < 0.0;
        const std::array<std::array<Vec3d, 2>, 3> sides = {
            {{s.edge_u, s.edge_v}, {s.edge_v, s.edge_w}, {s.edge_w, s.edge_u}}};
        for (auto [a, b] : sides) {
            if (left_handed) std::swap(a, b);
            write_face(s.corner, b, a);
            write_face(s.corner + diagonal, -a, -b);
        }
    }
    void write_face(const Vec3d& corner, const Vec3d& a, const Vec3d& b) {
        file_ << "p 4\n";
        for (const Vec3d& v : {corner, corner + a, corner + a + b, corner + b})
            file_.list(v, " ") << "\n";
    }
    /// Writes a square of half-width `reach_`, about as far as the camera sees.
    void write_shape(const core::PlaneOf<double>& s) {
        differences_.insert("planes beyond a finite square");
        const Vec3d normal = core::normalized(s.normal);
        const Vec3d aside = std::abs(normal.x) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
        const Vec3d across = reach_ * core::normalized(core::cross(normal, aside));
        const Vec3d up = core::cross(normal, across);
        write_face(s.point - (across + up), 2.0 * across, 2.0 * up);
    }
    template <class Shape>
    [[noreturn]] void write_shape(const Shape&) {
        const std::string name(core::name_of(core::kind_of<Shape>));
        const bool vowel = std::string_view("aeiou").find(name[0]) != std::string_view::npos;
        throw core::InvalidValue("", (vowel ? "cannot store an " : "cannot store a ") + name +
                                         ": use .pov or .json");
    }

    TextFile& file_;
    const core::Scene& scene_;
    Differences& differences_;
    double reach_;           ///< half-width of the squares that replace planes
    bool is_inside_ = false; ///< true if the shapes being written are seen from inside alone
};

} // namespace

void write_nff(TextFile& file, const core::Scene& scene, Differences& differences) {
    NffWriter(file, scene, differences).write();
}

} // namespace raylane::scenes
