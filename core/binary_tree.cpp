#include "core/binary_tree.hpp"

#include "core/shape_table.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace raylane::core {

namespace {

/// Beyond this many items, splits are sought among bins; up to it, between any two neighbours. That
/// lets the leaves fill up, because the cost counts blocks.
constexpr std::size_t sweep_limit = 128;
constexpr int bin_count = 32;

using KindCounts = std::array<std::uint32_t, kind_count>;

struct Group {
    Bounds bounds;
    KindCounts counts{};

    void include(const Item& item) {
        bounds.include(item.bounds);
        ++counts[static_cast<std::size_t>(item.kind)];
    }
    void include(const Group& other) {
        bounds.include(other.bounds);
        for (int kind = 0; kind < kind_count; ++kind)
            counts[kind] += other.counts[kind];
    }
    /// Expected work: the chance to be hit (by surface area) times the blocks of 16 to be tested
    /// then.
    double cost() const {
        std::uint32_t blocks = 0;
        for (const std::uint32_t count : counts)
            blocks += (count + block_size - 1) / block_size;
        return bounds.half_area() * blocks;
    }
};

float doubled_center(const Item& item, int axis) {
    return item.bounds.lower[axis] + item.bounds.upper[axis];
}

/// By centre; by position where centres are equal, so that the order is total.
struct CenterLess {
    int axis;
    bool operator()(const Item& a, const Item& b) const {
        const float center_a = doubled_center(a, axis), center_b = doubled_center(b, axis);
        if (center_a != center_b) return center_a < center_b;
        return a.kind != b.kind ? a.kind < b.kind : a.position < b.position;
    }
};

struct Builder {
    std::vector<Item>& items;
    std::vector<BinaryNode> nodes;

    std::span<Item> range(std::size_t first, std::size_t last) {
        return std::span(items).subspan(first, last - first);
    }

    void leaf(std::size_t node, std::size_t first, std::size_t last) {
        nodes[node].first = static_cast<std::uint32_t>(first);
        nodes[node].count = static_cast<std::uint16_t>(last - first);
    }

    void build(std::size_t node, std::size_t first, std::size_t last) {
        Group group;
        for (const Item& item : range(first, last))
            group.include(item);
        nodes[node].bounds = group.bounds;

        const bool one_kind =
            std::count(group.counts.begin(), group.counts.end(), 0U) == kind_count - 1;
        if (one_kind && last - first <= block_size) return leaf(node, first, last);
        std::size_t middle = first;
        if (!one_kind && last - first <= block_size)
            middle = split_by_kind(first, last);
        else
            middle = last - first <= sweep_limit ? split_by_sweep(first, last)
                                                 : split_by_bins(first, last);

        const std::size_t left = nodes.size();
        nodes[node].first = static_cast<std::uint32_t>(left);
        nodes[node].count = 0;
        nodes.resize(left + 2);
        build(left, first, middle);
        build(left + 1, middle, last);
    }

    /// The first kind to the left. Few items of several kinds: where they are matters less than
    /// full blocks.
    std::size_t split_by_kind(std::size_t first, std::size_t last) {
        const auto part = range(first, last);
        const Kind kind =
            std::min_element(part.begin(), part.end(), [](const Item& a, const Item& b) {
                return a.kind < b.kind;
            })->kind;
        const auto right = std::stable_partition(
            part.begin(), part.end(), [&](const Item& item) { return item.kind == kind; });
        return first + static_cast<std::size_t>(right - part.begin());
    }

    std::size_t split_by_sweep(std::size_t first, std::size_t last) {
        const auto part = range(first, last);
        double best_cost = std::numeric_limits<double>::infinity();
        int best_axis = 0;
        std::size_t best_left = part.size() / 2;
        std::array<double, sweep_limit> right_cost;
        for (int axis = 0; axis < 3; ++axis) {
            std::sort(part.begin(), part.end(), CenterLess{axis});
            Group right;
            for (std::size_t i = part.size() - 1; i > 0; --i) {
                right.include(part[i]);
                right_cost[i] = right.cost();
            }
            Group left;
            for (std::size_t i = 1; i < part.size(); ++i) {
                left.include(part[i - 1]);
                const double cost = left.cost() + right_cost[i];
                if (cost < best_cost) {
                    best_cost = cost;
                    best_axis = axis;
                    best_left = i;
                }
            }
        }
        std::sort(part.begin(), part.end(), CenterLess{best_axis});
        return first + best_left;
    }

    std::size_t split_by_bins(std::size_t first, std::size_t last) {
        const auto part = range(first, last);
        Bounds centers; // doubled
        for (const Item& item : part) {
            const Vec3f center = item.bounds.lower + item.bounds.upper;
            centers.include({center, center});
        }
        const Vec3d extent = convert<double>(centers.upper) - convert<double>(centers.lower);
        const auto bin_of = [&](const Item& item, int axis) {
            const double offset = static_cast<double>(doubled_center(item, axis)) -
                                  static_cast<double>(centers.lower[axis]);
            return std::min(bin_count - 1, static_cast<int>(offset * (bin_count / extent[axis])));
        };

        double best_cost = std::numeric_limits<double>::infinity();
        int best_axis = -1, best_bin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(extent[axis] > 0.0)) continue;
            std::array<Group, bin_count> bins;
            for (const Item& item : part)
                bins[bin_of(item, axis)].include(item);
            std::array<double, bin_count> right_cost{};
            Group right;
            for (int bin = bin_count - 1; bin > 0; --bin) {
                right.include(bins[bin]);
                right_cost[bin] = right.cost();
            }
            Group left;
            for (int bin = 1; bin < bin_count; ++bin) {
                left.include(bins[bin - 1]);
                const double cost = left.cost() + right_cost[bin];
                if (cost < best_cost) {
                    best_cost = cost;
                    best_axis = axis;
                    best_bin = bin;
                }
            }
        }
        if (best_axis < 0)
            return first + part.size() / 2; // all centres are equal: any half is as good
        const auto middle = std::partition(part.begin(), part.end(), [&](const Item& item) {
            return bin_of(item, best_axis) < best_bin;
        });
        return first + static_cast<std::size_t>(middle - part.begin());
    }
};

} // namespace

std::vector<BinaryNode> build_binary_tree(std::vector<Item>& items) {
    Builder builder{items, {}};
    builder.nodes.resize(1);
    builder.build(0, 0, items.size());
    return std::move(builder.nodes);
}

} // namespace raylane::core
