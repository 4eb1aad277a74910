#include "core/hierarchy/hierarchy.hpp"
#include "simd/workers.hpp"
#include "tests/catch.hpp"
#include "tests/shapes/shapes.hpp"

#include <atomic>
#include <cstring>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

namespace {

template <class Shape>
void add_shapes(ShapeLists& lists, int count, Random& random, ShapeId& next) {
    for (int i = 0; i < count; ++i)
        std::get<ShapeList<Shape>>(lists).add(ray_sets::Target<Shape>::make(random, false), next++);
}

/// Enough for several strips of items and several parts of the tree. Many are there twice, and one
/// more often than a part has items.
ShapeLists many_shapes(bool mixed) {
    constexpr int spheres = 90'000, twice = 20'000, same = 40'000, others = 9'000;
    Random random(7);
    ShapeLists lists;
    ShapeId next = 0;
    add_shapes<Sphere>(lists, spheres, random, next);
    auto& all = std::get<ShapeList<Sphere>>(lists);
    for (std::size_t i = 0; i < twice; ++i)
        all.add(Sphere(all[3 * i].shape), next++);
    for (int i = 0; i < same; ++i)
        all.add(Sphere(all[17].shape), next++);
    if (!mixed) return lists;
    add_shapes<Plane>(lists, 3, random, next);
    add_shapes<Disc>(lists, others, random, next);
    add_shapes<Triangle>(lists, others, random, next);
    add_shapes<SmoothTriangle>(lists, others, random, next);
    add_shapes<Box>(lists, others, random, next);
    add_shapes<OpenCylinder>(lists, others, random, next);
    add_shapes<CappedCylinder>(lists, others, random, next);
    add_shapes<OpenCone>(lists, others, random, next);
    add_shapes<CappedCone>(lists, others, random, next);
    add_shapes<Quadric>(lists, others, random, next);
    return lists;
}

template <class T>
bool same_bits(const BigArray<T>& a, const BigArray<T>& b) {
    if (a.size() != b.size()) return false;
    return a.empty() || std::memcmp(a.data(), b.data(), a.bytes()) == 0;
}

/// Counts what it is told.
struct Told : simd::ParallelWorkers {
    using ParallelWorkers::ParallelWorkers;
    void placed(std::size_t count, std::size_t all) override {
        shapes += count;
        of = all;
    }
    std::atomic<std::size_t> shapes = 0, of = 0;
};

} // namespace

TEST_CASE("the hierarchy is the same to the bit on any number of threads", "[native]") {
    for (const bool mixed : {false, true}) {
        const ShapeLists lists = many_shapes(mixed);
        Workers alone;
        Tables tables;
        const std::vector<MaterialIndex> one_material(mixed ? 231'000 : 150'000);
        const Duplicates duplicates(lists, one_material, {});
        const Hierarchy hierarchy = build_hierarchy(lists, duplicates, alone, tables);
        CHECK(hierarchy.nodes.size() > 400);
        for (const int threads : {1, 2, 3, 8}) {
            CAPTURE(mixed, threads);
            Told workers(threads);
            Tables others;
            const Hierarchy other = build_hierarchy(lists, duplicates, workers, others);
            CHECK(same_bits(hierarchy.nodes, other.nodes));
            for_each_table(tables, [&]<class Shape>(const Table<Shape>& table) {
                CHECK(same_bits(table.blocks(), std::get<Table<Shape>>(others).blocks()));
            });
            CHECK(workers.of == one_material.size());
            CHECK(workers.shapes == workers.of);
        }
    }
}

TEST_CASE("what a worker throws comes out of the build") {
    struct Failing : simd::ParallelWorkers {
        using ParallelWorkers::ParallelWorkers;
        void placed(std::size_t, std::size_t) override { throw std::bad_alloc(); }
    };
    Failing workers(3);
    Tables tables;
    const ShapeLists lists = many_shapes(false);
    const std::vector<MaterialIndex> one_material(150'000);
    CHECK_THROWS_AS(build_hierarchy(lists, {lists, one_material, {}}, workers, tables),
                    std::bad_alloc);
}
