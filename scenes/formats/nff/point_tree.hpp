#pragma once

#include "scenes/formats/nff/orientation.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::scenes {

struct Rectangle {
    PlanePoint lower{std::numeric_limits<double>::infinity(),
                     std::numeric_limits<double>::infinity()};
    PlanePoint upper{-std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};

    void include(const PlanePoint& p) { include(Rectangle{p, p}); }
    void include(const Rectangle& other) {
        lower = {std::min(lower.x, other.lower.x), std::min(lower.y, other.lower.y)};
        upper = {std::max(upper.x, other.upper.x), std::max(upper.y, other.upper.y)};
    }

    bool contains(const PlanePoint& p) const {
        return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y;
    }

    bool meets(const Rectangle& other) const {
        return lower.x <= other.upper.x && other.lower.x <= upper.x && lower.y <= other.upper.y &&
               other.lower.y <= upper.y;
    }

    /// Returns true if the rectangle is strictly to the right of the line from a to b.
    bool is_right_of(const PlanePoint& a, const PlanePoint& b) const {
        const PlanePoint leftmost{b.y > a.y ? lower.x : upper.x, b.x > a.x ? upper.y : lower.y};
        return orientation(a, b, leftmost) < 0;
    }
};

/// Finds the marked points in a triangle, among numbered points. A k-d tree whose nodes have the
/// bounds of their marked points.
class PointTree {
  public:
    /// Takes points 0 to points.size() - 1, all unmarked.
    void reset(std::vector<PlanePoint> points) {
        points_ = std::move(points);
        order_.resize(points_.size());
        for (std::uint32_t i = 0; i < order_.size(); ++i)
            order_[i] = i;
        is_marked_.assign(points_.size(), false);
        nodes_.clear();
        leaf_of_.resize(points_.size());
        build(0, static_cast<std::uint32_t>(points_.size()), none);
    }

    void mark(std::uint32_t number, bool marked) {
        if (is_marked_[number] == marked) return;
        is_marked_[number] = marked;
        for (std::uint32_t index = leaf_of_[number]; index != none; index = nodes_[index].parent) {
            Node& node = nodes_[index];
            node.bounds = {};
            if (node.second != none) {
                node.bounds.include(nodes_[index + 1].bounds);
                node.bounds.include(nodes_[node.second].bounds);
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (is_marked_[order_[i]]) node.bounds.include(points_[order_[i]]);
        }
    }

    /// Calls visit(number) for all marked points in the closed triangle, whose corners run
    /// counter-clockwise, and for some others near it, until visit() returns true. Returns whether
    /// it did.
    template <class Visit>
    bool any_in(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                const Visit& visit) const {
        Rectangle bounds;
        for (const PlanePoint& corner : {a, b, c})
            bounds.include(corner);
        stack_.assign(1, 0);
        while (!stack_.empty()) {
            const std::uint32_t index = stack_.back();
            stack_.pop_back();
            const Node& node = nodes_[index];
            if (!node.bounds.meets(bounds) || node.bounds.is_right_of(a, b) ||
                node.bounds.is_right_of(b, c) || node.bounds.is_right_of(c, a))
                continue;
            if (node.second != none) {
                stack_.push_back(index + 1);
                stack_.push_back(node.second);
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (is_marked_[order_[i]] && visit(order_[i])) return true;
        }
        return false;
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    static constexpr std::uint32_t leaf_size = 4;

    struct Node {
        Rectangle bounds;         // of the marked points; empty if none is marked
        std::uint32_t begin, end; // in order_
        std::uint32_t parent;
        std::uint32_t second = none; // second half; the first is the next node
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({{}, begin, end, parent});
        Rectangle bounds;
        for (std::uint32_t i = begin; i < end; ++i)
            bounds.include(points_[order_[i]]);
        if (end - begin <= leaf_size) {
            for (std::uint32_t i = begin; i < end; ++i)
                leaf_of_[order_[i]] = index;
            return index;
        }
        const bool by_x = bounds.upper.x - bounds.lower.x > bounds.upper.y - bounds.lower.y;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                         [&](std::uint32_t i, std::uint32_t j) {
                             const PlanePoint &p = points_[i], &q = points_[j];
                             return by_x ? p.x < q.x : p.y < q.y;
                         });
        build(begin, middle, index);
        const std::uint32_t second = build(middle, end, index);
        nodes_[index].second = second;
        return index;
    }

    std::vector<PlanePoint> points_;
    std::vector<std::uint32_t> order_; // points, leaf by leaf
    std::vector<bool> is_marked_;      // by point
    std::vector<std::uint32_t> leaf_of_;
    std::vector<Node> nodes_;                  // the root first
    mutable std::vector<std::uint32_t> stack_; // of any_in
};

} // namespace raylane::scenes
