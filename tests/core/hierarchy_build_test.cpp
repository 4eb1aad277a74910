#include "core/hierarchy/hierarchy.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <map>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

namespace {

struct Built {
    Tables tables;
    Hierarchy hierarchy;
};

std::size_t count_of(const ShapeLists& lists) {
    std::size_t count = 0;
    for_each_table(lists, [&](const auto& list) { count += list.size(); });
    return count;
}

Built build(const ShapeLists& lists, int node_width = 16) {
    Workers alone(node_width);
    Built built;
    // Each shape has its own material, so that none is a duplicate.
    MaterialIndices material_of;
    for (std::size_t id = 0; id < count_of(lists); ++id)
        material_of.push_back(static_cast<MaterialIndex>(id));
    built.hierarchy = build_hierarchy(lists, {lists, material_of, {}}, alone, built.tables);
    return built;
}

template <class Shape>
ShapeId add(ShapeLists& lists, const Shape& shape) {
    const auto next = static_cast<ShapeId>(count_of(lists));
    std::get<ShapeList<Shape>>(lists).add(shape, next);
    return next;
}

ShapeLists all_kinds(int of_each, Random& random, bool lattice) {
    ShapeLists lists;
    for_each_table(lists, [&]<class Shape>(ShapeList<Shape>&) {
        for (int i = 0; i < of_each; ++i)
            add(lists, ray_sets::Target<Shape>::make(random, lattice));
    });
    return lists;
}

/// Returns whether `outer` contains `inner` and does not touch it.
bool surrounds(const Bounds& outer, const Bounds& inner) {
    for (int axis = 0; axis < 3; ++axis)
        if (outer.lower[axis] >= inner.lower[axis] || outer.upper[axis] <= inner.upper[axis])
            return false;
    return true;
}

/// Traverses a hierarchy and counts its faults.
class Audit {
  public:
    explicit Audit(const Built& built) : built_(built) { visit(0, {built.hierarchy.bounds}); }

    std::map<ShapeId, int> found; // number of occurrences of each shape
    int loose = 0;                // shapes that stick out of a node above them
    int wide = 0;                 // entries whose bounds are not one ulp larger than their content
    int gaps = 0;                 // entries or lanes that are filled behind empty ones
    std::size_t blocks = 0, nodes = 0;
    int most = 0; // entries of a node

  private:
    /// Returns the bounds of the content.
    Bounds visit(std::uint32_t index, std::vector<Bounds> above) {
        Bounds bounds;
        ++nodes;
        const WideNode& node = built_.hierarchy.nodes[index];
        bool ended = false;
        for (int entry = 0; entry < block_size; ++entry) {
            const Child child = node.children[entry];
            if (child.empty()) {
                ended = true;
                // No ray may enter an empty entry.
                if (!(node.lower[0][entry] > node.upper[0][entry])) ++gaps;
                continue;
            }
            if (ended) ++gaps;
            most = std::max(most, entry + 1);
            above.push_back(node.bounds(entry));
            const Bounds inside =
                child.is_block()
                    ? with_table(built_.tables, child.kind(),
                                 [&](const auto& table) {
                                     return visit(table.blocks()[child.index()], above);
                                 })
                    : visit(child.index(), above);
            for (int axis = 0; axis < 3; ++axis)
                if (std::nextafter(above.back().lower[axis], HUGE_VALF) != inside.lower[axis] ||
                    std::nextafter(above.back().upper[axis], -HUGE_VALF) != inside.upper[axis])
                    ++wide;
            bounds.include(inside);
            above.pop_back();
        }
        return bounds;
    }

    template <class Shape>
    Bounds visit(const Block<Shape>& block, const std::vector<Bounds>& above) {
        Bounds node_bounds;
        ++blocks;
        if constexpr (tests::is_bounded<Shape>) {
            bool ended = false;
            for (int lane = 0; lane < block_size; ++lane) {
                if (block.ids[lane] == no_shape) {
                    ended = true;
                    if (!std::isnan(block.values[0][lane])) ++gaps;
                    continue;
                }
                if (ended) ++gaps;
                ++found[block.ids[lane]];
                const Bounds bounds = bounds_of(block.get(lane));
                for (const Bounds& outer : above)
                    if (!surrounds(outer, bounds)) ++loose;
                node_bounds.include(bounds);
            }
        }
        return node_bounds;
    }

    const Built& built_;
};

/// Checks that each shape keeps its values, and that each bounded shape occurs once.
Audit check(const ShapeLists& lists, int node_width = 16) {
    const Built built = build(lists, node_width);
    Audit audit(built);
    CHECK(audit.most <= node_width);
    CHECK(audit.loose == 0);
    CHECK(audit.wide == 0);
    CHECK(audit.gaps == 0);
    CHECK(audit.nodes == built.hierarchy.nodes.size());
    std::size_t shapes = 0, blocks = 0;
    int missing = 0;
    for_each_table(lists, [&]<class Shape>(const ShapeList<Shape>& list) {
        const Table<Shape>& table = std::get<Table<Shape>>(built.tables);
        CHECK(table.size() == list.size());
        std::map<ShapeId, Numbers<Shape>> values;
        for_each_shape(table, [&](const auto& shape, ShapeId id) {
            values[id] = numbers_of(to_floats(shape));
        });
        for (std::size_t i = 0; i < list.size(); ++i)
            if (values[list[i].id] != numbers_of(list[i].shape)) ++missing;
        if constexpr (tests::is_bounded<Shape>) {
            blocks += table.blocks().size();
            shapes += list.size();
            for (std::size_t i = 0; i < list.size(); ++i)
                if (audit.found[list[i].id] != 1) ++missing;
        }
    });
    CHECK(missing == 0);
    CHECK(audit.found.size() == shapes);
    CHECK(audit.blocks == blocks);
    return audit;
}

ShapeLists spheres(int count, const auto& make) {
    ShapeLists lists;
    for (int i = 0; i < count; ++i)
        add(lists, make(i));
    return lists;
}

} // namespace

