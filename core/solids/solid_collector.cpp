#include "core/solids/solid_collector.hpp"

#include "core/shapes/shapes.hpp"
#include "core/solids/half_spaces.hpp"
#include "core/solids/hull.hpp"
#include "core/solids/narrowing.hpp"
#include "core/solids/transform.hpp"

#include <algorithm>
#include <cassert>

namespace raylane::core {

/// Converts open cylinders and cones to half-spaces, as they have no inside by themselves.
PartShape SolidCollector::as_half_space(const PartShape& shape) {
    return std::visit(
        []<class Shape>(const Shape& part) -> PartShape {
            if constexpr (kind_of<Shape> == Kind::open_cylinder ||
                          kind_of<Shape> == Kind::open_cone)
                return half_space_of(part);
            else
                return part;
        },
        shape);
}

SolidCollector::Index SolidCollector::begin(Solids::Op op, Index parent) {
    const auto index = static_cast<Index>(solids_.nodes_.size());
    Node node{op};
    node.parent = parent;
    node.end = index + 1;
    solids_.nodes_.push_back(node);
    shapes_.emplace_back();
    return index;
}

/// Finds the bounds of a whole solid and of its parts.
void SolidCollector::find_bounds(Index solid, SolidNarrowing& narrowing) {
    std::vector<Node>& nodes = solids_.nodes_;
    Bounds& total_bounds = solids_.bounds_[solid];
    total_bounds = hulls_[solid].inside;
    if (is_finite(total_bounds) && !nodes[solid].many) narrowing.narrow_whole(solid);
    const Bounds of_solid = total_bounds;
    // The hierarchy has no unbounded parts.
    if (!is_finite(of_solid))
        for (Index index = solid; index < nodes[solid].end; ++index)
            if (nodes[index].many && !nodes[index].counts)
                solids_.each_child(index, [&](Index child) {
                    return nodes[index].many = is_finite(common(hulls_[child].inside, of_solid));
                });
    std::vector<Index> finite;
    for (Index part = solid; part < nodes[solid].end; ++part) {
        if (nodes[part].op != Solids::Op::part || !nodes[part].traced) continue;
        Bounds& bounds = solids_.bounds_[part];
        bounds = common(of_solid, allowed(part));
        if (!nodes[part].reversed || !narrowing.needs_inside(part))
            bounds = common(bounds, bounds_of_shape(part));
        nodes[part].traced = !is_empty(bounds);
        if (nodes[part].traced && is_finite(bounds)) finite.push_back(part);
    }
    narrowing.narrow_parts(solid, std::move(finite));
}

/// Adds a part to the list of its kind. A bounded plane becomes a quadric with the same half-space,
/// as planes cannot have bounds.
void SolidCollector::put(Index part, ShapeLists& lists) {
    Node& node = solids_.nodes_[part];
    Bounds& bounds = solids_.bounds_[part];
    const auto in_list = [&]<class Shape>(const Shape& shape) {
        std::get<ShapeList<InFloat<Shape>>>(lists).add(shape, node.shape);
    };
    const auto with_bounds = [&](const QuadricOf<double>& surface) {
        const QuadricOf<double> quadric = within(surface, bounds);
        shapes_[part] = quadric;
        node.kind = Kind::quadric;
        in_list(quadric);
    };
    std::visit(
        [&]<class Shape>(const Shape& shape) {
            // Counting needs all crossings of these parts, wherever they are.
            if constexpr (is_solid<Shape>)
                if (node.parent != Solids::none && solids_.nodes_[node.parent].counts)
                    bounds = core::bounds_of(shape);
            if constexpr (kind_of<Shape> == Kind::quadric) {
                assert(is_finite(bounds)); // ensured by add()
                with_bounds(shape);
            } else if constexpr (kind_of<Shape> == Kind::plane) {
                node.flat = true;
                if (is_finite(bounds)) {
                    QuadricOf<double> half_space{};
                    half_space.center = shape.point;
                    half_space.x = shape.normal.x;
                    half_space.y = shape.normal.y;
                    half_space.z = shape.normal.z;
                    with_bounds(half_space);
                } else {
                    in_list(shape);
                }
            } else {
                in_list(shape);
            }
        },
        PartShape(shapes_[part]));
}

/// Returns true if the inside of a node is within the bounds of a part that rays cross.
bool SolidCollector::is_covered(Index index) const {
    const Node& node = solids_.nodes_[index];
    if (node.op == Solids::Op::part)
        return node.traced && !node.reversed &&
               with_shape_type(node.kind, []<class Shape>(std::type_identity<Shape>) {
                   return is_solid<Shape>;
               });
    const bool of_all = node.op == Solids::Op::all;
    bool covered = !of_all;
    solids_.each_child(index, [&](Index child) {
        covered = is_covered(child);
        return covered != of_all;
    });
    return covered;
}

/// Extends the bounds of a node's first traced part, so that the hierarchy finds the part wherever
/// the node has an inside.
void SolidCollector::cover(Index index, const Bounds& bounds) {
    if (is_covered(index)) return;
    for (Index part = index; part < solids_.nodes_[index].end; ++part)
        if (solids_.nodes_[part].op == Solids::Op::part && solids_.nodes_[part].traced) {
            solids_.bounds_[part].include(bounds);
            return;
        }
}

void SolidCollector::note_counted(Index solid) {
    Index counted = Solids::none;
    int of_many = 0;
    for (Index index = solid; index < solids_.nodes_[solid].end; ++index) {
        if (!solids_.nodes_[index].many) continue;
        ++of_many;
        counted = index;
    }
    if (of_many != 1 || !solids_.nodes_[counted].counts) return;
    solids_.counted_.resize(solids_.nodes_.size(), Solids::none);
    solids_.counted_[solid] = counted;
    Bounds joined;
    for (Index part = counted + 1; part < solids_.nodes_[counted].end; ++part)
        if (solids_.nodes_[part].traced) joined.include(solids_.bounds_[part]);
    if (counted != solid)
        solids_.bounds_[counted] = joined;
    else
        solids_.bounds_[solid].include(joined);
}

void SolidCollector::list(ShapeLists& lists) {
    std::vector<Node>& nodes = solids_.nodes_;
    solids_.media_.resize(nodes.size(), no_material);
    solids_.bounds_.resize(nodes.size());
    for (auto index = static_cast<Index>(nodes.size()); index-- > 0;) {
        Node& node = nodes[index];
        if (node.op == Solids::Op::part) {
            if (node.shape == no_shape) continue;
            if (node.shape >= solids_.node_of_.size())
                solids_.node_of_.resize(std::size_t{node.shape} + 1, Solids::none);
            solids_.node_of_[node.shape] = index;
            continue;
        }
        Index children = 0;
        solids_.each_child(index, [&](Index child) {
            node.shape = std::min(node.shape, nodes[child].shape);
            ++children;
            return true;
        });
        // The hierarchy has no parts that rays do not cross.
        const bool is_traced =
            std::all_of(nodes.begin() + index, nodes.begin() + node.end, [](const Node& part) {
                return part.op != Solids::Op::part || part.traced;
            });
        node.many = node.op == Solids::Op::any && children > Solids::few_parts && is_traced;
        node.counts =
            node.many && node.end - index == children + 1 &&
            std::none_of(nodes.begin() + index + 1, nodes.begin() + node.end, [](const Node& part) {
                return part.reversed || part.kind == Kind::plane || part.kind == Kind::quadric;
            });
    }
    SolidNarrowing narrowing(nodes, shapes_, solids_.bounds_);
    for (Index solid = 0; solid < nodes.size(); solid = nodes[solid].end) {
        find_bounds(solid, narrowing);
        const Bounds solid_bounds = solids_.bounds_[solid];
        for (Index part = solid; part < nodes[solid].end; ++part)
            if (nodes[part].op == Solids::Op::part && nodes[part].traced) put(part, lists);
        note_counted(solid);
        nodes[solid].open = std::any_of(
            nodes.begin() + solid, nodes.begin() + nodes[solid].end, [](const Node& node) {
                return node.op == Solids::Op::part && node.shape == no_shape && !node.cuts_nothing;
            });
        if (is_finite(solid_bounds)) cover(solid, solid_bounds);
        for (Index index = solid; index < nodes[solid].end; ++index)
            if (nodes[index].many)
                solids_.each_child(index, [&](Index child) {
                    cover(child, common(hulls_[child].inside, solid_bounds));
                    return true;
                });
    }
}

void Solids::find_places(const Tables& tables) {
    for_each_table(tables, [&]<class Shape>(const Table<Shape>& table) {
        for (std::uint32_t block = 0; block < table.blocks().size(); ++block)
            for_each_in_block(table, block, [&](Place place, ShapeId id) {
                if (const Index part = part_of(id); part != none) nodes_[part].place = place;
            });
        std::size_t hidden = 0;
        for (Index index = 0; index < nodes_.size(); ++index)
            if (is_hidden(index, kind_of<Shape>))
                nodes_[index].place = table.hidden_place(hidden++);
    });
}

Solids SolidCollector::finish(Tables& tables) {
    for_each_table(tables, [&]<class Shape>(Table<Shape>& table) {
        ShapeList<Shape> hidden;
        for (Index index = 0; index < solids_.nodes_.size(); ++index)
            if (solids_.is_hidden(index, kind_of<Shape>))
                hidden.add(std::get<InDouble<Shape>>(shapes_[index]), no_shape);
        if (hidden.size() != 0) table.hide(hidden);
    });
    solids_.find_places(tables);
    shapes_ = {};
    hulls_ = {};
    return std::move(solids_);
}

} // namespace raylane::core
