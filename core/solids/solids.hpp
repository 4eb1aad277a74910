#pragma once

#include "core/numbers/bounded.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/solid.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Solids of a scene that are made of others. Each is an expression of intersections (`all`) and
/// unions (`any`) of its parts. A reversed part counts by its outside. Counting reversed parts as
/// they are, the solid therefore never shrinks if a part grows. Parts are shapes of the scene like
/// others, and rays cross them like others. A crossing of a part is one of the solid if the
/// expression's value changes there.
namespace raylane::core {

enum class Value : std::uint8_t { no, yes, unknown };

constexpr Value operator!(Value value) {
    return value == Value::unknown ? value : value == Value::no ? Value::yes : Value::no;
}

/// A point with bounds. It stands for all points within them: a function of it gives an answer that
/// holds for all of them.
using Somewhere = Vec3<Bounded<double>>;

/// Returns the position of a box: all its points.
Somewhere somewhere_in(const Bounds& bounds);

/// Returns yes if all points are inside of a shape, no if no point is.
template <class Shape>
Value inside_of(const Shape& shape, const Somewhere& point) {
    const auto negative = [](const Bounded<double>& form) {
        return form.value < -form.error  ? Value::yes
               : form.value > form.error ? Value::no
                                         : Value::unknown;
    };
    if constexpr (has_inside<Shape>) {
        Value value = Value::yes;
        for (const Bounded<double>& form : forms_at(shape, point)) {
            const Value inside = negative(form);
            if (inside == Value::no) return inside;
            if (inside == Value::unknown) value = inside;
        }
        return value;
    } else {
        return Value::unknown;
    }
}

class Solids {
  public:
    using Index = std::uint32_t;
    static constexpr Index none = std::numeric_limits<Index>::max();
    /// Maximum number of parts that are tested one after the other.
    static constexpr Index few_parts = 16;

    enum class Op : std::uint8_t { part, all, any };
    struct Node {
        Op op;
        bool reversed = false; ///< part: the outside of the shape
        bool traced = true;    ///< part: rays cross it
        bool many = false;     ///< any: a union of many, whose children are found by the hierarchy
        bool counts = false;   ///< many, of single shapes: rays count how many they are inside of
        bool fills = false;    ///< part: the solid contains its whole inside
        bool flat = false;     ///< part: a plane, whatever its kind
        bool cuts_nothing = false; ///< untraced part: the others are inside of it
        bool open = false;         ///< whole solid: a part without a surface cuts it
        Kind kind{};               ///< part
        Place place{};             ///< part
        ShapeId shape = no_shape; ///< a part's shape in the scene; otherwise that of its first part
        Index parent = none;
        Index end = 0; ///< behind its last descendant; the first follows it
    };

    bool any() const { return !nodes_.empty(); }
    bool has(ShapeId id) const { return id < node_of_.size() && node_of_[id] != none; }
    /// Returns the part that a shape is.
    Index part_of(ShapeId id) const { return id < node_of_.size() ? node_of_[id] : none; }
    const Node& node(Index index) const { return nodes_[index]; }
    /// Returns the nodes of all solids, one solid after the other.
    std::span<const Node> nodes() const { return nodes_; }
    Index root_of(Index index) const {
        while (nodes_[index].parent != none)
            index = nodes_[index].parent;
        return index;
    }
    /// Returns the child of `above` that is, or contains, its descendant `index`.
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
    /// Returns true if the outside of a part counts as its inside.
    bool is_reversed(ShapeId id) const { return has(id) && nodes_[node_of_[id]].reversed; }
    /// Returns the id of a part's solid, which is that of its first part. Other shapes have their
    /// own id.
    ShapeId solid_of(ShapeId id) const {
        return has(id) ? nodes_[root_of(node_of_[id])].shape : id;
    }
    /// Returns the only union of many in a solid, if rays count the parts that they are inside of.
    Index counted_of(Index solid) const { return counted_.empty() ? none : counted_[solid]; }
    /// Returns true if a part without a surface cuts the part's solid.
    bool is_open(ShapeId id) const { return has(id) && nodes_[root_of(node_of_[id])].open; }
    /// Returns the material inside of the part's solid.
    MaterialIndex medium_of(ShapeId id) const { return medium(root_of(node_of_[id])); }
    /// Returns the material of a whole solid.
    MaterialIndex medium(Index solid) const { return media_[solid]; }
    /// Returns the bounds within which a part of a solid may be visible; null for other shapes.
    const Bounds* bounds_of(ShapeId id) const { return has(id) ? &bounds_[node_of_[id]] : nullptr; }
    /// Returns the bounds of a whole solid, or of all parts of a union that counts.
    const Bounds& bounds(Index index) const { return bounds_[index]; }

    /// Finds the places of all parts in the tables of the scene.
    void find_places(const Tables& tables);

    std::size_t bytes() const {
        return nodes_.capacity() * sizeof(Node) + node_of_.capacity() * sizeof(Index) +
               bounds_.capacity() * sizeof(Bounds) + media_.capacity() * sizeof(MaterialIndex) +
               counted_.capacity() * sizeof(Index);
    }

  private:
    friend class SolidCollector;

    /// Returns true for a part of this kind that rays do not cross.
    bool is_hidden(Index index, Kind kind) const {
        const Node& node = nodes_[index];
        return node.op == Op::part && !node.traced && node.kind == kind;
    }

    std::vector<Node> nodes_;
    std::vector<Index> node_of_;       // by shape
    std::vector<Bounds> bounds_;       // by node
    std::vector<MaterialIndex> media_; // by node, set for whole solids
    std::vector<Index> counted_;       // by node, set for whole solids; empty if no solid counts
};

} // namespace raylane::core
