#include "core/shapes/invalid_value.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <cmath>

/// Lines along the edges of shapes in an image.
using namespace raylane;
using namespace little_scene;

namespace {

/// A view along -z, 4 units high.
class Drawing : public Builder {
  public:
    explicit Drawing(int pixels = 100) {
        settings.width = settings.height = pixels;
        camera.projection = Projection::orthographic;
        camera.height = 4.0F;
        camera.from = {0, 0, 10};
        settings.outline.width = 3.0F;
        settings.outline.color = {1, 0, 0};
    }
};

core::Film drawn(const Scene& scene, const simd::RenderOptions& options = {}) {
    return simd::render(scene, scene.settings(), options).film;
}

/// Returns how many pixels lines hide. Red is the hidden share of a pixel; everything else is blue.
double hidden(const core::Film& film) {
    double sum = 0.0;
    for (const Color& pixel : film.pixels())
        sum += static_cast<double>(pixel.x);
    return sum;
}

double hidden_around(const core::Film& film, int x, int y) {
    double most = 0.0;
    for (int row = y - 1; row <= y + 1; ++row)
        for (int column = x - 1; column <= x + 1; ++column)
            most = std::max(most, static_cast<double>(film.at(column, row).x));
    return most;
}

const Color blue{0, 0, 1};

} // namespace

TEST_CASE("the line around a ball has its width in pixels at any resolution") {
    for (const int pixels : {50, 100, 333})
        for (const float width : {0.5F, 1.0F, 3.0F, 8.0F}) {
            Drawing drawing(pixels);
            drawing.background = blue;
            drawing.settings.outline.width = width;
            drawing.add_shape(Sphere{{0, 0, 0}, 1}, luminous(blue));
            const Scene scene = drawing.finish();
            const core::Film film = drawn(scene);
            const double radius = pixels / 4.0;
            for (int y = 0; y < pixels; ++y)
                for (int x = 0; x < pixels; ++x) {
                    const double off =
                        std::abs(std::hypot(x + 0.5 - pixels / 2.0, y + 0.5 - pixels / 2.0) -
                                 radius) -
                        static_cast<double>(width) / 2.0;
                    if (off > 1.1) CHECK(film.at(x, y) == blue);
                    if (off < -1.1) CHECK(film.at(x, y) == Color(1, 0, 0));
                }
            const double area = 2.0 * 3.14159265 * radius * static_cast<double>(width);
            CHECK(std::abs(hidden(film) / area - 1.0) < 0.1);
        }
}

TEST_CASE("a steep surface has no lines within it and none at the image's border") {
    for (const bool orthographic : {true, false}) {
        Drawing drawing;
        if (!orthographic) drawing.camera.projection = Projection::perspective;
        drawing.settings.outline.creases = 20.0F;
        drawing.camera.from = {0, 0.02F, 10};
        drawing.camera.at = {0, 0.02F, 9};
        drawing.camera.height = 0.01F;
        drawing.camera.field_of_view = 0.1F;
        drawing.background = blue;
        drawing.add_shape(Plane{{0, 0, 0}, {0, 1, 1e-3F}}, luminous(blue));
        CHECK(hidden(drawn(drawing.finish())) == 0.0);
    }
    Drawing inside; // of a ball, and past a saddle
    inside.camera.projection = Projection::perspective;
    inside.camera.from = {0, 0, 0.9F};
    inside.camera.at = {0, 0.3F, 0};
    inside.settings.outline.creases = 1.0F;
    inside.add_shape(Sphere{{0, 0, 0}, 1}, luminous(blue));
    CHECK(hidden(drawn(inside.finish())) == 0.0);
}

TEST_CASE("lines follow creases and changes of material if these are requested") {
    // Two balls that intersect at x = 0.
    const auto scene_with = [](float creases, bool two_materials) {
        Drawing drawing;
        drawing.settings.outline.creases = creases;
        const MaterialIndex one = drawing.add_material(luminous(blue));
        const MaterialIndex two = two_materials ? drawing.add_material(luminous(blue)) : one;
        drawing.add(Sphere{{-0.7F, 0, 0}, 1}, one);
        drawing.add(Sphere{{0.7F, 0, 0}, 1}, two);
        return drawing.finish();
    };
    CHECK(hidden_around(drawn(scene_with(180.0F, false)), 50, 50) == 0.0);
    CHECK(hidden_around(drawn(scene_with(180.0F, true)), 50, 50) == 0.0);
    CHECK(hidden_around(drawn(scene_with(60.0F, false)), 50, 50) == 1.0); // 88.9 degrees
    CHECK(hidden_around(drawn(scene_with(100.0F, false)), 50, 50) == 0.0);
    CHECK(hidden_around(drawn(scene_with(100.0F, true)), 50, 50) == 1.0);
    // The outline goes around both.
    CHECK(hidden_around(drawn(scene_with(180.0F, false)), 8, 50) == 1.0);
}

