#include "core/hierarchy/sweep.hpp"

#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

namespace {

constexpr int blocks_for(int count) {
    return (count + block_size - 1) / block_size;
}

float unit_of(const Bounds& bounds) {
    const Vec3f size = bounds.upper - bounds.lower;
    const float unit = 1.0F / std::max({size.x, size.y, size.z});
    return std::isfinite(unit) ? unit : 1.0F;
}

} // namespace

EntryCosts Sweep::build(std::span<Item> items, std::size_t first, std::vector<BinaryNode>& nodes,
                        std::uint32_t root) {
    items_ = items;
    first_ = first;
    nodes_ = &nodes;
    mixed_ = false;
    Box4 centers;
    for (const Item& item : items) {
        centers.include(item.doubled_center());
        mixed_ = mixed_ || item.kind() != items.front().kind();
    }
    const int count = static_cast<int>(items.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < count; ++i)
            order_[axis][i] = static_cast<Index>(i);
        if (mixed_ || count > block_size) sort(axis, centers);
    }
    const EntryCosts costs = grow(0, count, root);
    std::array<std::uint32_t, max_items> positions;
    for (int i = 0; i < count; ++i)
        positions[i] = items[order_[0][i]].position();
    for (int i = 0; i < count; ++i)
        items[i].set_position(positions[i]);
    return costs;
}

/// Sorts by the first twelve bits of the centres' positions between the least and the greatest
/// centre. Items with equal bits keep their order.
void Sweep::sort(int axis, const Box4& centers) {
    constexpr int digit_bits = 6, digits = 1 << digit_bits;
    constexpr float last_key = digits * digits - 1;
    const float lower = centers.lower[axis];
    const float scale = last_key / (centers.upper[axis] - lower);
    if (!std::isfinite(scale)) return;
    const int count = static_cast<int>(items_.size());
    std::array<std::uint16_t, max_items> keys;
    for (int i = 0; i < count; ++i)
        keys[i] = static_cast<std::uint16_t>(
            std::min((items_[i].doubled_center()[axis] - lower) * scale, last_key));
    std::array<Index, max_items> passed;
    for (const int shift : {0, digit_bits}) {
        const auto digit = [&](Index i) { return keys[i] >> shift & (digits - 1); };
        std::array<Index, digits> place{};
        const auto& from = shift == 0 ? order_[axis] : passed;
        auto& to = shift == 0 ? passed : order_[axis];
        for (int i = 0; i < count; ++i)
            ++place[digit(static_cast<Index>(i))];
        int sum = 0;
        for (Index& value : place)
            sum += std::exchange(value, static_cast<Index>(sum));
        for (int i = 0; i < count; ++i)
            to[place[digit(from[i])]++] = from[i];
    }
}

EntryCosts Sweep::leaf(int first, int last, std::uint32_t node) {
    BinaryNode& leaf = (*nodes_)[node];
    leaf.first = static_cast<std::uint32_t>(first_ + first);
    leaf.count = static_cast<std::uint8_t>(last - first);
    leaf.kind = items_[order_[0][first]].kind();
    return leaf_costs(leaf.bounds.half_area());
}

EntryCosts Sweep::grow(int first, int last, std::uint32_t node) {
    const bool several_kinds = mixed_ && has_several_kinds(first, last);
    if (!several_kinds && last - first <= block_size) return leaf(first, last, node);
    const float unit = unit_of((*nodes_)[node].bounds);
    Split split = best_split(first, last, unit);
    if (several_kinds) {
        // If few blocks are left, each of two halves in space may need as many blocks as the whole.
        const Split other = best_split_by_kind(first, last, unit);
        if (!(split.cost < other.cost)) split = other;
    }
    divide(first, split, last);

    const auto left = static_cast<std::uint32_t>(nodes_->size());
    nodes_->push_back({split.left.bounds(), 0, 0, {}, {}});
    nodes_->push_back({split.right.bounds(), 0, 0, {}, {}});
    const EntryCosts left_costs = grow(first, split.middle, left);
    const EntryCosts right_costs = grow(split.middle, last, left + 1);
    BinaryNode& parent = (*nodes_)[node];
    parent.first = left;
    parent.count = 0;
    return collapse(parent.bounds.half_area(), left_costs, right_costs, node_width_, parent.shares);
}

