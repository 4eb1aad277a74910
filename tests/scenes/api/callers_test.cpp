#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <utility>

/// Tests of rules of the library that callers meet by mistake.
using namespace raylane;
using namespace raylane::tests;

TEST_CASE("a tracer that was moved from still answers") {
    Tracer tracer(ball());
    const Tracer moved = std::move(tracer);
    const Rays rays = to_ball();
    CHECK(intersect(moved, rays).t == std::vector<float>{4});
    CHECK(intersect(tracer, rays).t == std::vector<float>{4}); // NOLINT: that it is moved from
    CHECK(tracer.scene().shape_count() == 1);
}

TEST_CASE("equal shapes count once or, if they are kept apart, each") {
    for (const bool merge : {true, false}) {
        SceneBuilder builder;
        builder.merge_duplicates = merge;
        const MaterialIndex m = builder.add_material({});
        for (int i = 0; i < 40; ++i) {
            builder.add(Sphere{{0, 0, 0}, 1}, m);
            builder.add(Plane{{0, 0, -2}, {0, 0, 1}}, m);
        }
        CHECK(builder.merge_duplicates == merge);
        const Tracer tracer(builder.build());
        CHECK(builder.merge_duplicates);
        CrossingRows rows;
        tracer.crossings(to_ball().span(), rows);
        CHECK(rows.t.size() == (merge ? 3U : 120U));
        CHECK(intersect(tracer, to_ball()).shape == std::vector<ShapeId>{0});
    }
}

TEST_CASE("a polygon's triangles must be in one plane") {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    std::vector<Triangle> halves = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                    {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    for (const float off : {0.0F, 1e-5F, -1e-5F}) {
        halves[1].b.z = off;
        CHECK_NOTHROW(builder.add_polygon(halves, m));
    }
    for (const float off : {1e-2F, -1.0F}) {
        halves[1].b.z = off;
        CHECK_THROWS_AS(builder.add_polygon(halves, m), InvalidValue);
    }
    halves[1].b.z = 0;
    for (Triangle& half : halves)
        for (Vec3* const corner : {&half.a, &half.b, &half.c})
            corner->z += 1; // another plane for one
    halves[0] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    CHECK_THROWS_AS(builder.add_polygon(halves, m), InvalidValue);
}
