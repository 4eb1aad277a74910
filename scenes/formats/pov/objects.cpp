#include "scenes/formats/pov/objects.hpp"

#include "scenes/formats/pov/expressions.hpp"
#include "scenes/formats/pov/finishes.hpp"
#include "scenes/formats/pov/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raylane::scenes::pov {

namespace {

using core::Ends, core::Vec3d;

core::PartShape read_sphere(Tokens& tokens) {
    core::SphereOf<double> sphere{};
    sphere.center = read_vector(tokens);
    skip_comma(tokens);
    sphere.radius = std::abs(read_number(tokens)); // as in POV-Ray
    return sphere;
}

core::PartShape read_box(Tokens& tokens) {
    const Vec3d a = read_vector(tokens);
    skip_comma(tokens);
    const Vec3d b = read_vector(tokens);
    Vec3d lower, size;
    for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(a[axis], b[axis]);
        size[axis] = std::max(a[axis], b[axis]) - lower[axis];
    }
    return core::BoxOf<double>{lower, {size.x, 0.0, 0.0}, {0.0, size.y, 0.0}, {0.0, 0.0, size.z}};
}

core::PartShape read_cylinder(Tokens& tokens) {
    const Vec3d base = read_vector(tokens);
    skip_comma(tokens);
    const Vec3d axis = read_vector(tokens) - base;
    skip_comma(tokens);
    const double radius = std::abs(read_number(tokens));
    if (tokens.accept("open")) return core::CylinderOf<double, Ends::open>{base, axis, radius};
    return core::CylinderOf<double, Ends::capped>{base, axis, radius};
}

core::PartShape read_cone(Tokens& tokens) {
    const Vec3d base = read_vector(tokens);
    skip_comma(tokens);
    const double base_radius = read_number(tokens);
    skip_comma(tokens);
    const Vec3d axis = read_vector(tokens) - base;
    skip_comma(tokens);
    const double top_radius = read_number(tokens);
    if (tokens.accept("open"))
        return core::ConeOf<double, Ends::open>{base, axis, base_radius, top_radius};
    return core::ConeOf<double, Ends::capped>{base, axis, base_radius, top_radius};
}

core::PartShape read_plane(Tokens& tokens) {
    const Vec3d normal = read_vector(tokens);
    skip_comma(tokens);
    const double distance = read_number(tokens);
    const double size = core::length(normal);
    // Zeros stay positive.
    const Vec3d point = size > 0.0 ? distance / size * normal + Vec3d(0.0) : normal;
    return core::PlaneOf<double>{point, normal};
}

core::PartShape read_disc(Tokens& tokens) {
    const Place place = tokens.peek().place;
    core::DiscOf<double> disc{};
    disc.center = read_vector(tokens);
    skip_comma(tokens);
    disc.normal = read_vector(tokens);
    skip_comma(tokens);
    disc.radius = std::abs(read_number(tokens));
    if (tokens.accept(",") && read_number(tokens) != 0.0)
        tokens.remark(place, "the hole of a disc is ignored");
    return disc;
}

core::PartShape read_triangle(Tokens& tokens) {
    core::TriangleOf<double> triangle{};
    for (Vec3d* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        *corner = read_vector(tokens);
        skip_comma(tokens);
    }
    return triangle;
}

core::PartShape read_smooth_triangle(Tokens& tokens) {
    core::SmoothTriangleOf<double> t{};
    for (Vec3d* v : {&t.a, &t.normal_a, &t.b, &t.normal_b, &t.c, &t.normal_c}) {
        *v = read_vector(tokens);
        skip_comma(tokens);
    }
    return smooth_or_flat(t);
}

core::PartShape read_quadric(Tokens& tokens) {
    Vec3d rows[3];
    for (Vec3d& row : rows) {
        row = read_vector(tokens);
        skip_comma(tokens);
    }
    core::QuadricOf<double> q{};
    q.xx = rows[0].x;
    q.yy = rows[0].y;
    q.zz = rows[0].z;
    q.xy = 0.5 * rows[1].x;
    q.xz = 0.5 * rows[1].y;
    q.yz = 0.5 * rows[1].z;
    q.x = 0.5 * rows[2].x;
    q.y = 0.5 * rows[2].y;
    q.z = 0.5 * rows[2].z;
    q.one = read_number(tokens);
    q.lower = Vec3d(-1.0);
    q.upper = Vec3d(1.0);
    return q;
}