bool Sweep::has_several_kinds(int first, int last) const {
    const Kind kind = items_[order_[0][first]].kind();
    return std::any_of(order_[0].begin() + first, order_[0].begin() + last,
                       [&](Index i) { return items_[i].kind() != kind; });
}

/// Fills blocks_before_[i], the number of blocks for the first i items, and blocks_from_[i], the
/// number for the others.
void Sweep::count_blocks(int axis, int first, int last) {
    const int count = last - first;
    if (!mixed_) {
        for (int i = 0; i <= count; ++i) {
            blocks_before_[i] = static_cast<std::uint8_t>(blocks_for(i));
            blocks_from_[i] = static_cast<std::uint8_t>(blocks_for(count - i));
        }
        return;
    }
    const auto kind_of_item = [&](int i) {
        return static_cast<std::size_t>(items_[order_[axis][first + i]].kind());
    };
    std::array<int, kind_count> counts{};
    int blocks = 0;
    for (int i = 0; i < count; ++i) {
        blocks_before_[i] = static_cast<std::uint8_t>(blocks);
        if (counts[kind_of_item(i)]++ % block_size == 0) ++blocks;
    }
    counts.fill(0);
    blocks = 0;
    for (int i = count; i-- > 0;) {
        if (counts[kind_of_item(i)]++ % block_size == 0) ++blocks;
        blocks_from_[i] = static_cast<std::uint8_t>(blocks);
    }
}

/// Returns the split of the least expected work: the probability of a hit (by surface area) times
/// the number of blocks of 16 to be tested.
Sweep::Split Sweep::best_split(int first, int last, float unit) {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == 0 || mixed_) count_blocks(axis, first, last);
        const Index* const order = &order_[axis][first];
        const int count = last - first;
        Box4 right;
        for (int i = count - 1; i > 0; --i) {
            right.include(items_[order[i]]);
            right_boxes_[i] = right;
        }
        Box4 left;
        for (int i = 1; i < count; ++i) {
            left.include(items_[order[i - 1]]);
            const float cost = left.half_area(unit) * float(blocks_before_[i]) +
                               right_boxes_[i].half_area(unit) * float(blocks_from_[i]);
            if (cost < best.cost) best = {cost, axis, first + i, left, right_boxes_[i], {}};
        }
    }
    return best;
}

/// Returns the best split with one kind to the left and the others to the right, by the same
/// measure.
Sweep::Split Sweep::best_split_by_kind(int first, int last, float unit) {
    std::array<Box4, kind_count> boxes;
    std::array<int, kind_count> counts{};
    for (int i = first; i < last; ++i) {
        const Item& item = items_[order_[0][i]];
        const auto kind = static_cast<std::size_t>(item.kind());
        boxes[kind].include(item);
        ++counts[kind];
    }
    Split best;
    for (std::size_t kind = 0; kind < kind_count; ++kind) {
        if (counts[kind] == 0) continue;
        Box4 others;
        int blocks = 0;
        for (std::size_t other = 0; other < kind_count; ++other) {
            if (other == kind || counts[other] == 0) continue;
            others.include(boxes[other]);
            blocks += blocks_for(counts[other]);
        }
        const float cost = boxes[kind].half_area(unit) * float(blocks_for(counts[kind])) +
                           others.half_area(unit) * float(blocks);
        if (cost < best.cost)
            best = {cost, -1, first + counts[kind], boxes[kind], others, static_cast<Kind>(kind)};
    }
    return best;
}

/// Moves the split's left half to the front, in the order along each axis.
void Sweep::divide(int first, const Split& split, int last) {
    for (int i = first; i < last; ++i) {
        if (split.axis >= 0)
            is_left_[order_[split.axis][i]] = i < split.middle;
        else
            is_left_[order_[0][i]] = items_[order_[0][i]].kind() == split.kind;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == split.axis) continue;
        std::array<Index, max_items> right;
        int lefts = first, rights = 0;
        for (int i = first; i < last; ++i) {
            const Index index = order_[axis][i];
            order_[axis][lefts] = index;
            right[rights] = index;
            lefts += is_left_[index] ? 1 : 0;
            rights += is_left_[index] ? 0 : 1;
        }
        std::copy_n(right.begin(), rights, &order_[axis][lefts]);
    }
}

} // namespace raylane::core