TEST_CASE("each bounded shape is once in the hierarchy and inside of all nodes above it") {
    Random random(31);
    for (const bool lattice : {false, true})
        for (const int of_each : {1, 2, 16, 17, 150, 2000}) {
            const ShapeLists lists = all_kinds(of_each, random, lattice);
            for (const int node_width : {16, 8}) {
                CAPTURE(lattice, of_each, node_width);
                check(lists, node_width);
            }
        }
}

TEST_CASE("a hierarchy of a few shapes in a row has as few blocks as possible") {
    CHECK(build({}).hierarchy.nodes.empty());
    const auto in_a_row = [](int i) { return Sphere{{static_cast<float>(3 * i), 0, 0}, 1}; };
    for (const int count : {1, 2, 15, 16, 17, 31, 128, 129, 257}) {
        CAPTURE(count);
        const Audit audit = check(spheres(count, in_a_row));
        CHECK(audit.nodes <= audit.blocks);
        // Nothing separates neighbours on a line, so that there are as few blocks as possible.
        if (count <= 128) CHECK(audit.blocks == static_cast<std::size_t>((count + 15) / 16));
    }
}

TEST_CASE("blocks are well filled where kinds are mixed") {
    ShapeLists lists;
    constexpr int side = 20;
    for (int i = 0; i < side * side * side; ++i) { // a lattice of balls, sticks and cones
        const Vec3f at(float(i % side), float(i / side % side), float(i / side / side));
        add(lists, Sphere{at, 0.2F});
        add(lists, CappedCylinder{at, {1, 0, 0}, 0.1F});
        add(lists, CappedCone{at, {0, 1, 0}, 0.1F, 0.05F});
    }
    const Audit audit = check(lists);
    CHECK(audit.blocks < std::size_t{side * side * side} * 3 / 7);
    CHECK(audit.nodes < audit.blocks / 6);
}

TEST_CASE("a hierarchy is complete if memory is released while it is built") {
    Random random(34);
    // 12.8 MB of items, of which their positions are 1.6 MB.
    check(spheres(400'000, [&](int) { return Sphere{convert<float>(random.cube(100.0)), 0.5F}; }));
}

TEST_CASE("ids of a list need not be consecutive") {
    ShapeList<Sphere> list;
    std::vector<ShapeId> ids;
    for (ShapeId id = 5; id < 300;
         id += id < 100 ? 1 : 3) { // consecutive at first, then in steps of 3
        list.add(Sphere{{float(id), 0, 0}, 1}, id);
        ids.push_back(id);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            REQUIRE(list[i].id == ids[i]);
            REQUIRE(list[i].shape.center.x == float(ids[i]));
        }
    }
}

TEST_CASE("a hierarchy of shapes in one place is complete") {
    for (const int count : {17, 128, 129, 3000, 70'000}) {
        CAPTURE(count);
        const Audit audit = check(spheres(count, [](int) { return Sphere{{1, 2, 3}, 1}; }));
        CHECK(audit.blocks < static_cast<std::size_t>(count) / 8 + 2);
        // Spheres of many sizes around one centre.
        check(spheres(count, [](int i) { return Sphere{{0, 0, 0}, std::exp2(float(i % 60))}; }));
    }
}

TEST_CASE("a hierarchy of sizes as different as floats can be is complete") {
    Random random(32);
    for (const float scale : {1e-30F, 1e-15F, 1.0F, 1e15F, 1e28F}) {
        CAPTURE(scale);
        const Audit audit = check(spheres(5000, [&](int) {
            return Sphere{scale * convert<float>(random.cube(100.0)), scale};
        }));
        // Blocks are equally full in any unit.
        CHECK(audit.blocks < 5000 / 10);
        CHECK(audit.nodes < audit.blocks / 6);
    }
    const Audit audit = check(spheres(5000, [&](int) {
        const auto size = static_cast<float>(random.log_uniform(1e-30, 1e28));
        return Sphere{size * convert<float>(random.cube(100.0)), size};
    }));
    CHECK(audit.nodes < audit.blocks);
}

TEST_CASE("a hierarchy over flat shapes in one plane has full blocks") {
    Random random(33);
    ShapeLists lists;
    for (int i = 0; i < 3000; ++i) {
        Vec3f a = convert<float>(random.cube(10.0)), b = a, c = a;
        a.z = b.z = c.z = 0.0F;
        b.x += 0.1F;
        c.y += 0.1F;
        add(lists, Triangle{a, b, c});
    }
    const Audit audit = check(lists);
    CHECK(audit.blocks < 3000 / 10);
    CHECK(audit.nodes < audit.blocks / 6);
}
