#include "core/solids/narrowing.hpp"

#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <limits>

namespace raylane::core {

namespace {

/// Returns the maximum number of terms of an expression for each part of its group. A solid of
/// hundreds of parts can have all its terms.
std::size_t terms_for_each(std::size_t parts) {
    return std::max<std::size_t>(64, (std::size_t{1} << 19) / parts);
}

/// Returns the maximum number of terms to evaluate for the bounds of each part. Beyond it, the
/// bounds stay as they are.
std::size_t max_steps(std::size_t parts) {
    return std::min<std::size_t>(std::size_t{1} << 13, (std::size_t{1} << 23) / parts);
}

} // namespace

SolidNarrowing::Expression SolidNarrowing::expression_of(Index solid) const {
    Expression expression;
    for (Index index = solid; index < nodes_[solid].end; ++index)
        expression.terms.push_back({index, std::size_t{nodes_[index].end} - solid});
    return expression;
}

Value SolidNarrowing::value_of(Index part, const Somewhere& point) const {
    const Value inside =
        std::visit([&](const auto& shape) { return inside_of(shape, point); }, shapes_[part]);
    return nodes_[part].reversed ? !inside : inside;
}

bool SolidNarrowing::needs_inside(Index part) const {
    const Solids::Node& node = nodes_[part];
    bool needs =
        !node.reversed && with_shape_type(node.kind, []<class Shape>(std::type_identity<Shape>) {
            return is_solid<Shape>;
        });
    for (Index above = node.parent; above != Solids::none; above = nodes_[above].parent)
        needs = needs || nodes_[above].many; // the hierarchy finds its parts by their inside
    return needs;
}

/// Copies an expression without the parts that are decided in a box.
void SolidNarrowing::reduce(const Expression& from, const Somewhere& box, Expression& to) {
    to.terms.clear();
    to.value = from.value;
    if (from.value == Value::unknown) to.value = reduce_term(from.terms, 0, box, to.terms);
}

Value SolidNarrowing::reduce_term(const std::vector<Term>& from, std::size_t at,
                                  const Somewhere& box, std::vector<Term>& to) {
    ++steps_;
    const Term& term = from[at];
    const Solids::Node& node = nodes_[term.node];
    const std::size_t begin = to.size();
    if (node.op == Solids::Op::part) {
        const bool is_kept = is_of_group(term.node);
        const Value value = is_kept ? Value::unknown : value_of(term.node, box);
        if (is_kept || (value == Value::unknown && begin < max_terms_))
            to.push_back({term.node, begin + 1});
        return value;
    }
    to.push_back({term.node, 0, term.is_cut});
    const Value decides = node.op == Solids::Op::all ? Value::no : Value::yes;
    bool is_decided = !term.is_cut && !node.many;
    for (std::size_t child = at + 1; child < term.end; child = from[child].end) {
        if (node.many) { // evaluates only the group's parts
            const auto is_kept = [&](const Term& kept) { return is_of_group(kept.node); };
            if (std::any_of(&from[child], &from[0] + from[child].end, is_kept))
                reduce_term(from, child, box, to);
            continue;
        }
        const std::size_t before = to.size();
        const Value value = reduce_term(from, child, box, to);
        if (value == decides) {
            to.resize(begin);
            return value;
        }
        if (value != Value::unknown) continue;
        is_decided = false;
        if (to.size() == before) to[begin].is_cut = true;
    }
    if (is_decided) {
        to.resize(begin);
        return !decides;
    }
    to[begin].end = to.size();
    if (to.size() == begin + 1 && begin >= max_terms_) to.pop_back(); // all its terms are cut
    return Value::unknown;
}

/// Tells if a point's side of a part matters for the solid in an expression's box.
Value SolidNarrowing::matters(Index part, const Expression& expression) const {
    Value matters = Value::yes;
    bool is_there = false;
    for (const Term& term : expression.terms) {
        const Solids::Node& node = nodes_[term.node];
        is_there = is_there || term.node == part;
        const bool is_other = part < term.node || node.end <= part;
        if (is_other || (term.is_cut && !node.many)) matters = Value::unknown;
    }
    return is_there ? matters : Value::no;
}

void SolidNarrowing::narrow_whole(Index solid) {
    first_ = last_ = 0;
    solid_ = solid;
    number_.assign(nodes_[solid].end - solid, std::numeric_limits<std::size_t>::max());
    max_terms_ = number_.size();
    reduced_.back() = expression_of(solid);
    steps_ = 0;
    const std::size_t most = std::max<std::size_t>(std::size_t{1} << 14, 16 * number_.size());
    bounds_[solid] = hull_in(bounds_[solid], [&](const Somewhere& point, std::size_t halvings) {
        if (steps_ > most) return true;
        reduce(reduced_[halvings + 1], point, reduced_[halvings]);
        return reduced_[halvings].value != Value::no;
    });
}

void SolidNarrowing::narrow_parts(Index solid, std::vector<Index> parts) {
    solid_ = solid;
    number_.assign(nodes_[solid].end - solid, std::numeric_limits<std::size_t>::max());
    parts_ = std::move(parts);
    if (!parts_.empty()) narrow_group(0, parts_.size(), expression_of(solid));
}

void SolidNarrowing::narrow_group(std::size_t first, std::size_t last,
                                  const Expression& expression) {
    Bounds common_bounds;
    for (std::size_t i = first; i < last; ++i) {
        number_[parts_[i] - solid_] = i;
        common_bounds.include(bounds_[parts_[i]]);
    }
    first_ = first;
    last_ = last;
    max_terms_ = terms_for_each(number_.size()) * (last - first);
    Expression reduced;
    reduce(expression, somewhere_in(common_bounds), reduced);
    if (last - first == 1) return narrow_part(parts_[first], reduced);
    const Vec3d size = convert<double>(common_bounds.upper) - convert<double>(common_bounds.lower);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto twice_the_middle = [&](Index part) {
        return static_cast<double>(bounds_[part].lower[axis]) +
               static_cast<double>(bounds_[part].upper[axis]);
    };
    const std::size_t middle = first + (last - first) / 2;
    Index* const parts = parts_.data();
    std::nth_element(parts + first, parts + middle, parts + last, [&](Index a, Index b) {
        const double of_a = twice_the_middle(a), of_b = twice_the_middle(b);
        return of_a != of_b ? of_a < of_b : a < b;
    });
    narrow_group(first, middle, reduced);
    narrow_group(middle, last, reduced);
}

/// Narrows a part's bounds. `expression` is reduced to these bounds.
void SolidNarrowing::narrow_part(Index part, const Expression& expression) {
    Solids::Node& node = nodes_[part];
    Bounds& bounds = bounds_[part];
    const Value value = matters(part, expression);
    node.fills = value == Value::yes && !node.reversed &&
                 std::visit(
                     [&]<class Shape>(const Shape& shape) {
                         if constexpr (is_solid<Shape>)
                             return contains(bounds, core::bounds_of(shape));
                         return false;
                     },
                     shapes_[part]);
    if (value == Value::unknown) {
        const bool with_inside = needs_inside(part);
        reduced_.back() = expression;
        steps_ = 0;
        const std::size_t most = max_steps(number_.size());
        bounds = hull_in(bounds, [&](const Somewhere& point, std::size_t halvings) {
            const Value inside = value_of(part, point);
            if (inside != Value::unknown && !(with_inside && inside == Value::yes)) return false;
            if (steps_ > most) return true;
            reduce(reduced_[halvings + 1], point, reduced_[halvings]);
            return matters(part, reduced_[halvings]) != Value::no;
        });
    }
    node.traced = value != Value::no && !is_empty(bounds);
}

} // namespace raylane::core
