#include "scenes/formats/tachyon/objects.hpp"

#include "core/shapes/checks.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/tachyon/vertex_array.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

core::Solid plane_through(const Vec3f& center, const Vec3f& normal) {
    return {.shape = core::PlaneOf<double>{core::convert<double>(center),
                                           core::convert<double>(normal)}};
}

core::Solid ball(const Vec3f& center, float radius) {
    return {.shape =
                core::SphereOf<double>{core::convert<double>(center), static_cast<double>(radius)}};
}

core::SphereOf<double> in_double(const core::Sphere& s) {
    return {core::convert<double>(s.center), static_cast<double>(s.radius)};
}
core::CylinderOf<double, core::Ends::open> in_double(const core::OpenCylinder& s) {
    return {core::convert<double>(s.base), core::convert<double>(s.axis),
            static_cast<double>(s.radius)};
}
core::CylinderOf<double, core::Ends::open>
in_double(const core::CylinderOf<double, core::Ends::open>& s) {
    return s;
}
core::PlaneOf<double> in_double(const core::Plane& s) {
    return {core::convert<double>(s.point), core::convert<double>(s.normal)};
}
core::BoxOf<double> in_double(const core::Box& s) {
    return {core::convert<double>(s.corner), core::convert<double>(s.edge_u),
            core::convert<double>(s.edge_v), core::convert<double>(s.edge_w)};
}

} // namespace

bool TachyonObjects::read() {
    using Read = void (TachyonObjects::*)();
    static constexpr std::pair<std::string_view, Read> statements[] = {
        {"SPHERE", &TachyonObjects::read_sphere},
        {"FCYLINDER", &TachyonObjects::read_finite_cylinder},
        {"TRI", &TachyonObjects::read_triangle},
        {"STRI", &TachyonObjects::read_smooth_triangle},
        {"VCSTRI", &TachyonObjects::read_colored_triangle},
        {"VERTEXARRAY", &TachyonObjects::read_vertex_array},
        {"CYLINDER", &TachyonObjects::read_cylinder},
        {"POLYCYLINDER", &TachyonObjects::read_polycylinder},
        {"PLANE", &TachyonObjects::read_plane},
        {"RING", &TachyonObjects::read_ring},
        {"BOX", &TachyonObjects::read_box},
        {"TEXDEF", &TachyonObjects::read_texture_definition},
        {"TEXALIAS", &TachyonObjects::read_texture_alias},
        {"START_CLIPGROUP", &TachyonObjects::read_clip_group},
        {"END_CLIPGROUP", &TachyonObjects::end_clip_group},
        {"SCAPE", &TachyonObjects::skip_landscape},
        {"SCALARVOL", &TachyonObjects::skip_volume},
        {"TPOLYFILE", &TachyonObjects::skip_polygons},
        {"IMAGEDEF", &TachyonObjects::skip_image},
    };
    for (const auto& [keyword, read] : statements)
        if (is_keyword(words_.statement(), keyword)) {
            (this->*read)();
            return true;
        }
    return false;
}

TachyonTexture TachyonObjects::texture() {
    if (words_.accept("TEXTURE")) return read_texture(words_);
    if (words_.peek().empty()) words_.refuse_next("TEXTURE or the name of one");
    const std::string name(words_.take());
    const auto place = textures_.find(name);
    if (place != textures_.end()) return place->second;
    words_.remark("the texture \"" + printable(name) + "\" is not defined");
    return {};
}

void TachyonObjects::read_texture_definition() {
    const std::string name(words_.take());
    // If several textures have one name, Tachyon takes the first.
    const auto place = textures_.emplace(name, read_texture(words_)).first;
    place->second.name = &place->first;
}

void TachyonObjects::read_texture_alias() {
    const std::string name(words_.take());
    textures_.emplace(name, texture());
}

template <class Shape>
void TachyonObjects::add(const Shape& shape, core::MaterialIndex material) {
    if (clips_.empty()) {
        builder_.add(shape, material);
    } else if constexpr (core::AnyTriangle<Shape>) {
        for (const Shape& part : clipped(shape, clips_))
            builder_.add(part, material);
    } else {
        add_cut({.shape = in_double(shape)}, {}, material);
    }
}

