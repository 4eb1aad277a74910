#pragma once

#include "core/shapes/invalid_value.hpp"
#include "core/solids/solids.hpp"

#include <span>
#include <utility>
#include <vector>

namespace raylane::core {

class SolidNarrowing;

/// Collects solids while a scene is built.
class SolidCollector {
  public:
    bool any() const { return !solids_.nodes_.empty(); }

    /// Adds a solid, whose shapes must all be valid. Calls add_part(material, space) for each shape
    /// that becomes one of the scene; it returns the shape's id. Throws InvalidValue, and changes
    /// nothing, if the solid needs bounds and has none.
    template <class AddPart>
    void add(const Solid& solid, MaterialIndex material, const AddPart& add_part);

    void renumber_materials(std::span<const MaterialIndex> new_index) {
        for (MaterialIndex& medium : solids_.media_)
            if (medium != no_material) medium = new_index[medium];
    }

    /// Determines which parts may be visible, and adds these to the lists.
    void list(ShapeLists& lists);
    /// Returns the solids, as far as they are known before the tables are filled.
    const Solids& solids() const { return solids_; }
    /// Returns the solids. Call it once the tables are filled; adds untraced parts to them, too.
    Solids finish(Tables& tables);

  private:
    using Node = Solids::Node;
    using Index = Solids::Index;

    template <class AddPart>
    void add_node(const Solid& solid, MaterialIndex material, bool reversed, bool traced,
                  Index parent, const AddPart& add_part);
    Index begin(Solids::Op op, Index parent);
    static PartShape as_half_space(const PartShape& shape);
    void note_counted(Index solid);
    Bounds bounds_of_shape(Index part) const;
    Bounds bounds_of_part(Index index, bool outside) const;
    Bounds bounds_between_parts(Index index) const;
    void find_hulls(Index first);
    Bounds allowed(Index part) const;
    bool has_bounds(Index solid) const;
    void find_bounds(Index solid, SolidNarrowing& narrowing);
    void put(Index part, ShapeLists& lists);
    bool is_covered(Index index) const;
    void cover(Index index, const Bounds& bounds);

    Solids solids_;
    /// Bounds of the inside and the outside of a node.
    struct Hulls {
        Bounds inside, outside;
    };
    std::vector<PartShape> shapes_;              // by node
    std::vector<Hulls> hulls_;                   // by node
    MaterialIndex first_material_ = no_material; // first material of the solid being added
};

template <class AddPart>
void SolidCollector::add(const Solid& solid, MaterialIndex material, const AddPart& add_part) {
    const auto root = static_cast<Index>(solids_.nodes_.size());
    first_material_ = no_material;
    add_node(solid, material, false, true, Solids::none, add_part);
    find_hulls(root);
    if (!has_bounds(root)) {
        solids_.nodes_.resize(root);
        shapes_.resize(root);
        hulls_.resize(root);
        throw InvalidValue("",
                           "must be bounded, got an unbounded quadric: intersect it with a box");
    }
    if (solid.material != no_material) material = solid.material;
    solids_.media_.resize(solids_.nodes_.size(), no_material);
    solids_.media_[root] = material != no_material ? material : first_material_;
}

template <class AddPart>
void SolidCollector::add_node(const Solid& solid, MaterialIndex material, bool reversed,
                              bool traced, Index parent, const AddPart& add_part) {
    if (solid.material != no_material) material = solid.material;
    if (solid.endless_as_part && parent != Solids::none)
        return add_node(solid.parts.front(), material, reversed, traced, parent, add_part);
    if (solid.made == Made::of_shape) {
        const Index index = begin(Solids::Op::part, parent);
        Node& node = solids_.nodes_[index];
        node.reversed = reversed;
        node.traced = traced;
        node.cuts_nothing = solid.cuts_nothing;
        shapes_[index] = as_half_space(solid.shape);
        node.kind = static_cast<Kind>(shapes_[index].index());
        if (traced) {
            node.shape = add_part(material, solid.space);
            if (first_material_ == no_material) first_material_ = material;
        }
        return;
    }
    // The outside of an intersection is the union of the outsides of its parts.
    const Solids::Op op =
        (solid.made != Made::by_union) != reversed ? Solids::Op::all : Solids::Op::any;
    const bool is_of_parent = parent != Solids::none && solids_.nodes_[parent].op == op;
    const Index index = is_of_parent ? parent : begin(op, parent);
    bool first = true;
    for (const Solid& part : solid.parts) {
        const bool is_other = !std::exchange(first, false);
        const bool is_taken_away = solid.made == Made::by_difference && is_other;
        const bool cuts = solid.made == Made::by_clip && is_other;
        add_node(part, material, reversed != is_taken_away, traced && !cuts, index, add_part);
    }
    if (!is_of_parent) solids_.nodes_[index].end = static_cast<Index>(solids_.nodes_.size());
}

} // namespace raylane::core
