#include "tests/simd/render/image.hpp"
#include "tests/support/little_scene.hpp"

using namespace raylane;
using namespace little_scene;

TEST_CASE("Phong's highlight is a power of the cosine to the reflected ray") {
    Builder builder;
    Material material = black();
    material.specular = 0.5F;
    material.exponent = 3.0F;
    material.highlight = Highlight::phong;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, material);
    builder.settings.width = builder.settings.height = 16;
    builder.camera.from = {0, 3, 4};
    const Scene scene = builder.finish(
        {.kind = LightKind::directional, .direction = {0, -1, 0}, .color = Color(1)});
    // The ray (0.6, -0.8) is reflected to (0.6, 0.8), whose cosine to the light is 0.8.
    CHECK(gray_along(scene, {-0.6, 0.8, 0}, {0.6, -0.8, 0}) == Approx(0.5 * 0.512).epsilon(1e-12));
    tests::check_engines_agree(scene);
}
