#include "core/hierarchy/hierarchy.hpp"
#include "simd/threads/threads.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

#include <atomic>
#include <cstring>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

namespace {

/// Enough shapes for several strips of items and several parts of the tree. Many occur twice, and
/// one occurs more often than a part has items.
struct ManyShapes {
    ShapeLists lists;
    ShapeId shape_count = 0, bounded = 0;

    explicit ManyShapes(bool mixed) {
        constexpr int spheres = 90'000, twice = 20'000, same = 40'000, others = 9'000;
        Random random(7);
        add<Sphere>(spheres, random);
        auto& all_spheres = std::get<ShapeList<Sphere>>(lists);
        for (std::size_t i = 0; i < twice; ++i)
            add(Sphere(all_spheres[3 * i].shape));
        for (int i = 0; i < same; ++i)
            add(Sphere(all_spheres[17].shape));
        if (!mixed) return;
        for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            if (kind_of<Shape> != Kind::sphere)
                add<Shape>(tests::is_bounded<Shape> ? others : 3, random);
        });
    }

  private:
    template <class Shape>
    void add(const Shape& shape) {
        std::get<ShapeList<Shape>>(lists).add(shape, shape_count++);
        bounded += tests::is_bounded<Shape> ? 1 : 0;
    }
    template <class Shape>
    void add(int count, Random& random) {
        for (int i = 0; i < count; ++i)
            add(ray_sets::Target<Shape>::make(random, false));
    }
};

template <class T>
bool same_bits(const BigArray<T>& a, const BigArray<T>& b) {
    if (a.size() != b.size()) return false;
    return a.empty() || std::memcmp(a.data(), b.data(), a.bytes()) == 0;
}

MaterialIndices of_one_material(std::size_t count) {
    MaterialIndices indices;
    for (std::size_t i = 0; i < count; ++i)
        indices.push_back(0);
    return indices;
}

/// Counts the shapes that the builder reports as placed.
struct Told : simd::ParallelWorkers {
    using ParallelWorkers::ParallelWorkers;
    void placed(std::size_t count, std::size_t total) override {
        shapes += count;
        total_shapes = total;
    }
    std::atomic<std::size_t> shapes = 0, total_shapes = 0;
};

} // namespace

TEST_CASE("the hierarchy is the same to the bit on any number of threads", "[native]") {
    for (const int node_width : {8, 16}) {
        const bool mixed = node_width == 8;
        const ManyShapes many(mixed);
        const ShapeLists& lists = many.lists;
        Workers alone(node_width);
        Tables tables;
        const MaterialIndices one_material = of_one_material(many.shape_count);
        const Duplicates duplicates(lists, one_material, {});
        const Hierarchy hierarchy = build_hierarchy(lists, duplicates, alone, tables);
        CHECK(hierarchy.nodes.size() > 400);
        for (const int threads : {1, 2, 3, 8}) {
            CAPTURE(mixed, threads);
            Told workers(threads, node_width);
            Tables others;
            const Hierarchy other = build_hierarchy(lists, duplicates, workers, others);
            CHECK(same_bits(hierarchy.nodes, other.nodes));
            for_each_table(tables, [&]<class Shape>(const Table<Shape>& table) {
                CHECK(
                    same_bits(table.plain_blocks(), std::get<Table<Shape>>(others).plain_blocks()));
            });
            CHECK(workers.total_shapes == many.bounded);
            CHECK(workers.shapes == workers.total_shapes);
        }
    }
}

TEST_CASE("an exception in a worker propagates out of the build") {
    struct Failing : simd::ParallelWorkers {
        using ParallelWorkers::ParallelWorkers;
        void placed(std::size_t, std::size_t) override { throw std::bad_alloc(); }
    };
    Failing workers(3);
    Tables tables;
    const ManyShapes many(false);
    const MaterialIndices one_material = of_one_material(many.shape_count);
    CHECK_THROWS_AS(build_hierarchy(many.lists, {many.lists, one_material, {}}, workers, tables),
                    std::bad_alloc);
}
