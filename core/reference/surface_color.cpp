#include "core/reference/surface_color.hpp"

#include "core/reference/parts_near.hpp"
#include "core/scene/pattern.hpp"
#include "core/shapes/shapes.hpp"

namespace raylane::core {

namespace {

/// The number of nodes of a solid up to which all are looked at.
constexpr Solids::Index few_nodes = 32;

/// Returns the power of a point with respect to a shape, or 1 outside of it.
template <class Shape>
double power_inside(const Shape& shape, const Vec3d& point) {
    constexpr double outside = 1.0;
    if (kind_of<Shape> != Kind::sphere &&
        inside_of(shape, convert<Bounded<double>>(point)) != Value::yes)
        return outside;
    double power = 0.0;
    if constexpr (kind_of<Shape> == Kind::sphere) {
        const Vec3d from_center = point - shape.center;
        power = dot(from_center, from_center) - shape.radius * shape.radius;
    } else if constexpr (kind_of<Shape> == Kind::capped_cylinder) {
        const Vec3d from_base = point - shape.base;
        const double along = dot(from_base, shape.axis) / dot(shape.axis, shape.axis);
        const Vec3d from_axis = from_base - along * shape.axis;
        power = dot(from_axis, from_axis) - shape.radius * shape.radius;
    }
    return power <= 0.0 ? power : outside;
}

/// Returns false if a solid is certainly not around a point.
bool may_be_around(const Scene& scene, Solids::Index index, const Vec3d& point) {
    const Solids& solids = scene.solids();
    const Solids::Node& node = solids.node(index);
    if (node.op == Solids::Op::part) {
        const Value inside = with_table(scene.shapes(), node.kind, [&](const auto& table) {
            return inside_of(table.get(node.place), convert<Bounded<double>>(point));
        });
        return inside != (node.reversed ? Value::yes : Value::no);
    }
    const bool of_all = node.op == Solids::Op::all;
    bool is_around = of_all;
    solids.each_child(index, [&](Solids::Index child) {
        is_around = may_be_around(scene, child, point);
        return is_around == of_all;
    });
    return is_around;
}

/// Returns true if a part may fill its surroundings at a point: the intersections that it is a part
/// of, but `own` is not, may be around the point.
bool may_count(const Scene& scene, Solids::Index part, Solids::Index own, const Vec3d& point) {
    const Solids& solids = scene.solids();
    for (Solids::Index above = solids.node(part).parent; above != Solids::none;
         above = solids.node(above).parent) {
        if (above < own && own < solids.node(above).end) return true;
        if (solids.node(above).op == Solids::Op::all && !may_be_around(scene, above, point))
            return false;
    }
    return true;
}

/// Returns the part of a surface's solid around the surface's point that is first by its power.
/// Parts with a cutaway pattern, and those without a surface, have no colour to give.
ShapeId part_around(const Scene& scene, const SurfacePlace& surface) {
    const Solids& solids = scene.solids();
    const Solids::Index own = solids.part_of(surface.shape);
    if (own == Solids::none) return no_shape;
    const Solids::Index solid = solids.root_of(own), end = solids.node(solid).end;
    ShapeId first = no_shape;
    double least = 0.0;
    const auto look = [&](Solids::Index index, const auto& shape) {
        const Solids::Node& part = solids.node(index);
        if (index == own || part.reversed || part.shape == no_shape ||
            scene.material_of(part.shape).pattern.kind == PatternKind::cutaway)
            return;
        const double power = power_inside(shape, surface.point);
        if (power > least || (power == least && first <= part.shape) ||
            !may_count(scene, index, own, surface.point))
            return;
        first = part.shape;
        least = power;
    };
    if (end - solid <= few_nodes) {
        for (Solids::Index index = solid; index < end; ++index)
            if (const Solids::Node& node = solids.node(index); node.op == Solids::Op::part)
                with_table(scene.shapes(), node.kind,
                           [&](const auto& table) { look(index, table.get(node.place)); });
        return first;
    }
    Bounds around;
    include_point(around, surface.point);
    PartsNear(scene).each_block(around, [&](Kind kind, std::uint32_t block) {
        with_table(scene.shapes(), kind, [&](const auto& table) {
            for_each_in_block(table, block, [&](Place place, ShapeId id) {
                const Solids::Index part = solids.part_of(id);
                if (part != Solids::none && solid <= part && part < end)
                    look(part, table.get(place));
            });
        });
        return true;
    });
    return first;
}

} // namespace

Vec3d color_on(const Scene& scene, const Pattern& pattern, const SurfacePlace& surface) {
    if (pattern.kind == PatternKind::image) return image_at(scene, pattern, surface);
    const ShapeId part = part_around(scene, surface);
    const Pattern& cut = part != no_shape ? scene.material_of(part).pattern : pattern;
    return color_at(cut.needs_shape() ? pattern : cut, surface.point);
}

} // namespace raylane::core