template <class Read>
struct Named {
    std::string_view name;
    Read read;
};
const Named<core::PartShape (*)(Tokens&)> shapes[] = {
    {"sphere", read_sphere},     {"cylinder", read_cylinder},
    {"cone", read_cone},         {"box", read_box},
    {"plane", read_plane},       {"disc", read_disc},
    {"triangle", read_triangle}, {"smooth_triangle", read_smooth_triangle},
    {"quadric", read_quadric}};
const Named<Shared<Mesh> (*)(Tokens&)> meshes[] = {
    {"mesh", read_mesh}, {"mesh2", read_mesh2}, {"polygon", read_polygon}};
const Named<ObjectKind> compounds[] = {{"union", ObjectKind::all_in_one},
                                       {"light_group", ObjectKind::all_in_one},
                                       {"merge", ObjectKind::merge},
                                       {"intersection", ObjectKind::intersection},
                                       {"difference", ObjectKind::difference}};
constexpr std::string_view not_read[] = {
    "bicubic_patch", "blob", "cubic",        "height_field",   "isosurface", "julia_fractal",
    "lathe",         "ovus", "parametric",   "poly",           "polynomial", "prism",
    "quartic",       "sor",  "sphere_sweep", "superellipsoid", "text",       "torus"};

template <class Table>
auto* entry(Table& table, const Token& token) {
    const auto found = std::find_if(std::begin(table), std::end(table),
                                    [&](const auto& entry) { return token.is(entry.name); });
    return found == std::end(table) ? nullptr : found;
}

const Shared<Object>* named_object(const Tokens& tokens, const Token& token) {
    const Value* value = tokens.value_of(token);
    return value != nullptr ? value->get_if<Shared<Object>>() : nullptr;
}

void add_part(Tokens& tokens, Object& object) {
    Shared<Object> part = read_object(tokens);
    count_in(object, *part, 1);
    if (object.kind == ObjectKind::all_in_one) object.pieces += part->pieces;
    object.parts.push_back(std::move(part));
}

/// Replaces a box without thickness by a rectangle.
void draw_flat_box(Object& object) {
    const auto* box = std::get_if<core::BoxOf<double>>(&object.shape);
    if (box == nullptr) return;
    const Vec3d size = box->edge_u + box->edge_v + box->edge_w;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d u(0.0), v(0.0);
        const int first = (axis + 1) % 3, second = (axis + 2) % 3;
        u[first] = size[first];
        v[second] = size[second];
        if (size[axis] != 0.0 || size[first] == 0.0 || size[second] == 0.0) continue;
        const Vec3d a = box->corner, c = a + u + v;
        Mesh mesh;
        mesh.triangles = {{core::TriangleOf<double>{a, a + u, c}},
                          {core::TriangleOf<double>{a, c, a + v}}};
        object.kind = ObjectKind::mesh;
        object.count = mesh.triangles.size();
        object.mesh = std::make_shared<const Mesh>(std::move(mesh));
        return;
    }
}

/// Divides a cone whose radii have different signs into two cones, one on each side of its apex.
/// POV-Ray renders a cone of two negative radii as a cylinder with the smaller radius.
void divide_cone(Object& object) {
    std::visit(
        [&]<class Shape>(Shape& cone) {
            if constexpr (requires { cone.base_radius; }) {
                const Shape given = cone;
                cone.base_radius = std::abs(cone.base_radius);
                cone.top_radius = std::abs(cone.top_radius);
                if (given.base_radius < 0.0 && given.top_radius < 0.0)
                    cone.base_radius = cone.top_radius =
                        std::min(cone.base_radius, cone.top_radius);
                if (!(given.base_radius * given.top_radius < 0.0)) return;
                const Vec3d apex = given.base + given.base_radius /
                                                    (given.base_radius - given.top_radius) *
                                                    given.axis;
                const Vec3d top = given.base + given.axis;
                for (const Shape& half :
                     {Shape{given.base, apex - given.base, cone.base_radius, 0.0},
                      Shape{top, apex - top, cone.top_radius, 0.0}}) {
                    Object part{.place = object.place};
                    part.shape = half;
                    object.parts.push_back(std::make_shared<const Object>(std::move(part)));
                }
                object.kind = ObjectKind::all_in_one;
                object.count = object.pieces = object.parts.size();
                object.depth = 2;
            }
        },
        object.shape);
}

