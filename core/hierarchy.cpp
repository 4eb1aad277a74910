#include "core/hierarchy.hpp"

#include "core/binary_tree.hpp"

#include <array>
#include <cmath>

namespace raylane::core {

WideNode::WideNode() {
    for (int axis = 0; axis < 3; ++axis)
        for (int slot = 0; slot < block_size; ++slot) {
            lower[axis][slot] = std::numeric_limits<float>::infinity();
            upper[axis][slot] = -std::numeric_limits<float>::infinity();
        }
}

Bounds WideNode::bounds(int slot) const {
    return {{lower[0][slot], lower[1][slot], lower[2][slot]},
            {upper[0][slot], upper[1][slot], upper[2][slot]}};
}

void WideNode::set(int slot, const Bounds& bounds, Child child) {
    for (int axis = 0; axis < 3; ++axis) {
        lower[axis][slot] = bounds.lower[axis];
        upper[axis][slot] = bounds.upper[axis];
    }
    children[slot] = child;
}

namespace {

/// Costs of a visit, relative to each other: 16 boxes take about as long as a block of 16 shapes.
constexpr double node_cost = 1.0;
constexpr double block_cost = 1.0;

/// For one binary subtree: the least expected cost of representing it by at most i + 1 slots of a
/// wide node, and how many of these slots then go to the left child (0: the subtree takes one slot,
/// or no more than i).
struct Plan {
    std::array<float, block_size> cost;
    std::array<std::uint8_t, block_size> left_slots;
    std::uint8_t node_left_slots; ///< of all 16, if the subtree becomes a wide node of its own
};

std::vector<Plan> plan_collapse(const std::vector<BinaryNode>& tree) {
    std::vector<Plan> plans(tree.size());
    for (std::size_t n = tree.size(); n-- > 0;) { // children before parents
        const BinaryNode& node = tree[n];
        Plan& plan = plans[n];
        const double area = node.bounds.half_area();
        if (node.is_leaf()) {
            plan.cost.fill(static_cast<float>(area * block_cost));
            plan.left_slots.fill(0);
            continue;
        }
        const Plan& left = plans[node.first];
        const Plan& right = plans[node.first + 1];
        // By `slots` slots shared out among both children.
        const auto shared = [&](int slots) {
            std::pair<float, std::uint8_t> best{std::numeric_limits<float>::infinity(), 1};
            for (int k = 1; k < slots; ++k) {
                const float cost = left.cost[k - 1] + right.cost[slots - k - 1];
                if (cost < best.first) best = {cost, static_cast<std::uint8_t>(k)};
            }
            return best;
        };
        const auto [inside, all_left] = shared(block_size);
        plan.node_left_slots = all_left;
        plan.cost[0] = inside + static_cast<float>(area * node_cost);
        plan.left_slots[0] = 0;
        for (int slots = 2; slots <= block_size; ++slots) {
            const auto [cost, left_slots] = shared(slots);
            const bool better = cost < plan.cost[slots - 2];
            plan.cost[slots - 1] = better ? cost : plan.cost[slots - 2];
            plan.left_slots[slots - 1] = better ? left_slots : 0;
        }
    }
    return plans;
}

/// The blocks of each kind's table.
template <class AnyTables>
struct BlocksOf;
template <class... Shapes>
struct BlocksOf<std::tuple<Table<Shapes>...>> {
    using type = std::tuple<std::vector<Block<Shapes>>...>;
};

/// Turns the planned tree into wide nodes, and each of its leaves into a block.
struct Emitter {
    const Tables& source;
    const std::vector<Item>& items;
    const std::vector<BinaryNode>& tree;
    const std::vector<Plan>& plans;
    std::vector<WideNode> nodes;
    BlocksOf<Tables>::type blocks;

    Child emit_block(const BinaryNode& leaf) {
        const Kind kind = items[leaf.first].kind;
        return with_table(source, kind, [&]<class Shape>(const Table<Shape>& table) {
            auto& target = std::get<std::vector<Block<Shape>>>(blocks);
            Block<Shape>& block = target.emplace_back();
            for (int lane = 0; lane < leaf.count; ++lane) {
                const std::uint32_t position = items[leaf.first + lane].position;
                const Slot slot{position / block_size,
                                static_cast<std::uint8_t>(position % block_size)};
                block.set(lane, table.get(slot), table.id(slot));
            }
            return Child::block(kind, static_cast<std::uint32_t>(target.size() - 1));
        });
    }

    Child emit_node(std::uint32_t binary) {
        const auto index = static_cast<std::uint32_t>(nodes.size());
        nodes.emplace_back();
        int filled = 0;
        if (tree[binary].is_leaf()) {
            fill(index, filled, binary, 1);
        } else {
            const int left = plans[binary].node_left_slots;
            fill(index, filled, tree[binary].first, left);
            fill(index, filled, tree[binary].first + 1, block_size - left);
        }
        return Child::node(index);
    }

    /// Represents a binary subtree by at most `slots` slots of a wide node.
    void fill(std::uint32_t wide, int& filled, std::uint32_t binary, int slots) {
        const Plan& plan = plans[binary];
        while (slots > 1 && plan.left_slots[slots - 1] == 0)
            --slots;
        if (slots > 1) {
            const int left = plan.left_slots[slots - 1];
            fill(wide, filled, tree[binary].first, left);
            fill(wide, filled, tree[binary].first + 1, slots - left);
            return;
        }
        const int slot = filled++;
        const Child child = tree[binary].is_leaf() ? emit_block(tree[binary]) : emit_node(binary);
        nodes[wide].set(slot, tree[binary].bounds, child);
    }
};

Bounds padded(Bounds bounds, float padding) {
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lower[axis] =
            std::nextafter(bounds.lower[axis] - padding, -std::numeric_limits<float>::max());
        bounds.upper[axis] =
            std::nextafter(bounds.upper[axis] + padding, std::numeric_limits<float>::max());
    }
    return bounds;
}

std::vector<Item> bounded_items(const Tables& shapes, float padding) {
    std::vector<Item> items;
    std::size_t count = 0;
    for_each_table(shapes, [&]<class Shape>(const Table<Shape>& table) {
        if constexpr (kind_of<Shape> != Kind::plane) count += table.size();
    });
    items.reserve(count);
    for_each_table(shapes, [&]<class Shape>(const Table<Shape>& table) {
        if constexpr (kind_of<Shape> != Kind::plane) {
            for (std::uint32_t position = 0; position < table.size(); ++position) {
                const Slot slot{position / block_size,
                                static_cast<std::uint8_t>(position % block_size)};
                items.push_back(
                    {padded(bounds_of(table.get(slot)), padding), position, kind_of<Shape>});
            }
        }
    });
    return items;
}

} // namespace

Hierarchy build_hierarchy(Tables& shapes, float padding) {
    Hierarchy hierarchy;
    std::vector<Item> items = bounded_items(shapes, padding);
    if (items.empty()) return hierarchy;
    const std::vector<BinaryNode> tree = build_binary_tree(items);
    const std::vector<Plan> plans = plan_collapse(tree);

    Emitter emitter{shapes, items, tree, plans, {}, {}};
    emitter.emit_node(0);
    hierarchy.nodes = std::move(emitter.nodes);
    hierarchy.bounds = tree.front().bounds;
    for_each_table(shapes, [&]<class Shape>(Table<Shape>& table) {
        if constexpr (kind_of<Shape> != Kind::plane)
            table.rearrange(std::move(std::get<std::vector<Block<Shape>>>(emitter.blocks)));
    });
    return hierarchy;
}

} // namespace raylane::core
