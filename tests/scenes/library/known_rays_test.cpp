#include "tests/catch.hpp"
#include "tests/scenes/library/exam.hpp"

#include <vector>

/// Rays that were once answered wrongly, and those around them. The numbers are the whole case: one
/// bit off, and it is another.
using namespace raylane;
using namespace raylane::tests;
using core::Vec3d;
using core::Vec3f;
using ray_sets::rounded;

namespace {

using Ray = core::Ray<float>;
using Shapes = std::vector<AnyShape>;

/// The oracle agrees with all answers, whatever the limits and whoever is asked. Returns the hits.
long check(const Shapes& shapes, std::span<const Ray> rays, double least_hits = 0.25) {
    Tally tally;
    Exam(shapes).ask(rays, Limits::at_crossings, Ways::all, tally);
    INFO(tally.report());
    CHECK(tally.wrong() == 0);
    CHECK(static_cast<double>(tally.hits) >= least_hits * static_cast<double>(tally.rays));
    return tally.hits;
}

/// What one ray hits, once the oracle agrees.
struct Answer {
    float t;
    ShapeId shape;
    bool entering;
    Vec3f normal;
    bool occluded;
};
Answer answer(const Shapes& shapes, const Ray& ray, float t_min = 0.0F, float t_max = infinity) {
    check(shapes, std::span(&ray, 1));
    Rays rays;
    rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
             {ray.direction.x, ray.direction.y, ray.direction.z});
    rays.t_min = {t_min};
    rays.t_max = {t_max};
    const Tracer tracer(scene_of(shapes));
    const Hits hits = intersect(tracer, rays);
    return {hits.t[0], hits.shape[0], hits.entering[0] != 0,
            Vec3f(hits.nx[0], hits.ny[0], hits.nz[0]), occluded(tracer, rays)[0] != 0};
}

} // namespace

TEST_CASE("a ray in the planes of bounds hits what touches them", "[known]") {
    Shapes row;
    for (int i = 0; i < 30; ++i)
        row.push_back(core::Sphere{{2.0F * static_cast<float>(i), -1, 0}, 1});
    std::vector<Ray> rays;
    for (const float x : {-3.0F, 0.0F, 0.5F, 1e6F})
        for (const Vec3f& way : {Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(1, 0, 0.125F)})
            rays.push_back({{x, 0, 0}, way});
    check(row, rays, 0.1);
    CHECK(answer(row, {{-3, 0, 0}, {1, 0, 0}}).shape == 0);
    CHECK(answer(row, {{0x1p20F, 0, 0}, {-1, 0, 0}}).shape == 29);
    for (AnyShape& sphere : row) // where all that is not in line is smaller still
        sphere = Placing(Vec3f(0.0F), 0x1p-90F)(sphere);
    CHECK(answer(row, {{0, 0, 0}, {1, 0, 0}}).shape == 1);
}

TEST_CASE("from afar, t_max is the limit that it says", "[known]") {
    Shapes row;
    for (int i = 0; i < 30; ++i)
        row.push_back(core::Sphere{{3.0F * static_cast<float>(i), 0, 0}, 1});
    std::vector<Ray> rays;
    ray_sets::Random random(19);
    for (const double distance : {1e3, 1e5, 1e7, 1e10})
        for (int i = 0; i < 30; ++i) {
            const Vec3d to(3.0 * i, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const Vec3f origin = rounded(to + distance * random.direction());
            rays.push_back({origin, rounded(to - core::convert<double>(origin))});
        }
    check(row, rays);
}