/// Omits objects without a size, which PyMOL writes.
void leave_out_if_flat(Tokens& tokens, Object& object) {
    draw_flat_box(object);
    divide_cone(object);
    if (object.kind != ObjectKind::shape) return;
    const bool is_flat = std::visit(
        [&](const auto& shape) {
            if constexpr (requires {
                              shape.a;
                              shape.b;
                              shape.c;
                          })
                return has_no_area(tokens, {shape.a, shape.b, shape.c}, object.place);
            else if constexpr (requires {
                                   shape.axis;
                                   shape.radius;
                               })
                return shape.axis == Vec3d(0.0) || shape.radius == 0.0;
            else if constexpr (requires { shape.base_radius; })
                return shape.axis == Vec3d(0.0) ||
                       (shape.base_radius == 0.0 && shape.top_radius == 0.0);
            else if constexpr (requires { shape.edge_u; })
                return shape.edge_u == Vec3d(0.0) || shape.edge_v == Vec3d(0.0) ||
                       shape.edge_w == Vec3d(0.0);
            else if constexpr (requires { shape.radius; })
                return shape.radius == 0.0;
            else
                return false;
        },
        object.shape);
    if (!is_flat) return;
    tokens.remark(object.place, "objects without a size are omitted");
    object.kind = ObjectKind::all_in_one;
    object.count = 0;
}

} // namespace

core::PartShape smooth_or_flat(const core::SmoothTriangleOf<double>& t) {
    const bool is_smooth =
        t.normal_a != Vec3d(0.0) && t.normal_b != Vec3d(0.0) && t.normal_c != Vec3d(0.0);
    if (is_smooth) return t;
    return core::TriangleOf<double>{t.a, t.b, t.c};
}

bool has_no_area(Tokens& tokens, const core::TriangleOf<double>& triangle, const Place& place) {
    if (!core::checks::are_collinear(triangle.a, triangle.b, triangle.c)) return false;
    tokens.remark(place, "objects without a size are omitted");
    return true;
}

bool begins_object(const Tokens& tokens, const Token& token) {
    return entry(shapes, token) != nullptr || entry(compounds, token) != nullptr ||
           entry(meshes, token) != nullptr || token.is("object") || token.is("light_source") ||
           named_object(tokens, token) != nullptr;
}

Shared<Object> read_object(Tokens& tokens) {
    const Token word = tokens.peek();
    const Level level(tokens.depth, word.place);
    if (Shared<Object> named = tokens.accept_value<Object>()) return named;
    tokens.next();
    Object object{.place = word.place};
    if (word.is("light_source")) {
        object.kind = ObjectKind::light;
        object.light = std::make_shared<const LightSource>(read_light(tokens));
        object.count = object.pieces = 0;
        object.lights = 1;
        return std::make_shared<const Object>(std::move(object));
    }
    const auto* shape = entry(shapes, word);
    const auto* mesh = entry(meshes, word);
    const auto* compound = entry(compounds, word);
    if (shape == nullptr && mesh == nullptr && compound == nullptr && !word.is("object")) {
        if (std::find(std::begin(not_read), std::end(not_read), word.text) != std::end(not_read))
            fail(word.place,
                 "must be made of quadrics, got " + word.quoted() + ", which is not supported");
        fail(word.place,
             "must be a supported object, got " + word.quoted() + tokens.origin_of(word));
    }
    tokens.expect("{");
    if (shape != nullptr) {
        object.shape = shape->read(tokens);
        leave_out_if_flat(tokens, object);
    } else if (mesh != nullptr) {
        object.kind = ObjectKind::mesh;
        object.mesh = mesh->read(tokens);
        object.count = object.mesh->triangles.size();
    } else if (compound != nullptr) {
        object.kind = compound->read;
        if (word.is("light_group"))
            tokens.remark(word.place, "light_group is ignored: its lights shine everywhere");
        object.count = 0;
        if (object.kind == ObjectKind::all_in_one) object.pieces = 0;
        while (begins_object(tokens, tokens.peek()) ||
               std::find(std::begin(not_read), std::end(not_read), tokens.peek().text) !=
                   std::end(not_read))
            add_part(tokens, object);
    } else {
        object = *read_object(tokens);
        object.place = word.place;
    }
    read_modifiers(tokens, object);
    const std::size_t others = object.parts.size() + object.clips.size();
    object.room =
        tokens.budget.reserve(sizeof(Object) + others * sizeof(Shared<Object>), object.place);
    return std::make_shared<const Object>(std::move(object));
}

} // namespace raylane::scenes::pov
