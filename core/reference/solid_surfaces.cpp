#include "core/reference/solid_surfaces.hpp"

#include "core/numbers/infinity.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"

#include <cmath>

namespace raylane::core {

namespace {

/// Returns the shape with the inside of a part: a quadric's inside extends beyond its clipped
/// surface.
template <class Shape>
Shape unclipped(Shape shape) {
    if constexpr (kind_of<Shape> == Kind::quadric) {
        shape.lower = Vec3d(-infinity<double>);
        shape.upper = Vec3d(infinity<double>);
    }
    return shape;
}

/// Returns true if a line that does not cross a shape's surface is inside of it.
template <class Shape>
bool runs_inside(const Shape& shape, const Ray<double>& ray) {
    if constexpr (!is_solid<Shape> && has_inside<Shape>)
        return side_of(shape, ray.origin) == Side::inside;
    else
        return false;
}

/// Returns true if a line that only touches a shape's surface is inside of it.
template <class Shape>
bool touches_from_inside(const Shape& shape, const Ray<double>& ray) {
    if constexpr (kind_of<Shape> == Kind::quadric)
        return form_along(shape, {convert<Dyadic>(ray.origin), convert<Dyadic>(ray.direction)},
                          body)
                   .A.sign() < 0;
    else
        return false;
}

template <class Visit>
decltype(auto) with_part(const Scene& scene, const Solids::Node& part, const Visit& visit) {
    return with_table(scene.shapes(), part.kind,
                      [&](const auto& table) { return visit(table.get(part.place)); });
}

Hit<double> hit_of(const Solids::Node& part, const Crossing<double>& crossing) {
    return {crossing, part.shape, part.kind, part.place, part.reversed};
}

/// Returns a box of floats that contains all positions of a point with bounds.
Bounds bounds_of(const Somewhere& point) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const double error = point[axis].error * (1.0 + 0x1p-50);
        if (!std::isfinite(point[axis].value) || !std::isfinite(error)) {
            bounds.lower[axis] = -infinity<float>;
            bounds.upper[axis] = infinity<float>;
            continue;
        }
        bounds.lower[axis] =
            std::nextafter(static_cast<float>(point[axis].value - error), -infinity<float>);
        bounds.upper[axis] =
            std::nextafter(static_cast<float>(point[axis].value + error), infinity<float>);
    }
    return bounds;
}

Somewhere point_at(double t, double error, const Ray<double>& ray) {
    using Real = Bounded<double>;
    return mul_add(Real(t, error), convert<Real>(ray.direction), convert<Real>(ray.origin));
}

Somewhere point_of(const LeavingRay& from, const Hit<double>& hit) {
    return point_at(hit.t, hit.error, from.ray);
}

/// Returns true if a crossing is certainly more than a touch: a line through a point inside of a
/// convex shape enters the shape and leaves it.
template <class Shape>
bool certainly_crosses(const Shape& shape, const LeavingRay& from, const Hit<double>& hit) {
    if constexpr (is_solid<Shape>) {
        if (hit.entering && from.origins.start_on(hit.shape).on_surface) return false;
        if (!std::isfinite(hit.error)) return false;
        // Any point of the line would do. Rounding rarely hides the inside at this depth.
        const double depth = 0x1p20 * hit.error;
        const double t = hit.entering ? hit.t + depth : hit.t - depth;
        return inside_of(shape, point_at(t, 0.0, from.ray)) == Value::yes;
    } else {
        return false;
    }
}

} // namespace

Value SolidSurfaces::value_of_part(Index index, const LeavingRay& from, const Hit<double>& hit,
                                   const Somewhere& point) {
    const Solids::Node& part = solids_.node(index);
    const Start start = from.origins.start_on(part.shape);
    const Value inside = with_part(scene_, part, [&](const auto& shape) {
        if (!start.on_surface) return inside_of(shape, point);
        // Until the ray meets the shape again, it is on the side to which it goes.
        std::uint64_t widened = 0;
        Value value = start.inward ? Value::yes : Value::no;
        for (const Crossing<double>& crossing : solve(unclipped(shape), from.ray, start, widened)) {
            const Hit<double> other = hit_of(part, crossing);
            if (hit.is_surely_before(other)) break;
            if (!other.is_surely_before(hit)) return Value::unknown;
            value = crossing.entering ? Value::yes : Value::no;
        }
        return value;
    });
    return part.reversed ? !inside : inside;
}

