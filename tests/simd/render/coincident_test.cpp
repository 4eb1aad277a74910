#include "simd/wavefront/render.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/random.hpp"

#include <cmath>
#include <vector>

/// Coincident surfaces, which rays pass one by one. Rounding may put each of them before or behind
/// the others, and before them again after the ray has passed it.
using namespace raylane;
using namespace little_scene;

namespace {

/// Checks that all walks end, with every precision and engine. Except in single precisions, both
/// engines must give the same colours.
void check_ends(const Scene& scene) {
    for (const Precision precision : all_precisions) {
        std::vector<Color> by_vectors;
        for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference}) {
            const simd::Rendering rendering = simd::render(
                scene, scene.settings(), {.engine = engine, .precision = precision, .threads = 1});
            long wrong = 0;
            for (const Color& pixel : rendering.film.pixels())
                wrong += std::isfinite(pixel.x) && pixel.x >= 0.0F ? 0 : 1;
            CHECK(wrong == 0);
            if (engine == simd::Engine::vector)
                by_vectors = rendering.film.pixels();
            else if (!is_single(precision))
                CHECK(by_vectors == rendering.film.pixels());
        }
    }
}

/// A light above a floor, and a camera that looks at it, `offset` from the origin.
class Room : public Builder {
  public:
    explicit Room(const Vec3f& offset) : offset_(offset) {
        settings.width = settings.height = 24;
        settings.max_depth = 4;
        camera.from = offset + Vec3f(1, 4, 7);
        camera.at = offset;
        background = {0.5F, 0.5F, 0.5F};
        add_light({.position = offset + Vec3f(2, 9, 3)});
        Material matte = luminous();
        matte.ambient = 0.25F;
        matte.diffuse = 0.75F;
        add_shape(Plane{offset + Vec3f(0, -2, 0), {0, 1, 0}}, matte);
    }

    /// Adds one plane in `count` descriptions.
    void add_sheets(int count, const Material& material) {
        ray_sets::Random random(3);
        const Vec3f normal(0.3F, 1.0F, -0.2F);
        for (int i = 0; i < count; ++i) {
            const Vec3d across = ray_sets::across(convert<double>(normal), random);
            add_shape(Plane{offset_ + convert<float>(Vec3d(random.uniform(0.0, 9.0) * across)),
                            normal * static_cast<float>(random.uniform(0.1, 3.0))},
                      material);
        }
    }

    void add_shells(int count, const Material& material) {
        for (int i = 0; i < count; ++i) {
            add_shape(Sphere{offset_, 1.5F}, material);
            add_shape(Box{offset_ + Vec3f(1, -1, -1), {1.1F, 0, 0.1F}, {0, 1.1F, 0}, {-0.1F, 0, 1}},
                      material);
            add_shape(CappedCylinder{offset_ + Vec3f(-3, -1, 0), {0.3F, 1.7F, 0}, 0.7F}, material);
        }
    }

  private:
    Vec3f offset_;
};

Material seen_from(Visible side) {
    Material material = luminous({0.1F, 0.9F, 0.2F});
    material.visible = side;
    return material;
}

const Vec3f offsets[] = {{0, 0, 0}, {1000, -700, 300}, {1e6F, 3e6F, -2e6F}};

/// Planes near y = 1000 that are closer to each other than doubles are there, but not for rays that
/// start a little above or below. At positive x, they lie one below the other.
class CloseSheets : public Builder {
  public:
    explicit CloseSheets(const Material& material) {
        settings.width = settings.height = 8;
        camera.projection = Projection::orthographic;
        camera.height = 0.25F;
        for (int i = 1; i <= 3; ++i)
            add_shape(Plane{{0, 1000, 0}, {0.5e-14F * static_cast<float>(i), 1, 0}}, material);
    }

    void look(float from, float to) {
        camera.from = {1.25F, from, 0};
        camera.at = {1.25F, to, 0};
        camera.up = {0, 0, 1};
    }
};

} // namespace

TEST_CASE("shadow rays get through coincident surfaces of glass") {
    for (const Vec3f& offset : offsets) {
        Room sheets(offset);
        sheets.add_sheets(5, glass(1.0F));
        check_ends(sheets.finish());
        Room shells(offset);
        shells.add_shells(3, glass(1.25F));
        check_ends(shells.finish());
    }
}

TEST_CASE("rays get through coincident invisible surfaces") {
    for (const Vec3f& offset : offsets)
        for (const Visible side : {Visible::inside, Visible::outside}) {
            Room sheets(offset);
            sheets.add_sheets(5, seen_from(side));
            check_ends(sheets.finish());
            Room shells(offset);
            shells.add_shells(3, seen_from(side));
            check_ends(shells.finish());
        }
}

TEST_CASE("rays get through surfaces that are closer together than doubles") {
    CloseSheets scene(seen_from(Visible::inside));
    scene.look(1001.0F, 1000.0F);
    check_ends(scene.finish());
}

TEST_CASE("light gets through glass surfaces that are closer together than doubles") {
    CloseSheets scene(glass(1.0F));
    Material matte = luminous();
    matte.diffuse = 1.0F;
    scene.add_shape(Plane{{0, 1001, 0}, {0, -1, 0}}, matte);
    scene.look(1000.5F, 1001.0F);
    check_ends(scene.finish({.kind = LightKind::directional, .direction = {0, 1, 0}}));
}
