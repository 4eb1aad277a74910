#include "core/numbers/infinity.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/half_spaces.hpp"
#include "core/solids/hull.hpp"
#include "core/solids/solid_collector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// Computes the bounds of a constructed solid and of its parts, the shapes that it is made of. Also
/// bounds the points at which the inside or the surface of a part may affect the solid.
namespace raylane::core {

namespace {

/// Returns the bounds of the half-space behind (or, if reversed, in front of) a plane. They are
/// finite on one side if the plane is perpendicular to an axis.
Bounds bounds_of_half_space(const PlaneOf<double>& plane, bool reversed) {
    Bounds bounds = everywhere();
    for (int axis = 0; axis < 3; ++axis) {
        if (plane.normal[(axis + 1) % 3] != 0.0 || plane.normal[(axis + 2) % 3] != 0.0) continue;
        const auto at = static_cast<float>(plane.point[axis]);
        if ((plane.normal[axis] > 0.0) != reversed)
            bounds.upper[axis] = std::nextafter(at, infinity<float>);
        else
            bounds.lower[axis] = std::nextafter(at, -infinity<float>);
    }
    return bounds;
}

} // namespace

/// The half sums and half differences of floats have an error of less than an ulp of the larger
/// one.
Somewhere somewhere_in(const Bounds& bounds) {
    Somewhere point;
    for (int axis = 0; axis < 3; ++axis) {
        const auto lower = static_cast<double>(bounds.lower[axis]);
        const auto upper = static_cast<double>(bounds.upper[axis]);
        const double error =
            (0.5 * upper - 0.5 * lower) + 0x1p-50 * std::max(std::abs(lower), std::abs(upper));
        point[axis] = {0.5 * upper + 0.5 * lower, error * (1.0 + 0x1p-50)};
    }
    return point;
}

/// Returns the bounds of a part's surface.
Bounds SolidCollector::bounds_of_shape(Index part) const {
    return std::visit(
        []<class Shape>(const Shape& shape) {
            if constexpr (kind_of<Shape> == Kind::plane || kind_of<Shape> == Kind::quadric)
                return everywhere();
            else
                return core::bounds_of(shape);
        },
        shapes_[part]);
}

/// Returns the bounds of the inside of a part, or of its outside.
Bounds SolidCollector::bounds_of_part(Index index, bool outside) const {
    const bool reversed = solids_.nodes_[index].reversed != outside;
    return std::visit(
        [&]<class Shape>(const Shape& shape) {
            if constexpr (kind_of<Shape> == Kind::plane)
                return bounds_of_half_space(shape, reversed);
            else if constexpr (kind_of<Shape> == Kind::quadric)
                return bounds_of_common(std::array{HalfSpace{shape, reversed}});
            else
                return reversed ? everywhere() : core::bounds_of(shape);
        },
        shapes_[index]);
}

/// Returns bounds of the points inside of all planes and quadrics that are direct children of a
/// node, or outside of all of them if the node is a union.
Bounds SolidCollector::bounds_between_parts(Index index) const {
    const bool outside = solids_.nodes_[index].op == Solids::Op::any;
    std::vector<HalfSpace> half_spaces;
    solids_.each_child(index, [&](Index child) {
        const Node& node = solids_.nodes_[child];
        if (node.op == Solids::Op::part && (node.kind == Kind::plane || node.kind == Kind::quadric))
            half_spaces.push_back({shapes_[child], node.reversed != outside});
        return true;
    });
    return bounds_of_common(half_spaces);
}

/// Computes the hulls of all nodes from `first` on.
void SolidCollector::find_hulls(Index first) {
    hulls_.resize(solids_.nodes_.size());
    for (auto index = static_cast<Index>(solids_.nodes_.size()); index-- > first;) {
        const Node& node = solids_.nodes_[index];
        if (node.op == Solids::Op::part) {
            hulls_[index] = {bounds_of_part(index, false), bounds_of_part(index, true)};
            continue;
        }
        const bool of_all = node.op == Solids::Op::all;
        Bounds common_to_all = everywhere(), around_any;
        solids_.each_child(index, [&](Index child) {
            const Hulls& hulls = hulls_[child];
            common_to_all = common(common_to_all, of_all ? hulls.inside : hulls.outside);
            const Bounds& more = of_all ? hulls.outside : hulls.inside;
            if (!is_empty(more)) around_any.include(more);
            return true;
        });
        if (!is_finite(common_to_all))
            common_to_all = common(common_to_all, bounds_between_parts(index));
        hulls_[index] =
            of_all ? Hulls{common_to_all, around_any} : Hulls{around_any, common_to_all};
    }
}

/// Returns bounds of the points at which the inside or the surface of a part may matter. Such a
/// point is inside of every intersection above the part and outside of every union above the part.
/// Unions with Node::many do not narrow the bounds.
Bounds SolidCollector::allowed(Index part) const {
    Bounds bounds = everywhere();
    for (Index above = solids_.nodes_[part].parent; above != Solids::none;
         above = solids_.nodes_[above].parent) {
        const Node& node = solids_.nodes_[above];
        bounds = common(bounds, node.op == Solids::Op::all ? hulls_[above].inside
                                : node.many                ? everywhere()
                                                           : hulls_[above].outside);
    }
    return bounds;
}

/// Returns true if all quadrics of a solid have bounds.
bool SolidCollector::has_bounds(Index solid) const {
    for (Index part = solid; part < solids_.nodes_[solid].end; ++part) {
        const Node& node = solids_.nodes_[part];
        if (node.op == Solids::Op::part && node.traced && node.kind == Kind::quadric &&
            !is_finite(common(allowed(part), hulls_[solid].inside)))
            return false;
    }
    return true;
}

} // namespace raylane::core