/// Returns the value of a union of many, leaving out the child `without`, if any. The parts on
/// whose surface the ray starts need no search.
Value SolidSurfaces::value_of_many(Index index, Index without, const LeavingRay& from,
                                   const Hit<double>& hit, const Somewhere& point) {
    Value value = Value::no;
    const auto look = [&](Index child) {
        if (child == without) return true;
        const Value of_child = value_at(child, from, hit, point, WayInUnion());
        if (of_child != Value::no) value = of_child;
        if (of_child == Value::yes) last_around_ = child;
        return of_child != Value::yes;
    };
    last_around_ = Solids::none;
    for (const Contact<double>& contact : from.origins) {
        const Index part = solids_.part_of(contact.hit.shape);
        if (part != Solids::none && solids_.node(part).parent == index && !look(part)) return value;
    }
    parts_.each_child(index, bounds_of(point), look);
    return value;
}

Value SolidSurfaces::value_at(Index index, const LeavingRay& from, const Hit<double>& hit,
                              const Somewhere& point, const WayInUnion& way) {
    const Solids::Node& node = solids_.node(index);
    if (node.op == Solids::Op::part) return value_of_part(index, from, hit, point);
    if (index == way.counted) return way.inside > 0 ? Value::yes : Value::no;
    if (node.many) return value_of_many(index, Solids::none, from, hit, point);
    const Value decides = node.op == Solids::Op::all ? Value::no : Value::yes;
    Value value = !decides;
    solids_.each_child(index, [&](Index child) {
        const Value of_child = value_at(child, from, hit, point, way);
        if (of_child != !decides) value = of_child;
        return of_child != decides;
    });
    return value;
}

/// Decides by numbers with bounds. The answer is yes if the shape has no other crossing there, and
/// the values of all other parts let this part decide. Parts that need a search come last.
Value SolidSurfaces::quickly(const LeavingRay& from, const Hit<double>& hit,
                             const WayInUnion& way) {
    if (hit.at_start) return Value::unknown;
    const Index own = solids_.part_of(hit.shape);
    const Somewhere point = point_of(from, hit);
    Value value = Value::yes;
    const auto is_searched = [&](Index index) {
        return solids_.node(index).many && index != way.counted;
    };
    for (const bool searched : {false, true})
        for (Index index = own; solids_.node(index).parent != Solids::none;
             index = solids_.node(index).parent) {
            const Index parent = solids_.node(index).parent;
            const Value decides =
                solids_.node(parent).op == Solids::Op::all ? Value::no : Value::yes;
            if (solids_.node(parent).many) {
                if (is_searched(parent) != searched) continue;
                Value others = Value::no;
                if (searched)
                    others = value_of_many(parent, index, from, hit, point);
                else if (way.hides(solids_, hit.shape, hit.entering))
                    others = Value::yes;
                if (others == decides) return Value::no;
                if (others == Value::unknown) value = others;
                continue;
            }
            bool matters = true;
            solids_.each_child(parent, [&](Index child) {
                if (child == index || is_searched(child) != searched) return true;
                const Value other = value_at(child, from, hit, point, way);
                if (other == Value::unknown) value = Value::unknown;
                return matters = other != decides;
            });
            if (!matters) return Value::no;
        }
    if (value != Value::yes) return value;
    // A ray that only touches the shape changes no value.
    const Solids::Node& part = solids_.node(own);
    const bool is_alone = with_part(scene_, part, [&](const auto& shape) {
        if (certainly_crosses(shape, from, hit)) return true;
        std::uint64_t widened = 0;
        int coincident = 0;
        for (const Crossing<double>& crossing :
             solve(shape, from.ray, from.origins.start_on(hit.shape), widened)) {
            const Hit<double> other = hit_of(part, crossing);
            coincident += !other.is_surely_before(hit) && !hit.is_surely_before(other) ? 1 : 0;
        }
        return coincident == 1;
    });
    return is_alone ? Value::yes : Value::unknown;
}