void TachyonObjects::add_cut(core::Solid solid, std::vector<core::Solid> by,
                             core::MaterialIndex material) {
    core::Solid cut{.made = core::Made::by_clip};
    cut.parts.push_back(std::move(solid));
    for (core::Solid& part : by)
        cut.parts.push_back(std::move(part));
    for (const TachyonClip& clip : clips_)
        cut.parts.push_back(half_space_of(clip));
    builder_.add_solid(cut, material);
}

void TachyonObjects::read_sphere() {
    const Vec3f center = words_.named_vector("CENTER");
    const float radius = std::abs(words_.named_number("RAD"));
    const core::MaterialIndex index = material();
    if (radius == 0.0F) return leave_out();
    add(core::Sphere{center, radius}, index);
}

/// Reads a cylinder without ends. Its ends are placed a million units away.
void TachyonObjects::read_cylinder() {
    constexpr double far = 1e6;
    if (!words_.accept("BASE")) words_.expect("CENTER");
    const auto center = core::convert<double>(words_.vector("CENTER"));
    const auto axis = core::convert<double>(words_.named_vector("AXIS"));
    const auto radius = static_cast<double>(std::abs(words_.named_number("RAD")));
    const core::MaterialIndex index = material();
    const double length = core::length(axis);
    if (length == 0.0 || radius == 0.0) return leave_out();
    const Vec3d half = axis * (far / length);
    add(core::CylinderOf<double, core::Ends::open>{center - half, 2.0 * half, radius}, index);
}

/// Reads a cylinder whose second end is a point, or in older files an axis.
void TachyonObjects::read_finite_cylinder() {
    if (!words_.accept("CENTER")) words_.expect("BASE");
    const Vec3f base = words_.vector("BASE");
    Vec3f apex;
    if (words_.accept("AXIS"))
        apex = base + words_.vector("AXIS");
    else
        apex = words_.named_vector("APEX");
    const float radius = std::abs(words_.named_number("RAD"));
    add_finite_cylinder(base, apex, radius, material());
}

void TachyonObjects::add_finite_cylinder(const Vec3f& base, const Vec3f& apex, float radius,
                                         core::MaterialIndex material) {
    const Vec3f axis = apex - base;
    if (axis == Vec3f(0.0F) || radius == 0.0F) return leave_out();
    add(core::OpenCylinder{base, axis, radius}, material);
}

/// Adds cylinders from point to point, and spheres where they meet.
void TachyonObjects::read_polycylinder() {
    words_.expect("POINTS");
    const int count = words_.whole_number("POINTS", 1, max_int);
    std::vector<Vec3f> points;
    std::generate_n(std::back_inserter(points), count, [this] { return words_.vector("POINTS"); });
    const float radius = std::abs(words_.named_number("RAD"));
    const core::MaterialIndex index = material();
    if (radius == 0.0F) return leave_out();
    for (std::size_t i = 0; i < points.size(); ++i) {
        add(core::Sphere{points[i], radius}, index);
        if (i != 0) add_finite_cylinder(points[i - 1], points[i], radius, index);
    }
}

void TachyonObjects::add_triangle(const core::SmoothTriangle& t, core::MaterialIndex material) {
    if (core::checks::are_collinear(t.a, t.b, t.c)) return leave_out();
    const bool is_smooth =
        t.normal_a != Vec3f(0.0F) && t.normal_b != Vec3f(0.0F) && t.normal_c != Vec3f(0.0F);
    if (is_smooth)
        add(t, material);
    else
        add(core::Triangle{t.a, t.b, t.c}, material);
}

void TachyonObjects::read_triangle() {
    const Vec3f a = words_.named_vector("V0"), b = words_.named_vector("V1"),
                c = words_.named_vector("V2");
    add_triangle({a, b, c, Vec3f(0.0F), Vec3f(0.0F), Vec3f(0.0F)}, material());
}

core::SmoothTriangle TachyonObjects::corners_and_normals() {
    core::SmoothTriangle t{};
    t.a = words_.named_vector("V0");
    t.b = words_.named_vector("V1");
    t.c = words_.named_vector("V2");
    t.normal_a = words_.named_vector("N0");
    t.normal_b = words_.named_vector("N1");
    t.normal_c = words_.named_vector("N2");
    return t;
}

void TachyonObjects::read_smooth_triangle() {
    const core::SmoothTriangle triangle = corners_and_normals();
    add_triangle(triangle, material());
}

