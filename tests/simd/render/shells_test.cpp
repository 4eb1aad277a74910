#include "core/scene/camera_rays.hpp"
#include "simd/isa/isa.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <cmath>
#include <string>

/// A sphere of radius 1 in one of 1 + 4e-5, near the origin and far away: images have no wrong
/// pixel. Renderers that move their rays off a surface by an epsilon leak light between the two
/// (mitsuba3 #219 and #1871).
using namespace raylane;
using namespace little_scene;

namespace {

constexpr float radius = 1.0F, outer_radius = 1.0F + 4e-5F;
const Vec3f centers[] = {{0, 0, 0}, {100, -70, 30}, {4096, 5000, -3000}, {1e6F, -9e5F, 4e5F}};

Builder looking_at(const Vec3f& center, const Vec3f& from) {
    Builder builder;
    builder.settings.width = builder.settings.height = 96;
    builder.camera.from = center + from;
    builder.camera.at = center;
    builder.background = {0, 0, 1};
    return builder;
}

Film image(const Scene& scene, simd::Engine engine, simd::Isa isa = simd::best_isa()) {
    return simd::render(scene, scene.settings(), {.engine = engine, .isa = isa}).film;
}

/// Calls visit(film) with the image of each instruction set, and with the reference's.
template <class Visit>
void for_each_image(const Scene& scene, const Visit& visit) {
    for (const simd::Isa isa : simd::available_isas()) {
        CAPTURE(std::string(simd::name_of(isa)));
        visit(image(scene, simd::Engine::vector, isa));
    }
    visit(image(scene, simd::Engine::reference));
}

long count_not(const Film& film, const Color& color) {
    return std::count_if(film.pixels().begin(), film.pixels().end(),
                         [&](const Color& pixel) { return pixel != color; });
}

} // namespace

TEST_CASE("a sphere is seen through a skin of glass without a wrong pixel", "[long]") {
    for (const Vec3f& center : centers) {
        CAPTURE(center.x);
        Builder builder = looking_at(center, {1, 2, 3});
        builder.camera.field_of_view = 36.0F;
        const Sphere ball{center, radius};
        builder.add_shape(ball, luminous({1, 0, 0}));
        builder.add_shape(Sphere{center, outer_radius}, glass(1.0F));
        const Scene scene = builder.finish();
        const CameraRays<double> rays(scene.camera(), scene.settings());
        for_each_image(scene, [&](const Film& film) {
            long seen = 0, wrong = 0;
            for (int y = 0; y < film.height(); ++y)
                for (int x = 0; x < film.width(); ++x) {
                    const bool hit = oracle::first_hit(ball, rays.ray(x, y, 0)).has_value();
                    seen += hit ? 1 : 0;
                    wrong += film.at(x, y) != (hit ? Color(1, 0, 0) : Color(0, 0, 1)) ? 1 : 0;
                }
            CHECK(wrong == 0);
            CHECK(seen > 1000);
        });
    }
}

TEST_CASE("no light leaves through the gap between two spheres", "[long]") {
    for (const Vec3f& center : centers) {
        CAPTURE(center.x);
        Builder builder = looking_at(center, {0.5F, 0.25F, 0});
        builder.camera.field_of_view = 170.0F;
        builder.add_shape(Sphere{center, radius}, glass(1.0F));
        builder.add_shape(Sphere{center, outer_radius}, luminous({0, 1, 0}));
        for_each_image(builder.finish(), [](const Film& film) {
            CHECK(count_not(film, {0, 1, 0}) == 0);
        });
    }
}

// Every path goes out through the glass, is reflected, comes in, crosses the sphere and goes out
// again. To a depth of 3 n + 1, it meets n + 1 mirrors.
TEST_CASE("no light is lost between a mirror and the glass right in front of it", "[long]") {
    for (const Vec3f& center : centers) {
        CAPTURE(center.x);
        Builder builder = looking_at(center, {0.5F, 0.25F, 0});
        builder.camera.field_of_view = 170.0F;
        builder.settings.max_depth = 31;
        Material shine = mirror();
        shine.ambient = 1.0F;
        shine.pattern.colors[0] = {0, 1, 0};
        builder.add_shape(Sphere{center, radius}, glass(1.0F));
        builder.add_shape(Sphere{center, outer_radius}, shine);
        for_each_image(builder.finish(), [](const Film& film) {
            CHECK(count_not(film, {0, 11, 0}) == 0);
        });
    }
}

TEST_CASE("a mirror ball in a skin of refracting glass equals the reference's", "[long]") {
    for (const Vec3f& center : centers) {
        CAPTURE(center.x);
        Builder builder = looking_at(center, {1, 2, 3});
        builder.camera.field_of_view = 36.0F;
        Material shine = mirror(0.75F);
        shine.diffuse = 0.5F;
        builder.add_shape(Sphere{center, radius}, shine);
        builder.add_shape(Sphere{center, outer_radius}, glass(1.5F, Reflection::dielectric));
        builder.add_shape(Sphere{center + Vec3f(3, 0, -1), 1.0F}, luminous({1, 1, 0}));
        const Scene scene = builder.finish({.position = center + Vec3f(2, 8, 5)});
        const Film expected = image(scene, simd::Engine::reference);
        for_each_image(scene, [&](const Film& film) {
            long wrong = 0;
            for (std::size_t i = 0; i < film.pixels().size(); ++i)
                for (int channel = 0; channel < 3; ++channel) {
                    const float a = film.pixels()[i][channel], b = expected.pixels()[i][channel];
                    wrong += !(std::abs(a - b) <= 1e-5F * (1.0F + std::abs(b))) ? 1 : 0;
                }
            CHECK(wrong == 0);
        });
    }
}
