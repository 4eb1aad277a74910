#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

/// Tests of rules of the library that callers meet by mistake.
using namespace raylane;
using namespace raylane::tests;

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
