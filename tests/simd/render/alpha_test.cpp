#include "simd/isa/isa.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/sanitized.hpp"

#include <cmath>
#include <random>

/// Images without their background, to be composited over another.
using namespace raylane;
using namespace little_scene;

namespace {

/// Balls of all opacities.
class Cloud : public Builder {
  public:
    explicit Cloud(bool with_mirrors) {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> place(-2, 2), fraction(0, 1);
        settings.width = 41;
        settings.height = 35;
        settings.grid = 2;
        settings.alpha = true;
        camera = {.from = {1, 2, 7}, .at = {0, 0, 0}};
        for (int i = 0; i < 60; ++i) {
            Material material = luminous({fraction(random), fraction(random), fraction(random)});
            material.opacity = i % 3 == 0 ? 1.0F : fraction(random);
            if (with_mirrors && i % 4 == 1) material.reflectivity = 0.5F;
            if (with_mirrors && i % 5 == 2) material.transmission = 0.5F;
            add_shape(Sphere{{place(random), place(random), place(random)},
                             0.1F + 0.4F * fraction(random)},
                      material);
        }
    }
};

Film drawn(const Scene& scene, const simd::RenderOptions& options = {}) {
    return simd::render(scene, scene.settings(), options).film;
}

simd::RenderOptions by(simd::Engine engine) {
    const simd::RenderOptions options{.engine = engine};
    return options;
}

bool same(const Film& a, const Film& b) {
    return a.pixels() == b.pixels() && a.alphas() == b.alphas();
}

Film without_alpha(const Scene& scene) {
    Settings settings = scene.settings();
    settings.alpha = false;
    return simd::render(scene, settings, {}).film;
}

double largest_alpha_difference(const Film& a, const Film& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.alphas().size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(a.alphas()[i]) -
                                             static_cast<double>(b.alphas()[i])));
    return largest;
}

} // namespace

TEST_CASE("an image with alpha over a background equals the image without alpha") {
    for (const Color& background : {Color(0.0F), Color(1.0F), Color(0.2F, 0.5F, 3.0F)})
        for (const int most : {1, 3, Settings::transparent_limit})
            for (const bool in_fog : {false, true}) {
                Cloud cloud(/*with_mirrors=*/false);
                cloud.settings.max_transparent = most;
                // Everything at infinity is hidden by the fog.
                cloud.background = in_fog ? Color(9.0F) : background;
                if (in_fog)
                    cloud.fog = {
                        .kind = FogKind::linear, .color = background, .start = 4, .end = 12};
                const Scene scene = cloud.finish();
                const Film over = drawn(scene), whole = without_alpha(scene);
                REQUIRE(over.has_alpha());
                CHECK(!whole.has_alpha());
                int partly = 0;
                for (int y = 0; y < over.height(); ++y)
                    for (int x = 0; x < over.width(); ++x) {
                        const float alpha = over.alpha_at(x, y);
                        partly += alpha > 0.0F && alpha < 1.0F ? 1 : 0;
                        const Color laid = over.at(x, y) + (1.0F - alpha) * background;
                        for (int channel = 0; channel < 3; ++channel)
                            CHECK(laid[channel] ==
                                  Approx(whole.at(x, y)[channel]).margin(2e-6).epsilon(1e-6));
                        if (alpha == 0.0F) CHECK(over.at(x, y) == Color(0.0F));
                    }
                CHECK(partly > 300);
            }
}

TEST_CASE("alpha is the share of a pixel that a disc covers times its opacity") {
    Builder builder;
    builder.settings.width = builder.settings.height = 8;
    builder.settings.grid = 64;
    builder.settings.alpha = true;
    builder.camera = {
        .projection = Projection::orthographic, .from = {0, 0, 9}, .at = {0, 0, 0}, .height = 8};
    builder.background = Color(1.0F);
    Material half = luminous(Color(0.5F));
    half.opacity = 0.75F;
    builder.add_shape(Disc{{0, 0, 0}, {0, 0, 1}, 2.5F}, half);
    const Film film = drawn(builder.finish());
    double covered = 0.0;
    for (const float alpha : film.alphas())
        covered += static_cast<double>(alpha);
    CHECK(covered == Approx(0.75 * 3.14159265 * 6.25).epsilon(1e-3));
    CHECK(film.alpha_at(4, 4) == 0.75F);
    CHECK(film.at(4, 4) == Color(0.375F)); // premultiplied
    CHECK(film.alpha_at(0, 0) == 0.0F);
}

TEST_CASE("mirrors and glass show the background and cover it") {
    Builder builder;
    builder.settings.width = builder.settings.height = 40;
    builder.settings.alpha = true;
    builder.background = {0.25F, 0.5F, 1.0F};
    builder.camera = {.from = {0, 0, 9}, .at = {0, 0, 0}, .field_of_view = 30};
    builder.add_shape(Sphere{{-1, 0, 0}, 0.9F}, mirror());
    builder.add_shape(Sphere{{1, 0, 0}, 0.9F}, glass(1.5F));
    const Film film = drawn(builder.finish());
    for (const int x : {12, 27}) {
        CHECK(film.alpha_at(x, 20) == 1.0F);
        CHECK(film.at(x, 20).z == Approx(1.0));
    }
    CHECK(film.alpha_at(20, 2) == 0.0F);
    CHECK(film.at(20, 2) == Color(0.0F));
}