TEST_CASE("a shape in front of another or in front of itself has a line") {
    Drawing discs;
    const MaterialIndex paint = discs.add_material(luminous(blue));
    discs.add(Disc{{0, 0, 0}, {0, 0, 1}, 5.0F}, paint);
    discs.add(Disc{{0, 0, 0.1F}, {0, 0, 1}, 1.0F}, paint); // 2.5 pixels in front of it
    CHECK(hidden_around(drawn(discs.finish()), 25, 50) == 1.0);

    Drawing flush; // less than a pixel in front of it
    const MaterialIndex same = flush.add_material(luminous(blue));
    flush.add(Disc{{0, 0, 0}, {0, 0, 1}, 5.0F}, same);
    flush.add(Disc{{0, 0, 0.03F}, {0, 0, 1}, 1.0F}, same);
    CHECK(hidden(drawn(flush.finish())) == 0.0);

    Drawing bowl; // an open cylinder obliquely from above: its near rim is in front of its far side
    bowl.camera.from = {0, 6, 8};
    bowl.camera.at = {0, 0, 0};
    bowl.add(OpenCylinder{{0, -0.5F, 0}, {0, 1, 0}, 1.0F}, bowl.add_material(luminous(blue)));
    const core::Film film = drawn(bowl.finish());
    // The near rim: (0, 0.5, 1), seen at 0.8 * 0.5 - 0.6 units above the middle.
    CHECK(hidden_around(film, 50, 55) == 1.0);
}

TEST_CASE("steep facets have a line between them if they are more than a pixel apart") {
    const auto at_step = [](float depth) {
        Drawing drawing;
        const MaterialIndex paint = drawing.add_material(luminous(blue));
        const auto add_facet = [&](float x, float z) {
            const Vec3f low{x, -3, z}, high{x, 3, z}, right{1, 0, 20};
            drawing.add(Triangle{low, low + right, high}, paint);
            drawing.add(Triangle{high, low + right, high + right}, paint);
        };
        add_facet(-1, -20);
        add_facet(0, -depth);
        return hidden_around(drawn(drawing.finish()), 50, 50);
    };
    CHECK(at_step(0.4F) == 0.0); // 10 pixels deep, but half a pixel across the facets
    CHECK(at_step(2.4F) == 1.0); // three pixels
}

TEST_CASE("lines have the same bits for all tiles and threads and instruction sets") {
    Drawing drawing;
    drawing.camera.projection = Projection::perspective;
    drawing.camera.from = {2, 2, 5};
    drawing.settings.outline.creases = 30.0F;
    drawing.background = blue;
    const MaterialIndex paint = drawing.add_material(luminous(blue));
    drawing.add(Box{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, paint);
    drawing.add(Sphere{{0, 0, 0}, 0.8F}, paint);
    drawing.add(Plane{{0, -1, 0}, {0, 1, 0}}, paint);
    const Scene scene = drawing.finish();
    const core::Film film = drawn(scene);
    CHECK(hidden(film) > 100.0);
    for (const int tile : {8, 24, 64}) {
        CHECK(drawn(scene, {.tile = tile, .threads = 3}).pixels() == film.pixels());
    }
    for (const simd::Isa isa : simd::available_isas())
        CHECK(drawn(scene, {.isa = isa}).pixels() == film.pixels());
}

TEST_CASE("invalid outlines are refused") {
    Drawing drawing;
    drawing.add_shape(Sphere{{0, 0, 0}, 1}, luminous(blue));
    const Scene scene = drawing.finish();
    const auto refused = [&](const core::Outline& outline) {
        Settings settings = scene.settings();
        settings.outline = outline;
        CHECK_THROWS_AS(simd::render(scene, settings, {}), InvalidValue);
    };
    refused({-1.0F, Color(0.0F), 0.0F});
    refused({33.0F, Color(0.0F), 0.0F});
    refused({std::nanf(""), Color(0.0F), 0.0F});
    refused({1.0F, Color(-1.0F), 0.0F});
    refused({1.0F, Color(0.0F), 181.0F});
}
