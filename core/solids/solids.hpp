#pragma once

#include "core/numbers/bounded.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/solid.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

/// Solids that are made of others, in a scene. Each is an expression of `all` (intersections) and
/// `any` (unions) of its parts or, where they are reversed, of what is outside of these; so it
/// never shrinks where a part grows, reversed ones as they are. Parts are shapes of the scene like
/// others, which rays cross like others: a crossing is one of the solid where the expression's
/// value is another before than behind it.
namespace raylane::core {

enum class Value : std::uint8_t { no, yes, unknown };

constexpr Value operator!(Value value) {
    return value == Value::unknown ? value : value == Value::no ? Value::yes : Value::no;
}

/// A solid in numbers that need not be points: whatever is true of all that they may stand for.
using Somewhere = Vec3<Bounded<double>>;

/// Where a box is.
Somewhere somewhere_in(const Bounds& bounds);

/// True for all points inside of a shape, or not for any.
template <class Shape>
Value inside_of(const Shape& shape, const Somewhere& point) {
    const auto negative = [](const Bounded<double>& form) {
        return form.value < -form.error  ? Value::yes
               : form.value > form.error ? Value::no
                                         : Value::unknown;
    };
    if constexpr (has_inside<Shape>) {
        Value all = Value::yes;
        for (const Bounded<double>& form : forms_at(shape, point)) {
            const Value inside = negative(form);
            if (inside == Value::no) return inside;
            if (inside == Value::unknown) all = inside;
        }
        return all;
    } else {
        return Value::unknown;
    }
}

class Solids {
  public:
    using Index = std::uint32_t;
    static constexpr Index none = std::numeric_limits<Index>::max();
    /// Parts up to which all are looked at, one after the other.
    static constexpr Index few_parts = 16;

    enum class Op : std::uint8_t { part, all, any };
    struct Node {
        Op op;
        bool reversed = false; ///< part: what is outside of the shape
        bool traced = true;    ///< part: rays cross it
        bool many = false;     ///< any, of so many that they are looked for in the hierarchy
        bool counts = false;   ///< many, each of them one shape: how many a ray is inside of counts
        bool fills = false;    ///< part: the solid has all that is inside of it
        bool flat = false;     ///< part: a plane, whatever its kind
        bool cuts_nothing = false; ///< part that is not traced: others are inside of it
        bool open = false;         ///< whole solid: something cuts it that has no surface
        Kind kind{};               ///< part
        Place place{};             ///< part
        ShapeId shape = no_shape;  ///< part that is a shape of the scene; else the first of these
        Index parent = none;
        Index end = 0; ///< behind its last descendant; the first follows it
    };

    bool any() const { return !nodes_.empty(); }
    bool has(ShapeId id) const { return id < node_of_.size() && node_of_[id] != none; }
    /// The part that a shape is.
    Index part_of(ShapeId id) const { return id < node_of_.size() ? node_of_[id] : none; }
    const Node& node(Index index) const { return nodes_[index]; }
    /// Of all solids, one after the other.
    std::span<const Node> nodes() const { return nodes_; }
    Index root_of(Index index) const {
        while (nodes_[index].parent != none)
            index = nodes_[index].parent;
        return index;
    }
    /// The ancestor of a descendant of `above` that is its child.
    Index child_of(Index above, Index index) const {
        while (nodes_[index].parent != above)
            index = nodes_[index].parent;
        return index;
    }
    /// Calls visit(index of child) until it returns false.
    template <class Visit>
    void each_child(Index parent, const Visit& visit) const {
        for (Index child = parent + 1; child < nodes_[parent].end; child = nodes_[child].end)
            if (!visit(child)) return;
    }
    /// True if the outside of a part is what counts as in.
    bool is_reversed(ShapeId id) const { return has(id) && nodes_[node_of_[id]].reversed; }
    /// The id by which a part's solid goes: that of its first part. Of other shapes their own.
    ShapeId solid_of(ShapeId id) const {
        return has(id) ? nodes_[root_of(node_of_[id])].shape : id;
    }
    /// The only union of many in a solid, if how many of its parts a ray is inside of counts.
    Index counted_of(Index solid) const { return counted_.empty() ? none : counted_[solid]; }
    /// True if something cuts a part's solid that has no surface.
    bool is_open(ShapeId id) const { return has(id) && nodes_[root_of(node_of_[id])].open; }
    /// The material inside of the part's solid.
    MaterialIndex medium_of(ShapeId id) const { return medium(root_of(node_of_[id])); }
    /// Of a whole solid.
    MaterialIndex medium(Index solid) const { return media_[solid]; }
    /// Where a part may be seen of its solid; for others null.
    const Bounds* bounds_of(ShapeId id) const { return has(id) ? &bounds_[node_of_[id]] : nullptr; }
    /// Of a whole solid, or of all parts of a union that counts.
    const Bounds& bounds(Index index) const { return bounds_[index]; }

