#include "tests/oracle/first_hit.hpp"
#include "tests/simd/stream/stream_columns.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <string>

/// A stream of rays has the same answers, to the bit, on every instruction set.
using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;
using tests::check_same;
using tests::RayAnswers;
using tests::StreamColumns;

namespace {

void add_limited(const Ray<float>& ray, Random& random, StreamColumns& rays) {
    const bool limited = random.integer(0, 3) == 0;
    rays.add(ray);
    rays.t_min.push_back(limited ? static_cast<float>(random.log_uniform(0.01, 1.0)) : 0.0F);
    rays.t_max.push_back(limited ? static_cast<float>(random.log_uniform(0.1, 10.0)) : 1e30F);
}

/// Adds shapes of one kind, a third of them twice, some visible from one side only, and rays of all
/// sets for each shape.
template <class Shape>
void add_kind(SceneBuilder& builder, bool lattice, Random& random, StreamColumns& rays) {
    const int count = tests::rounds(60, 6);
    for (int i = 0; i < count; ++i) {
        const auto shape = ray_sets::Target<Shape>::make(random, lattice);
        builder.add(shape, static_cast<MaterialIndex>(i % 8 == 0));
        if (i % 3 == 0) builder.add(shape, 0);
        for (const Set set : ray_sets::all_sets)
            for (int k = 0; k < 2; ++k)
                if ((set == Set::lattice) == lattice || set == Set::zeros)
                    add_limited(ray_sets::make_ray(shape, set, random), random, rays);
    }
}

void check(bool lattice) {
    Random random(lattice ? 61 : 60);
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    Material from_outside;
    from_outside.visible = Visible::outside;
    builder.add_material(from_outside);
    StreamColumns rays;
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        add_kind<Shape>(builder, lattice, random, rays);
    });
    const Scene scene = std::move(builder).build();

    const RayAnswers expected(StreamTracer(scene, 1, narrowest_isa()), rays.view());
    const auto nothing = std::count(expected.shape.begin(), expected.shape.end(), no_shape);
    CHECK(2 * static_cast<std::size_t>(nothing) < expected.shape.size());
    for (const Isa isa : available_isas()) {
        CAPTURE(std::string(name_of(isa)), lattice);
        check_same(RayAnswers(StreamTracer(scene, 1, isa), rays.view()), expected);
    }
}

} // namespace

TEST_CASE("every lane of every instruction set answers a ray with the same bits") {
    for (const bool lattice : {false, true})
        check(lattice);
}
