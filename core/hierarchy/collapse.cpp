#include "core/hierarchy/collapse.hpp"

#include <algorithm>
#include <limits>

namespace raylane::core {

namespace {

/// Costs of a visit, relative to each other: 16 boxes take about as long as a block of 16 shapes.
constexpr double node_cost = 1.0;
constexpr double block_cost = 1.0;

struct Share {
    double cost;
    int left;
};

/// By `slots` slots shared out among both children, 2 or more.
Share best_share(int slots, const SlotCosts& left, const SlotCosts& right) {
    Share best{std::numeric_limits<double>::infinity(), 1};
    // Neither gets more than it can use, as far as the other can use the rest.
    const int least = std::clamp(slots - right.useful_slots, 1, left.useful_slots);
    const int most = std::min(slots - 1, left.useful_slots);
    for (int k = least; k <= most; ++k) {
        const double cost = left.of(k) + right.of(slots - k);
        if (cost < best.cost) best = {cost, k};
    }
    return best;
}

} // namespace

SlotCosts leaf_costs(double half_area) {
    SlotCosts costs;
    costs.cost[0] = half_area * block_cost;
    costs.useful_slots = 1;
    return costs;
}

SlotCosts collapse(double half_area, const SlotCosts& left, const SlotCosts& right,
                   SlotShares& shares) {
    SlotCosts costs;
    const Share own = best_share(block_size, left, right);
    shares = {};
    shares.set(1, own.left);
    costs.cost[0] = own.cost + half_area * node_cost;
    costs.useful_slots = std::min(block_size, left.useful_slots + right.useful_slots);
    for (int slots = 2; slots <= costs.useful_slots; ++slots) {
        const Share share = best_share(slots, left, right);
        const bool better = share.cost < costs.cost[slots - 2];
        costs.cost[slots - 1] = better ? share.cost : costs.cost[slots - 2];
        if (better) shares.set(slots, share.left);
    }
    return costs;
}

} // namespace raylane::core