WayInUnion::WayInUnion(const Scene& scene, const LeavingRay& from, ShapeId shape) {
    const Solids& solids = scene.solids();
    if (!solids.has(shape)) return;
    const Solids::Index solid = solids.root_of(solids.part_of(shape));
    const Solids::Index of_solid = solids.counted_of(solid);
    if (of_solid == Solids::none) return;
    // A start on the surface of one part, inside of no other part.
    for (const Contact<double>& contact : from.origins) {
        const Solids::Index part = solids.part_of(contact.hit.shape);
        if (part == Solids::none || part < solid || solids.node(solid).end <= part) continue;
        if (from.origins.size() != 1 || solids.node(part).parent != of_solid) return;
        counted = of_solid;
        inside = contact.goes_inside ? 1 : 0;
        return;
    }
    if (!solids.bounds(of_solid).contains(from.ray.origin)) counted = of_solid;
}

SolidSurfaces::Sides SolidSurfaces::sides_of_part(Index index, const LeavingRay& from,
                                                  const SharpHit& hit) {
    const Solids::Node& part = solids_.node(index);
    const Hit<double>& surface = hit.hit();
    const Contact<double>* contact = from.origins.find(part.shape);
    if (surface.at_start && contact != nullptr)
        return {contact->inside != part.reversed, contact->goes_inside != part.reversed};
    Sides inside{};
    with_part(scene_, part, [&](const auto& shape) {
        const Start start = from.origins.start_on(part.shape);
        std::uint64_t widened = 0;
        const Crossings<double> crossings = solve(unclipped(shape), from.ray, start, widened);
        if (crossings.begin() == crossings.end()) {
            inside.before = inside.behind =
                start.on_surface ? start.inward : runs_inside(shape, from.ray);
            return;
        }
        const CrossingOrder order(scene_, from);
        const auto last = crossings.end() - 1;
        if (last != crossings.begin() &&
            order.compare(hit_of(part, *crossings.begin()), hit_of(part, *last)) == 0) {
            inside.before = inside.behind = touches_from_inside(shape, from.ray);
            return;
        }
        inside.before = inside.behind = !crossings.begin()->entering;
        for (const Crossing<double>& crossing : crossings) {
            const Hit<double> other = hit_of(part, crossing);
            const bool is_same = !surface.at_start && other.shape == surface.shape &&
                                 other.face == surface.face && other.entering == surface.entering;
            const int before = is_same ? 0
                               : surface.at_start
                                   ? (other.t > 0.0 ? 1 : -1) // after the start: not crossed yet
                                   : order.compare(other, hit);
            if (before < 0) inside.before = crossing.entering;
            if (before <= 0) inside.behind = crossing.entering;
        }
    });
    return {inside.before != part.reversed, inside.behind != part.reversed};
}

SolidSurfaces::Sides SolidSurfaces::sides_of(Index index, const LeavingRay& from,
                                             const SharpHit& hit, const Bounds& around) {
    const Solids::Node& node = solids_.node(index);
    if (node.op == Solids::Op::part) return sides_of_part(index, from, hit);
    const bool of_all = node.op == Solids::Op::all;
    Sides sides{of_all, of_all};
    const auto look = [&](Index child) {
        const Sides of_child = sides_of(child, from, hit, around);
        sides.before = of_all ? sides.before && of_child.before : sides.before || of_child.before;
        sides.behind = of_all ? sides.behind && of_child.behind : sides.behind || of_child.behind;
        return sides.before == of_all || sides.behind == of_all;
    };
    if (node.many)
        parts_.each_child(index, around, look, /*sorted=*/true);
    else
        solids_.each_child(index, look);
    return sides;
}

bool SolidSurfaces::exactly(const LeavingRay& from, const Hit<double>& hit) {
    const SharpHit sharp(hit);
    const Bounds around = bounds_of(point_of(from, hit));
    Index index = solids_.root_of(solids_.part_of(hit.shape));
    const Sides sides = sides_of(index, from, sharp, around);
    if (!sides.change()) return false;
    // Finds the first part that changes in the same way as the whole solid.
    while (solids_.node(index).op != Solids::Op::part) {
        Index changed = Solids::none;
        const auto look = [&](Index child) {
            if (sides_of(child, from, sharp, around) == sides) changed = child;
            return changed == Solids::none;
        };
        if (solids_.node(index).many)
            parts_.each_child(index, around, look, /*sorted=*/true);
        else
            solids_.each_child(index, look);
        index = changed;
    }
    return solids_.node(index).shape == hit.shape;
}

} // namespace raylane::core
