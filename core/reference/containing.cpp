#include "core/reference/containing.hpp"

#include "core/reference/enclosing.hpp"
#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

namespace {

/// The value of an intersection (Op::all) or a union (Op::any), from its children.
class OfChildren {
  public:
    explicit OfChildren(const Solids::Node& node)
        : of_all_(node.op == Solids::Op::all), value_{of_all_ ? Side::inside : Side::outside,
                                                      of_all_} {}

    /// Adds a child. Returns false once the value is known.
    bool add(const Position& child) {
        value_.side =
            of_all_ ? std::max(value_.side, child.side) : std::min(value_.side, child.side);
        value_.inside = of_all_ ? value_.inside && child.inside : value_.inside || child.inside;
        return value_.side != (of_all_ ? Side::outside : Side::inside);
    }
    const Position& value() const { return value_; }

  private:
    bool of_all_;
    Position value_;
};

Side of_part(const Solids::Node& part, Side of_shape) {
    return part.reversed ? static_cast<Side>(-static_cast<int>(of_shape)) : of_shape;
}

/// Returns the position relative to a shape as a part, which may be reversed.
template <class Shape>
Position position_in_part(const Solids::Node& part, const Shape& shape, const Vec3d& point) {
    const Side side = side_of(shape, point);
    const bool inside = side == Side::inside || (is_solid<Shape> && side == Side::surface);
    return {of_part(part, side), inside != part.reversed};
}

/// Returns the sign of a polynomial for all large t, as a side.
Side side_in_the_end(const ExactQuadratic& form) {
    for (const Dyadic* coefficient : {&form.A, &form.B, &form.C})
        if (const int sign = coefficient->sign(); sign != 0) return static_cast<Side>(sign);
    return Side::surface;
}

} // namespace

std::vector<Solids::Index> unbounded_solids(const Scene& scene) {
    std::vector<Solids::Index> unbounded;
    const Solids& solids = scene.solids();
    for (Solids::Index solid = 0; solid < solids.nodes().size(); solid = solids.node(solid).end) {
        const Bounds& bounds = solids.bounds(solid);
        if (!is_finite(bounds) && bounds.lower.x <= bounds.upper.x) unbounded.push_back(solid);
    }
    return unbounded;
}

Side side_at_end(const Scene& scene, Solids::Index index, const Ray<double>& ray) {
    const Solids::Node& node = scene.solids().node(index);
    if (node.op == Solids::Op::part)
        return of_part(
            node,
            with_table(scene.shapes(), node.kind, [&]<class Shape>(const Table<Shape>& table) {
                if constexpr (kind_of<Shape> == Kind::plane || kind_of<Shape> == Kind::quadric)
                    return side_in_the_end(form_along(
                        table.get(node.place),
                        ExactRay{convert<Dyadic>(ray.origin), convert<Dyadic>(ray.direction)}, {}));
                else
                    return Side::outside;
            }));
    if (node.many) return Side::outside; // each child has bounds
    OfChildren children(node);
    scene.solids().each_child(index, [&](Solids::Index child) {
        const Side side = side_at_end(scene, child, ray);
        return children.add({side, side == Side::inside});
    });
    return children.value().side;
}

PointSearcher::PointSearcher(const Scene& scene)
    : scene_(scene), parts_(scene), unbounded_(unbounded_solids(scene)) {}

void PointSearcher::add_containing(const Vec3d& point, std::vector<Containing>& found) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(point[axis])) return;
    Bounds around;
    include_point(around, point);
    const std::size_t first = found.size();
    solids_ = unbounded_;
    parts_.each_block(around, [&](Kind kind, std::uint32_t block) {
        with_table(scene_.shapes(), kind, [&]<class Shape>(const Table<Shape>& table) {
            for_each_in_block(table, block, [&](Place place, ShapeId id) {
                if (const Solids::Index part = scene_.solids().part_of(id); part != Solids::none) {
                    solids_.push_back(scene_.solids().root_of(part));
                } else if constexpr (is_solid<Shape>) {
                    const Side side = core::side_of(table.get(place), point);
                    if (side != Side::outside) found.push_back({id, side == Side::surface, true});
                }
            });
        });
        return true;
    });
    std::sort(solids_.begin(), solids_.end());
    solids_.erase(std::unique(solids_.begin(), solids_.end()), solids_.end());
    for (const Solids::Index solid : solids_) {
        if (scene_.solids().node(solid).open) continue;
        const Position position = position_in(solid, point);
        if (position.side != Side::outside)
            found.push_back({scene_.solids().node(solid).shape, position.side == Side::surface,
                             position.inside});
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
              [](const Containing& a, const Containing& b) { return a.shape < b.shape; });
}

Position PointSearcher::position_in(Solids::Index index, const Vec3d& point) {
    const Solids::Node& node = scene_.solids().node(index);
    if (node.op == Solids::Op::part)
        return with_table(scene_.shapes(), node.kind,
                          [&]<class Shape>(const Table<Shape>& table) -> Position {
                              if constexpr (has_inside<Shape>)
                                  return position_in_part(node, table.get(node.place), point);
                              else
                                  return {of_part(node, Side::outside), node.reversed};
                          });
    OfChildren children(node);
    const auto look = [&](Solids::Index child) { return children.add(position_in(child, point)); };
    if (node.many) {
        Bounds around;
        include_point(around, point);
        parts_.each_child(index, around, look);
    } else {
        scene_.solids().each_child(index, look);
    }
    return children.value();
}

} // namespace raylane::core
