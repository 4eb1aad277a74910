#pragma once

#include "tests/support/any_shape.hpp"

#include <algorithm>
#include <map>
#include <vector>

/// Solids of solids, from the exact crossings of a whole line with each part. Between two crossings
/// nothing changes. So the values of the expression from one crossing to the next tell where the
/// solid's surface is.
namespace raylane::oracle {

enum class Op { part, unite, intersect, subtract, clip };

/// An expression of parts. Parts are numbered in their order; clipping parts have no number.
struct Expression {
    Op op = Op::part;
    tests::AnyShapeInDouble shape{};
    std::vector<Expression> operands{};
};

/// A surface that a ray crosses.
struct SolidHit {
    Hit hit;
    core::ShapeId shape;
    bool entering; ///< whether the ray enters the solid
};

class SolidLine {
  public:
    SolidLine(const Expression& expression, const core::Ray<double>& ray) : ray_(ray) {
        add(expression, true);
        core::ShapeId next = 0;
        for (Part& part : parts_)
            if (part.traced) part.id = next++;
    }

    /// Returns the surfaces ahead of the ray, in order.
    std::vector<SolidHit> surfaces() {
        std::vector<const Event*> events;
        for (const Part& part : parts_)
            for (const Event& event : part.events)
                events.push_back(&event);
        std::sort(events.begin(), events.end(),
                  [](const Event* a, const Event* b) { return compare(a->hit, b->hit) < 0; });
        std::vector<SolidHit> found;
        for (Part& part : parts_)
            part.before = part.behind = part.at_first;
        for (std::size_t first = 0, end = 0; first < events.size(); first = end) {
            while (end < events.size() && compare(events[end]->hit, events[first]->hit) == 0)
                ++end;
            // A part that is entered and left at the same t does not change.
            std::map<std::size_t, int> crossed;
            for (std::size_t i = first; i < end; ++i)
                crossed[events[i]->part] += 1;
            for (const auto& [part, times] : crossed)
                if (times == 1) parts_[part].behind = !parts_[part].before;
            if (value(0, false) != value(0, true)) {
                const Part& part = parts_[changed(0, value(0, true))];
                for (std::size_t i = first; i < end; ++i)
                    if (part.traced && &parts_[events[i]->part] == &part && events[i]->hit.t > 0)
                        found.push_back({events[i]->hit, part.id, value(0, true)});
            }
            for (const auto& [part, times] : crossed)
                parts_[part].before = parts_[part].behind;
        }
        return found;
    }

    /// Returns -1 if the origin is inside, 1 if it is outside, and 0 if it is on the surface of any
    /// part.
    int side_of_origin() {
        for (Part& part : parts_) {
            part.before = part.at_first;
            for (const Event& event : part.events) {
                if (event.hit.t == 0) return 0;
                if (event.hit.t < 0) part.before = !part.before;
            }
            if (part.is_flat_on_it) return 0;
        }
        return value(0, false) ? -1 : 1;
    }

  private:
    struct Event {
        Hit hit;
        std::size_t part;
    };
    struct Part {
        Op op;
        bool traced = true;
        core::ShapeId id = core::no_shape;
        std::vector<std::size_t> operands{};
        std::vector<Event> events{};
        bool at_first = false; ///< value far behind the ray
        bool is_flat_on_it = false;
        bool before = false, behind = false;
    };

    std::size_t add(const Expression& expression, bool traced) {
        const std::size_t index = parts_.size();
        parts_.push_back({expression.op, traced && expression.op == Op::part});
        if (expression.op == Op::part) {
            fill(index, expression.shape);
            return index;
        }
        for (std::size_t i = 0; i < expression.operands.size(); ++i) {
            const bool cuts = expression.op == Op::clip && i != 0;
            const std::size_t child = add(expression.operands[i], traced && !cuts);
            parts_[index].operands.push_back(child);
        }
        return index;
    }

    void fill(std::size_t index, tests::AnyShapeInDouble shape) {
        std::visit(
            [&]<class Shape>(Shape& object) {
                if constexpr (core::kind_of<Shape> == core::Kind::quadric) {
                    object.lower = core::Vec3d(-1e200);
                    object.upper = core::Vec3d(1e200);
                }
            },
            shape);
        Part& part = parts_[index];
        for (const Hit& hit : crossings(shape, ray_))
            part.events.push_back({hit, index});
        std::sort(part.events.begin(), part.events.end(),
                  [](const Event& a, const Event& b) { return compare(a.hit, b.hit) < 0; });
        const bool touches =
            part.events.size() == 2 && compare(part.events[0].hit, part.events[1].hit) == 0;
        if (!part.events.empty() && !touches) {
            part.at_first = !part.events[0].hit.entering;
            return;
        }
        // The line never crosses to the other side of the part.
        const int side = std::visit(
            [&]<class Shape>(const Shape& object) {
                const Vector at = vector(ray_.origin);
                if constexpr (core::kind_of<Shape> == core::Kind::plane)
                    return inner(vector(object.normal), at - vector(object.point)).sign();
                else if constexpr (core::kind_of<Shape> == core::Kind::quadric)
                    return side_of_quadric(object, Exact(0));
                else
                    return 1;
            },
            shape);
        part.at_first = side < 0;
        part.is_flat_on_it = side == 0;
        if (touches && side == 0) part.at_first = is_inside_beside(shape);
    }

    int side_of_quadric(const core::QuadricOf<double>& q, const Exact& t) const {
        const Vector p = vector(ray_.origin) + t * vector(ray_.direction) - vector(q.center);
        const Exact two(2);
        const Exact value =
            Exact(q.xx) * p.x * p.x + Exact(q.yy) * p.y * p.y + Exact(q.zz) * p.z * p.z +
            two * (Exact(q.xy) * p.x * p.y + Exact(q.xz) * p.x * p.z + Exact(q.yz) * p.y * p.z +
                   Exact(q.x) * p.x + Exact(q.y) * p.y + Exact(q.z) * p.z) +
            Exact(q.one);
        return value.sign();
    }
    /// Returns whether the rest of the line is inside of a quadric that it touches at the origin.
    bool is_inside_beside(const tests::AnyShapeInDouble& shape) const {
        return std::visit(
            [&]<class Shape>(const Shape& object) {
                if constexpr (core::kind_of<Shape> == core::Kind::quadric)
                    return side_of_quadric(object, Exact(1)) < 0;
                else
                    return false;
            },
            shape);
    }

    bool value(std::size_t index, bool behind) const {
        const Part& part = parts_[index];
        if (part.op == Op::part) return behind ? part.behind : part.before;
        for (std::size_t i = 0; i < part.operands.size(); ++i) {
            const bool of_child = value(part.operands[i], behind);
            if (part.op == Op::unite) {
                if (of_child) return true;
            } else if (of_child == (part.op == Op::subtract && i != 0)) {
                return false;
            }
        }
        return part.op != Op::unite;
    }
    /// Returns the first part that changes to a value when the expression does.
    std::size_t changed(std::size_t index, bool to) const {
        const Part& part = parts_[index];
        if (part.op == Op::part) return index;
        for (std::size_t i = 0; i < part.operands.size(); ++i) {
            const bool own = to != (part.op == Op::subtract && i != 0);
            const std::size_t child = part.operands[i];
            if (value(child, true) == own && value(child, false) != own) return changed(child, own);
        }
        return index;
    }

    core::Ray<double> ray_;
    std::vector<Part> parts_;
};

} // namespace raylane::oracle
