#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <algorithm>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

/// Tables keep one of several identical shapes of one material. Ids do not change.

namespace {

std::vector<ShapeId> ids_in(const Scene& scene) {
    std::vector<ShapeId> ids;
    for_each_table(scene.shapes(), [&](const auto& table) {
        for_each_shape(table, [&](const auto&, ShapeId id) { ids.push_back(id); });
    });
    std::sort(ids.begin(), ids.end());
    return ids;
}

std::vector<ShapeId> first_ones(ShapeId count) {
    std::vector<ShapeId> ids;
    for (ShapeId id = 0; id < count; ++id)
        ids.push_back(id);
    return ids;
}

} // namespace

TEST_CASE("tables keep the first of any number of identical shapes of each kind") {
    for (const int copies : {2, 15, 40, 200, 20'000}) {
        CAPTURE(copies);
        Random random(copies);
        little_scene::Builder builder;
        const MaterialIndex material = builder.add_material({});
        const int of_each = copies > 200 ? 1 : 3;
        std::vector<ShapeId> expected;
        for_each_table(ShapeLists(), [&]<class Shape>(const ShapeList<Shape>&) {
            for (int i = 0; i < of_each; ++i) {
                const Shape shape = ray_sets::Target<Shape>::make(random, false);
                expected.push_back(builder.add(shape, material));
                for (int copy = 1; copy < copies; ++copy)
                    builder.add(shape, material);
            }
        });
        const Scene scene = builder.finish();
        CHECK(ids_in(scene) == expected);
        CHECK(scene.shape_count() == expected.size() * static_cast<std::size_t>(copies));
        CHECK(std::get<Table<Box>>(scene.shapes()).size() ==
              static_cast<std::size_t>(of_each * copies));
    }
}

TEST_CASE("shapes that differ in one bit or in their material are both kept") {
    little_scene::Builder builder;
    const MaterialIndex one = builder.add_material({}), other = builder.add_material({});
    ShapeId count = 0;
    for (const MaterialIndex material : {one, other}) {
        builder.add(Sphere{{0, 0, 0}, 1}, material);
        builder.add(Sphere{{0, 0, 0}, std::nextafter(1.0F, 2.0F)}, material);
        builder.add(Plane{{0, 0, 0}, {0, 0, 1}}, material);
        builder.add(Plane{{0, 0, 0}, {0, 0, 2}}, material);
        // These have the same bounds.
        builder.add(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, material);
        builder.add(Triangle{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, material);
        builder.add(Triangle{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}}, material);
        count += 7;
    }
    CHECK(ids_in(builder.finish()) == first_ones(count));
}

TEST_CASE("a thousand different shapes with the same bounds are all kept") {
    little_scene::Builder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < 1000; ++i) {
        Quadric bowl{};
        bowl.zz = 1;
        bowl.x = static_cast<float>(i);
        bowl.lower = Vec3f(-1);
        bowl.upper = Vec3f(1);
        builder.add(bowl, material);
    }
    CHECK(ids_in(builder.finish()) == first_ones(1000));
}

TEST_CASE("triangles of polygons are never duplicates") {
    little_scene::Builder builder;
    const MaterialIndex material = builder.add_material({});
    const Triangle square[] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                               {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    builder.add_polygon(std::span<const Triangle>(square), material);
    builder.add_polygon(std::span<const Triangle>(square), material);
    builder.add(square[0], material);
    CHECK(ids_in(builder.finish()) == first_ones(5));
}
