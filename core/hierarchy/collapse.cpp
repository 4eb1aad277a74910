#include "core/hierarchy/collapse.hpp"

#include <algorithm>
#include <limits>

namespace raylane::core {

namespace {

/// Costs of a visit, relative to each other: a node takes about as long as a block.
constexpr double node_cost = 1.0;
constexpr double block_cost = 1.0;

struct Share {
    double cost;
    int left;
};

/// Returns the best division of `entries`, 2 or more, between both children.
Share best_share(int entries, const EntryCosts& left, const EntryCosts& right) {
    Share best{std::numeric_limits<double>::infinity(), 1};
    // Neither child gets more entries than it can use, provided that the other can use the rest.
    const int least = std::clamp(entries - right.useful_entries, 1, left.useful_entries);
    const int most = std::min(entries - 1, left.useful_entries);
    for (int k = least; k <= most; ++k) {
        const double cost = left.of(k) + right.of(entries - k);
        if (cost < best.cost) best = {cost, k};
    }
    return best;
}

} // namespace

EntryCosts leaf_costs(double half_area) {
    EntryCosts costs;
    costs.cost[0] = half_area * block_cost;
    costs.useful_entries = 1;
    return costs;
}

EntryCosts collapse(double half_area, const EntryCosts& left, const EntryCosts& right,
                    int node_width, EntryShares& shares) {
    EntryCosts costs;
    const Share own = best_share(node_width, left, right);
    shares = {};
    shares.set(1, own.left);
    costs.cost[0] = own.cost + half_area * node_cost;
    costs.useful_entries = std::min(node_width, left.useful_entries + right.useful_entries);
    for (int entries = 2; entries <= costs.useful_entries; ++entries) {
        const Share share = best_share(entries, left, right);
        const bool better = share.cost < costs.cost[entries - 2];
        costs.cost[entries - 1] = better ? share.cost : costs.cost[entries - 2];
        if (better) shares.set(entries, share.left);
    }
    return costs;
}

} // namespace raylane::core