/// Reads a triangle whose texture has no colour, and need not follow the word TEXTURE.
void TachyonObjects::read_colored_triangle() {
    const core::SmoothTriangle triangle = corners_and_normals();
    const Vec3f a = words_.named_triple("C0"), b = words_.named_triple("C1"),
                c = words_.named_triple("C2");
    words_.accept("TEXTURE");
    TachyonTexture texture = read_texture(words_);
    texture.color = mean_color(a, b, c);
    if (a != b || b != c)
        words_.remark("colours at the corners of a triangle are not supported: their mean is used");
    add_triangle(triangle, materials_.index_of(texture));
}

void TachyonObjects::read_vertex_array() {
    const std::function<TachyonTexture()> read_texture = [this] { return texture(); };
    TachyonVertexArray(words_, read_texture)
        .read([this](const core::SmoothTriangle& triangle, const TachyonTexture& texture) {
            add_triangle(triangle, materials_.index_of(texture));
        });
}

void TachyonObjects::read_plane() {
    const Vec3f center = words_.named_vector("CENTER"), normal = words_.named_vector("NORMAL");
    add(core::Plane{center, normal}, material());
}

/// Adds a plane clipped to the outer sphere minus the inner one.
void TachyonObjects::read_ring() {
    const Vec3f center = words_.named_vector("CENTER"), normal = words_.named_vector("NORMAL");
    const float inner = std::abs(words_.named_number("INNER"));
    const float outer = std::abs(words_.named_number("OUTER"));
    const core::MaterialIndex index = material();
    if (outer <= inner) return leave_out();
    if (inner == 0.0F && clips_.empty()) {
        builder_.add(core::Disc{center, normal, outer}, index);
        return;
    }
    core::Solid within{.made = core::Made::by_difference, .parts = {ball(center, outer)}};
    if (inner > 0.0F) within.parts.push_back(ball(center, inner));
    add_cut(plane_through(center, normal), {std::move(within)}, index);
}

void TachyonObjects::read_box() {
    const Vec3f min = words_.named_vector("MIN"), max = words_.named_vector("MAX");
    const core::MaterialIndex index = material();
    const Vec3f edges = max - min;
    if (edges.x == 0.0F || edges.y == 0.0F || edges.z == 0.0F) return leave_out();
    add(core::Box{min, {edges.x, 0, 0}, {0, edges.y, 0}, {0, 0, edges.z}}, index);
}

void TachyonObjects::read_clip_group() {
    words_.expect("NUMPLANES");
    const int count = words_.whole_number("NUMPLANES", 0, 1000);
    clips_.clear();
    for (int i = 0; i < count; ++i) {
        const Vec3f normal = words_.vector("plane");
        if (normal == Vec3f(0.0F)) words_.refuse("plane", "must have a normal", "0 0 0");
        clips_.push_back({normal, words_.number("plane")});
    }
}

void TachyonObjects::end_clip_group() {
    clips_.clear();
}

void TachyonObjects::skip_landscape() {
    words_.expect("RES");
    for (int axis = 0; axis < 2; ++axis)
        words_.whole_number("RES", 0, max_int);
    words_.expect("SCALE");
    for (int axis = 0; axis < 2; ++axis)
        words_.number("SCALE");
    words_.named_vector("CENTER");
    texture();
    words_.remark("SCAPE is omitted: landscapes are not supported");
}

void TachyonObjects::skip_volume() {
    words_.named_vector("MIN");
    words_.named_vector("MAX");
    words_.expect("DIM");
    for (int axis = 0; axis < 3; ++axis)
        words_.whole_number("DIM", 0, max_int);
    words_.expect("FILE");
    words_.take();
    texture();
    words_.remark("SCALARVOL is omitted: volumes are not supported");
}

void TachyonObjects::skip_polygons() {
    words_.named_vector("SCALE");
    words_.named_vector("ROT");
    words_.named_vector("CENTER");
    words_.expect("FILE");
    words_.take();
    texture();
    words_.remark("TPOLYFILE is omitted: files of polygons are not supported");
}

void TachyonObjects::skip_image() {
    words_.take(); // the image's name
    words_.expect("FORMAT");
    words_.expect("RGB24");
    words_.expect("RESOLUTION");
    std::int64_t texels = 1;
    for (int axis = 0; axis < 3; ++axis)
        texels *= words_.whole_number("RESOLUTION", 1, 65535);
    words_.expect("ENCODING");
    words_.expect("HEX");
    for (; texels > 0 && !words_.peek().empty(); --texels)
        words_.take();
}

} // namespace raylane::scenes
