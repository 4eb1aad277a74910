#pragma once

#include "core/numbers/bounded.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/solid.hpp"

#include <cstdint>
#include <limits>
#include <span>
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

} // namespace raylane::core
