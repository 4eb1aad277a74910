#pragma once

#include "core/solids/hull.hpp"
#include "core/solids/solids.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace raylane::core {

/// Narrows the bounds of a solid and of its parts to the places where they matter.
///
/// Halves the parts by position into groups, again and again. Each group passes on the solid's
/// expression without the parts that are decided in the group's bounds. So the number of steps for
/// n parts grows with n * log(n). The terms of a group's expression and the steps for each part are
/// limited. Therefore bounds are wider than they could be if many parts stay undecided together.
class SolidNarrowing {
  public:
    using Index = Solids::Index;

    /// Takes the nodes, shapes and bounds of all solids. The caller has set the bounds to narrow.
    SolidNarrowing(std::vector<Solids::Node>& nodes, const std::vector<PartShape>& shapes,
                   std::vector<Bounds>& bounds)
        : nodes_(nodes), shapes_(shapes), bounds_(bounds) {}

    /// Narrows the bounds of a whole solid, which are finite.
    void narrow_whole(Index solid);
    /// Narrows the bounds of parts of a solid, which are finite. A part that matters nowhere is no
    /// longer traced. A part whose whole inside belongs to the solid is marked (Node::fills).
    void narrow_parts(Index solid, std::vector<Index> parts);

    /// Returns true if the bounds of a part must contain its inside, and not only its surface,
    /// because the search has to find rays that are inside of the part.
    bool needs_inside(Index part) const;

  private:
    /// A node of an expression that is undecided in a box.
    struct Term {
        Index node;
        std::size_t end;     ///< behind its last descendant; the first follows it
        bool is_cut = false; ///< undecided children without terms exist
    };
    /// A solid in a box.
    struct Expression {
        Value value = Value::unknown; ///< yes or no: `terms` is empty
        std::vector<Term> terms;
    };

    Expression expression_of(Index solid) const;
    Value value_of(Index part, const Somewhere& point) const;
    void reduce(const Expression& from, const Somewhere& box, Expression& to);
    Value reduce_term(const std::vector<Term>& from, std::size_t at, const Somewhere& box,
                      std::vector<Term>& to);
    Value matters(Index part, const Expression& expression) const;
    void narrow_group(std::size_t first, std::size_t last, const Expression& expression);
    void narrow_part(Index part, const Expression& expression);
    /// Returns true for a part of the group whose expression is being reduced.
    bool is_of_group(Index node) const {
        const std::size_t number = number_[node - solid_];
        return first_ <= number && number < last_;
    }

    std::vector<Solids::Node>& nodes_;
    const std::vector<PartShape>& shapes_;
    std::vector<Bounds>& bounds_;
    Index solid_ = 0;
    std::vector<Index> parts_;         // by place
    std::vector<std::size_t> number_;  // index in parts_, by node of the solid
    std::size_t first_ = 0, last_ = 0; // of the group
    std::size_t max_terms_ = 0, steps_ = 0;
    std::array<Expression, max_halvings + 2> reduced_; // by remaining halvings of a hull
};

} // namespace raylane::core
