#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

/// A surface that a scene holds several times is one surface: rays that start on it do not meet its
/// copies, visible or not.
using namespace raylane;
using namespace little_scene;

namespace {

Material seen_from(Visible side, const Color& color) {
    Material material = luminous(color);
    material.ambient = 0.1F;
    material.diffuse = 0.8F;
    material.visible = side;
    return material;
}

const Material red = seen_from(Visible::both, {0.8F, 0.1F, 0.1F});

Builder lit_from_above() {
    Builder builder;
    builder.settings.width = builder.settings.height = 64;
    builder.camera.from = {1, 3, 6};
    builder.camera.field_of_view = 30.0F;
    builder.background = {0.5F, 0.6F, 0.9F};
    builder.add_light({.position = {2, 9, 13}});
    return builder;
}

std::vector<Color> image_of(const Scene& scene, simd::Engine engine) {
    return simd::render(scene, scene.settings(), {.engine = engine}).film.pixels();
}

/// Compares a scene of one shape with a scene that has copies of the shape as well.
template <class Shape>
void check(const Shape& shape, const Material& own, const std::vector<Material>& twins) {
    Builder alone = lit_from_above(), together = lit_from_above();
    alone.add_shape(shape, own);
    together.add_shape(shape, own);
    for (const Material& twin : twins)
        together.add_shape(shape, twin);
    const Scene one = std::move(alone).build(), all = std::move(together).build();
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
        CAPTURE(name_of(kind_of<Shape>), twins.size(), engine == simd::Engine::vector);
        CHECK(image_of(all, engine) == image_of(one, engine));
    }
}

const Disc disc{{0, 0, 0}, {0.3F, 1, 0.2F}, 1.5F};
const Sphere ball{{0, 0, 0}, 1.3F};
const Box box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
const CappedCylinder can{{0, -1, 0}, {0, 2, 0}, 1};

} // namespace

TEST_CASE("a sheet of two colours casts no shadow on itself") {
    const Material outside = seen_from(Visible::outside, {0.8F, 0.1F, 0.1F});
    const Material inside = seen_from(Visible::inside, {0.1F, 0.1F, 0.8F});
    check(disc, outside, {inside});
    check(ball, outside, {inside});
    check(box, outside, {inside});
    check(box, red, {inside});
}

TEST_CASE("a shape that a scene holds up to four times casts no shadow on itself") {
    for (const std::size_t times : {2, 3, 4}) {
        const std::vector<Material> twins(times - 1, red);
        check(disc, red, twins);
        check(ball, red, twins);
        check(box, red, twins);
        check(can, red, twins);
    }
}

TEST_CASE("the nearer of two surfaces is seen if doubles cannot separate them") {
    Builder builder;
    builder.settings.width = builder.settings.height = 8;
    builder.camera.projection = Projection::orthographic;
    builder.camera.height = 0.5F;
    builder.camera.from = {1, 10, 0};
    builder.camera.at = {1, 0, 0};
    builder.camera.up = {0, 0, 1};
    // At positive x, the second one lies higher by 1e-15 x.
    builder.add_shape(Plane{{0, 0, 0}, {1e-15F, 1, 0}}, luminous({1, 0, 0}));
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, luminous({0, 1, 0}));
    const Scene scene = builder.finish();
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference})
        for (const Color& pixel : image_of(scene, engine))
            CHECK(pixel == Color(0, 1, 0));
}
