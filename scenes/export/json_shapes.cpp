#include "scenes/export/json_parts.hpp"
#include "scenes/formats/json/reader.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace raylane::scenes {

namespace {

void write_shape(JsonObject& object, const core::SphereOf<double>& s) {
    object.vector("center", s.center);
    object.number("radius", s.radius);
}

void write_shape(JsonObject& object, const core::PlaneOf<double>& s) {
    object.vector("point", s.point);
    object.vector("normal", s.normal);
}

void write_shape(JsonObject& object, const core::DiscOf<double>& s) {
    object.vector("center", s.center);
    object.vector("normal", s.normal);
    object.number("radius", s.radius);
}

void write_corners(JsonObject& object, const auto& s) {
    object.vector("a", s.a);
    object.vector("b", s.b);
    object.vector("c", s.c);
}

void write_shape(JsonObject& object, const core::TriangleOf<double>& s) {
    write_corners(object, s);
}

void write_shape(JsonObject& object, const core::SmoothTriangleOf<double>& s) {
    write_corners(object, s);
    object.vectors("normals", {s.normal_a, s.normal_b, s.normal_c});
}

void write_shape(JsonObject& object, const core::BoxOf<double>& s) {
    object.vector("corner", s.corner);
    object.vectors("edges", {s.edge_u, s.edge_v, s.edge_w});
}

template <core::Ends ends>
void write_shape(JsonObject& object, const core::CylinderOf<double, ends>& s) {
    object.vector("base", s.base);
    object.vector("axis", s.axis);
    object.number("radius", s.radius);
    object.key("capped") << (ends == core::Ends::capped ? "true" : "false");
}

template <core::Ends ends>
void write_shape(JsonObject& object, const core::ConeOf<double, ends>& s) {
    object.vector("base", s.base);
    object.vector("axis", s.axis);
    object.number("base_radius", s.base_radius);
    object.number("top_radius", s.top_radius);
    object.key("capped") << (ends == core::Ends::capped ? "true" : "false");
}

void write_form(JsonObject& object, const core::QuadricOf<double>& s) {
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

void write_shape(JsonObject& object, const core::QuadricOf<double>& s) {
    write_form(object, s);
    object.vector("lower", s.lower);
    object.vector("upper", s.upper);
}

void write_shape(JsonObject& object, const core::EllipsoidOf<double>& s) {
    object.vector("center", s.center);
    object.vectors("axes", {s.axis_u, s.axis_v, s.axis_w});
}

/// Omits the box of a quadric: as a part of a solid, a quadric is an unbounded half-space.
void write_part(JsonObject& object, const core::QuadricOf<double>& s) {
    write_form(object, s);
}
template <class Shape>
void write_part(JsonObject& object, const Shape& shape) {
    write_shape(object, shape);
}

/// Returns the levels of objects and lists with which the solid is written.
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

void write_solid(TextFile& file, const core::Solid& solid, const MaterialNames& names) {
    static constexpr std::string_view types[] = {"", "union", "intersection", "difference", "clip"};
    JsonObject object(file);
    if (solid.material != core::no_material) object.key("material") << names[solid.material];
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
        write_solid(file, part, names);
    }
    file << "]";
}

} // namespace

void write_objects(JsonObject& root, TextFile& file, const core::Scene& scene,
                   const MaterialNames& names) {
    root.key("objects") << "[";
    const char* separator = "\n";
    for_each_by_id(
        scene,
        [&]<class Shape>(const Shape& shape, core::ShapeId id) {
            file << std::exchange(separator, ",\n");
            JsonObject object(file);
            object.text("type", core::type_name_of(core::kind_of<Shape>));
            write_shape(object, shape);
            object.key("material") << names[scene.material_index_of(id)];
        },
        [&](const core::Solid& solid, core::ShapeId) {
            if (const std::size_t levels = levels_of(solid); levels > max_levels)
                throw core::InvalidValue(
                    "", "must not have a solid of more than " + std::to_string(max_levels) +
                            " levels of objects and lists, got " + std::to_string(levels));
            file << std::exchange(separator, ",\n");
            write_solid(file, solid, names);
        });
    file << "\n]";
}

void write_solids(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const MaterialNames& names) {
    root.key("objects") << "[";
    const char* separator = "\n";
    for (core::ShapeId id = 0; scene.solids().any() && id < scene.shape_count(); ++id) {
        if (!scene.solids().has(id) || scene.solids().solid_of(id) != id) continue;
        file << std::exchange(separator, ",\n");
        write_solid(file,
                    core::description_of(scene, scene.solids().root_of(scene.solids().part_of(id))),
                    names);
    }
    file << "\n]";
}

} // namespace raylane::scenes
