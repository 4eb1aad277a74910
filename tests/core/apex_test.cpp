#include "core/reference/search.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using namespace raylane::core;

/// Rays through the apex of a cone. There, a ray inside the body would also meet the body's mirror
/// image.

TEMPLATE_TEST_CASE("a ray through a cone's apex either enters or leaves it", "", OpenCone,
                   CappedCone) {
    for (const bool at_top : {true, false}) {
        const Vec3d apex(0, 0, at_top ? 2 : 0), to_inside(0, 0, at_top ? -1 : 1);
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        builder.add(TestType{{0, 0, 0}, {0, 0, 2}, at_top ? 1.0F : 0.0F, at_top ? 0.0F : 1.0F}, 0);
        const Scene scene = std::move(builder).build();
        Searcher<double> searcher(scene, Search::every_shape);
        for (const Vec3d& aside : {Vec3d(0, 0, 0), Vec3d(0.25, 0, 0), Vec3d(0, 0.125, 0)})
            for (const bool from_inside : {true, false}) {
                CAPTURE(at_top, aside.x, aside.y, from_inside);
                const Vec3d inwards = to_inside + aside;
                const Vec3d direction = from_inside ? -inwards : inwards;
                const Hit<double> hit = searcher
                                            .nearest({apex - direction, direction}, {},
                                                     [](const Hit<double>&) { return true; })
                                            .hit;
                CHECK(hit.t == 1.0);
                CHECK(hit.entering == !from_inside);
            }
    }
}
