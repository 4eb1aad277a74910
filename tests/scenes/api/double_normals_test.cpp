#include "tests/scenes/api/exam_in_double.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <bit>
#include <cmath>

/// Tests of normals in double. exam_in_double.cpp compares them with the oracle.
using namespace raylane;
using namespace raylane::tests;

namespace {

/// Returns true if a double rounds to a float, or is next to the middle of two floats, where
/// rounding twice may lead to another float than rounding once.
bool rounds_to(double number, float rounded) {
    if (static_cast<float>(number) == rounded) return true;
    const double by = number - static_cast<double>(rounded);
    const float other = std::nextafter(rounded, by > 0 ? 2.0F : -2.0F);
    const double half = 0.5 * (static_cast<double>(other) - static_cast<double>(rounded));
    return std::abs(by - half) <= 0x1p-53 * std::abs(number);
}

/// Traces rays with normals in both precisions. Returns the number of components that differ by
/// more than the rounding to float.
template <class Real>
std::size_t differences(const Tracer& tracer, const BasicRaySpan<Real>& rays) {
    const std::size_t count = rays.origin_x.size();
    Hits hits(count);
    DoubleNormals normals(count);
    HitSpan span = hits.span();
    normals.add_to(span);
    tracer.intersect(rays, span);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float in_float[] = {hits.nx[i], hits.ny[i], hits.nz[i]};
        for (int axis = 0; axis < 3; ++axis)
            wrong += rounds_to(normals[i][axis], in_float[axis]) ? 0 : 1;
        const double length = core::length(normals[i]);
        wrong += std::abs(length - (hits.shape[i] == no_shape ? 0.0 : 1.0)) <= 0x1p-51 ? 0 : 1;
    }
    // The other columns are the same without them, and they are the same without the others.
    Hits alone(count);
    tracer.intersect(rays, alone.span());
    wrong += alone == hits ? 0 : 1;
    std::vector<double> only(count, 9.0);
    tracer.intersect(rays, HitSpan{.normal_double_y = only});
    wrong += only == normals.y ? 0 : 1;
    return wrong;
}

} // namespace

TEST_CASE("normals in double round to the normals in float") {
    for (const bool lattice : {false, true}) {
        const Heap setup = heap(lattice, sanitized ? 4 : 20, 31);
        const Tracer tracer(setup.scene, {.threads = 2});
        CHECK(differences(tracer, setup.rays.span()) == 0);
        for (const std::size_t count : {1, 2, 4, 5, 17})
            CHECK(differences(tracer, setup.rays.part(7, count)) == 0);
        DoubleRays rays;
        for (std::size_t i = 0; i < setup.rays.size(); ++i)
            rays.add(setup.rays.ray(i), 0.0, i % 4 == 0 ? 1.0 : endless);
        CHECK(differences(tracer, rays.span()) == 0);
        // Rays that go on from hits, straight and in other directions.
        rays.t_max.assign(rays.size(), endless);
        FullHits hits(tracer, rays);
        const auto& [x, y, z] = rays.direction;
        CHECK(differences(tracer, onward(rays.span(), hits.span(), x, y, z).span()) == 0);
        CHECK(differences(tracer, onward(rays.span(), hits.span(), y, z, x).span()) == 0);
    }
}

TEST_CASE("normals in double do not depend on threads, tiles or the requested columns") {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    Random random(77);
    for (int i = 0; i < 200; ++i) {
        const core::Vec3f at = core::convert<float>(random.cube(4.0));
        builder.add(Sphere{{at.x, at.y, at.z}, 0.5F}, material);
    }
    const Scene scene = builder.build();
    Rays image; // line by line, so that they are traced in tiles
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 128; ++x)
            image.add({0, 0, 20}, {0.005F * static_cast<float>(x - 64),
                                   0.005F * static_cast<float>(y - 48), -1});
    DoubleNormals one(image.size()), three(image.size());
    HitSpan of_one, of_three;
    one.add_to(of_one);
    three.add_to(of_three);
    Tracer(scene, {.threads = 1}).intersect(image.span(), of_one);
    Tracer(scene, {.threads = 3}).intersect(image.span(), of_three);
    CHECK(one == three);
    CHECK(differences(Tracer(scene), image.span()) == 0);
    Hits alone(1);
    for (std::size_t i = 0; i < image.size(); i += 997) {
        DoubleNormals normal(1);
        HitSpan span = alone.span();
        normal.add_to(span);
        Tracer(scene).intersect(image.part(i, 1), span);
        CHECK(normal[0] == one[i]);
    }
}

TEST_CASE(
    "normals in double of a limited ray in double follow the limits in float if t is a float") {
    const Tracer tracer(ball());
    DoubleRays rays;
    const double third = 1.0 / 3.0; // t is 12, but for its last digits
    rays.add({{0, 0, 5}, {0, 0, -third}}, 0.0, 12.0);
    rays.add({{0, 0, 5}, {0, 0, -third}}, 0.0, std::nextafter(12.0, 0.0));
    std::vector<float> t(2);
    std::vector<double> z(2);
    tracer.intersect(rays.span(), HitSpan{.t = t, .normal_double_z = z});
    CHECK(t == std::vector<float>{12, infinity});
    CHECK(z == std::vector<double>{1, 0});
    std::vector<double> only(2);
    tracer.intersect(rays.span(), HitSpan{.normal_double_z = only});
    std::vector<double> t_double(2);
    tracer.intersect(rays.span(), HitSpan{.t_double = t_double});
    for (std::size_t i = 0; i < 2; ++i)
        CHECK((only[i] == 1.0) == (t_double[i] < 13.0));
}

TEST_CASE("normals in double of other precisions are close to those in float") {
    const Heap setup = heap(false, 10, 41);
    for (const Precision precision :
         {Precision::fast, Precision::robust, Precision::plain_double}) {
        const Tracer tracer(setup.scene, {.precision = precision});
        Hits hits(setup.rays.size());
        DoubleNormals normals(setup.rays.size());
        HitSpan span = hits.span();
        normals.add_to(span);
        tracer.intersect(setup.rays.span(), span);
        std::size_t close = 0, met = 0;
        for (std::size_t i = 0; i < hits.t.size(); ++i) {
            const core::Vec3d in_float(hits.nx[i], hits.ny[i], hits.nz[i]);
            met += hits.shape[i] != no_shape ? 1 : 0;
            close += core::length(normals[i] - in_float) < 1e-3 ? 1 : 0;
        }
        CHECK(met > hits.t.size() / 4);
        CHECK(close > hits.t.size() - hits.t.size() / 50);
    }
}

TEST_CASE("normals in double of unusual rays are those of usual ones") {
    const Tracer tracer(ball());
    DoubleRays rays;
    for (const double scale : {1.0, 0x1p-450, 0x1p500, 0x1p-1040})
        rays.add({{0.25, 0, 5}, {0, 0, -scale}}, 0.0, endless);
    const DoubleAnswers answers(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CHECK(answers.normals[i] == core::Vec3d(0.25, 0, std::sqrt(0.9375)));
        CHECK(answers.counts[i] == 2);
    }
}