    std::size_t bytes() const {
        return nodes_.capacity() * sizeof(Node) + node_of_.capacity() * sizeof(Index) +
               bounds_.capacity() * sizeof(Bounds) + media_.capacity() * sizeof(MaterialIndex) +
               counted_.capacity() * sizeof(Index);
    }

  private:
    friend class SolidCollector;

    std::vector<Node> nodes_;
    std::vector<Index> node_of_;       // by shape
    std::vector<Bounds> bounds_;       // by node
    std::vector<MaterialIndex> media_; // by node, of those that are whole solids
    std::vector<Index> counted_;       // by node, of the same; empty if there is none
};

/// Collects solids while a scene is built.
class SolidCollector {
  public:
    bool any() const { return !solids_.nodes_.empty(); }

    /// Adds a solid, all of whose shapes are valid. Calls add_part(material) for each that is to be
    /// a shape of the scene, which returns its id. Throws InvalidValue, and is as before, for what
    /// has no bounds and would need some.
    template <class AddPart>
    void add(const Solid& solid, MaterialIndex material, const AddPart& add_part);

    void renumber_materials(std::span<const MaterialIndex> new_index) {
        for (MaterialIndex& medium : solids_.media_)
            if (medium != no_material) medium = new_index[medium];
    }

    /// Finds out which parts of shapes may be seen, and puts those that may into the lists.
    void list(ShapeLists& lists);
    /// As far as they are known before the tables are filled.
    const Solids& solids() const { return solids_; }
    /// Once the tables are filled. What is not traced is put into them, too.
    Solids finish(Tables& tables);

  private:
    using Node = Solids::Node;
    using Index = Solids::Index;

    template <class AddPart>
    void add_node(const Solid& solid, MaterialIndex material, bool reversed, bool traced,
                  Index parent, const AddPart& add_part);
    Index begin(Solids::Op op, Index parent);
    static PartShape as_half_space(const PartShape& shape);
    void find_bounds(Index solid);
    void note_counted(Index solid);
    Bounds bounds_of_part(Index index, bool outside) const;
    void find_hulls(Index first);
    Bounds allowed(Index part) const;
    bool has_bounds(Index solid) const;
    Value value_in(Index index, const Somewhere& point) const;
    Value matters_in(Index part, const Somewhere& point) const;
    void put(Index part, const Bounds& of_solid, ShapeLists& lists);
    bool is_covered(Index index) const;
    void cover(Index index, const Bounds& bounds);

    Solids solids_;
    /// Bounds of what is in a node, and of what is not.
    struct Hulls {
        Bounds inside, outside;
    };
    std::vector<PartShape> shapes_;              // by node
    std::vector<Hulls> hulls_;                   // the same
    MaterialIndex first_material_ = no_material; // of the solid that is being added
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
        throw InvalidValue("", "must have bounds, for it is made of a quadric: intersect it with "
                               "a box");
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
            node.shape = add_part(material);
            if (first_material_ == no_material) first_material_ = material;
        }
        return;
    }
    // The outside of an intersection is the union of what is outside of its parts.
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