TEST_CASE("a ray through glass behind a pane in the same plane does not go straight on") {
    Builder builder;
    builder.settings.width = builder.settings.height = 4;
    builder.settings.alpha = true;
    builder.background = Color(1.0F);
    builder.camera = {
        .projection = Projection::orthographic, .from = {0, 0, 9}, .at = {0, 0, 0}, .height = 1};
    Material pane = luminous(Color(0.0F));
    pane.opacity = 0.25F;
    builder.add_shape(Disc{{0, 0, 1}, {0, 0, 1}, 5}, pane);
    builder.add_shape(Box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, glass(1.0F));
    const Scene scene = builder.finish();
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
        const Film film = drawn(scene, by(engine));
        CHECK(film.alpha_at(1, 1) == 1.0F);
        CHECK(film.at(1, 1).x == 0.75F);
    }
}

TEST_CASE("a medium around the camera absorbs the background") {
    Builder builder;
    builder.settings.width = builder.settings.height = 3;
    builder.settings.alpha = true;
    builder.background = Color(1.0F);
    builder.camera = {.from = {0, 0, 0}, .at = {0, 0, -1}, .field_of_view = 5};
    Material amber = glass(1.0F);
    amber.absorption = {0.0F, 1.0F, 2.0F};
    amber.opacity = 0.0F;
    builder.add_shape(Sphere{{0, 0, 0}, 1}, amber);
    const Scene scene = builder.finish();
    const double mean = (1.0 + std::exp(-1.0) + std::exp(-2.0)) / 3.0;
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference})
        CHECK(drawn(scene, by(engine)).alpha_at(1, 1) == Approx(1.0 - mean).epsilon(1e-6));
}

TEST_CASE("alpha has the same bits for all tiles and threads and instruction sets") {
    for (const float quality : {0.0F, 36.0F}) {
        Cloud cloud(/*with_mirrors=*/true);
        cloud.settings.quality = quality;
        cloud.background = {0.2F, 0.4F, 0.8F};
        const Scene scene = cloud.finish();
        const Film film = drawn(scene);
        for (const int tile : {8, 24, 64}) {
            CHECK(same(drawn(scene, {.tile = tile, .threads = 3}), film));
        }
        for (const simd::Isa isa : simd::available_isas())
            CHECK(same(drawn(scene, {.isa = isa}), film));
        const simd::RenderOptions options{.crop = Region{7, 3, 30, 33}};
        CHECK(same(drawn(scene, options), film.cropped(*options.crop)));
        if (quality == 0.0F)
            CHECK(largest_alpha_difference(drawn(scene, by(simd::Engine::reference)), film) < 1e-6);
    }
}

TEST_CASE("a quality takes the visible background into account") {
    Builder builder;
    builder.settings.width = builder.settings.height = tests::sanitized ? 24 : 64;
    builder.settings.quality = 36;
    builder.settings.alpha = true;
    builder.camera = {.from = {0, 0, 9}, .at = {0, 0, 0}, .field_of_view = 30};
    std::mt19937 random(8);
    std::uniform_real_distribution<float> place(-2, 2);
    for (int i = 0; i < 40; ++i) // black, so that their colours do not differ
        builder.add_shape(CappedCylinder{{place(random), place(random), place(random)},
                                         {place(random), place(random), place(random)},
                                         0.03F},
                          black());
    builder.background = Color(1.0F);
    const Scene scene = builder.finish();
    // It takes as many samples as black shapes in front of white.
    const Film film = drawn(scene), white = without_alpha(scene);
    int partly = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            CHECK(1.0F - film.alpha_at(x, y) == Approx(white.at(x, y).x).margin(1e-6));
            partly += film.alpha_at(x, y) > 0.0F && film.alpha_at(x, y) < 1.0F ? 1 : 0;
        }
    CHECK(partly > 300 * film.width() * film.height() / (64 * 64));
    CHECK(largest_alpha_difference(drawn(scene, by(simd::Engine::reference)), film) < 1e-6);
}

TEST_CASE("a spectrum has the alpha of its images") {
    Cloud cloud(/*with_mirrors=*/false);
    const Film plain = drawn(cloud.finish());
    Cloud in_colors(/*with_mirrors=*/false);
    in_colors.wavelengths = {450, 540, 600};
    const Scene scene = in_colors.finish();
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference})
        CHECK(largest_alpha_difference(drawn(scene, by(engine)), plain) < 1e-6);
}

TEST_CASE("lines cover the background") {
    Builder builder;
    builder.settings.width = builder.settings.height = 40;
    builder.settings.alpha = true;
    builder.settings.outline = {.width = 6.0F, .color = {1, 0, 0}};
    builder.camera = {
        .projection = Projection::orthographic, .from = {0, 0, 9}, .at = {0, 0, 0}, .height = 4};
    builder.add_shape(Sphere{{0, 0, 0}, 1}, black());
    const Film film = drawn(builder.finish());
    CHECK(film.alpha_at(8, 20) == 1.0F); // beside the ball
    CHECK(film.at(8, 20) == Color(1, 0, 0));
    CHECK(film.alpha_at(3, 20) == 0.0F);
    CHECK(film.alpha_at(20, 20) == 1.0F);
}
