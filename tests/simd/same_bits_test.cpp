#include "simd/stream_tracer.hpp"
#include "tests/catch.hpp"
#include "tests/oracle.hpp"
#include "tests/ray_sets.hpp"
#include "tests/simd/rounds.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

/// A stream of rays has the same answers, to the bit, on every instruction set.
using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;

namespace {

struct Rays {
    std::vector<float> of[6], t_min, t_max;

    void add(const Ray<float>& ray, Random& random) {
        for (int axis = 0; axis < 3; ++axis) {
            of[axis].push_back(ray.origin[axis]);
            of[3 + axis].push_back(ray.direction[axis]);
        }
        const bool limited = random.integer(0, 3) == 0;
        t_min.push_back(limited ? static_cast<float>(random.log_uniform(0.01, 1.0)) : 0.0F);
        t_max.push_back(limited ? static_cast<float>(random.log_uniform(0.1, 10.0)) : 1e30F);
    }
    RayStream<float> view() const {
        return {t_min.size(),
                {of[0].data(), of[1].data(), of[2].data()},
                {of[3].data(), of[4].data(), of[5].data()},
                t_min.data(),
                t_max.data()};
    }
};

struct Answers {
    std::vector<float> t, normal[3];
    std::vector<ShapeId> shape;
    std::vector<std::uint8_t> entering, occluded;

    Answers(const Scene& scene, const RayStream<float>& rays, Isa isa)
        : t(rays.count), shape(rays.count), entering(rays.count), occluded(rays.count) {
        for (std::vector<float>& component : normal)
            component.resize(rays.count);
        const StreamTracer tracer(scene, 1, isa);
        tracer.nearest(rays, {t.data(),
                              {normal[0].data(), normal[1].data(), normal[2].data()},
                              shape.data(),
                              entering.data()});
        tracer.occluded(rays, occluded.data());
    }
};

long differing(const std::vector<float>& a, const std::vector<float>& b) {
    long count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i]) ? 0 : 1;
    return count;
}

/// Adds shapes of one kind, a third of them twice, some visible from one side only, and rays of all
/// sets for each shape.
template <class Shape>
void add_kind(SceneBuilder& builder, bool lattice, Random& random, Rays& rays) {
    const int count = tests::rounds(60, 6);
    for (int i = 0; i < count; ++i) {
        const auto shape = ray_sets::Target<Shape>::make(random, lattice);
        builder.add(shape, static_cast<MaterialIndex>(i % 8 == 0));
        if (i % 3 == 0) builder.add(shape, 0);
        for (const Set set : ray_sets::all_sets)
            for (int k = 0; k < 2; ++k)
                if ((set == Set::lattice) == lattice || set == Set::zeros)
                    rays.add(ray_sets::make_ray(shape, set, random), random);
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
    Rays rays;
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        add_kind<Shape>(builder, lattice, random, rays);
    });
    const Scene scene = std::move(builder).build();

    const Answers expected(scene, rays.view(), narrowest_isa());
    const auto nothing = std::count(expected.shape.begin(), expected.shape.end(), no_shape);
    CHECK(2 * static_cast<std::size_t>(nothing) < expected.shape.size());
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        CAPTURE(std::string(name_of(isa)), lattice);
        const Answers found(scene, rays.view(), isa);
        CHECK(differing(found.t, expected.t) == 0);
        for (int axis = 0; axis < 3; ++axis)
            CHECK(differing(found.normal[axis], expected.normal[axis]) == 0);
        CHECK(found.shape == expected.shape);
        CHECK(found.entering == expected.entering);
        CHECK(found.occluded == expected.occluded);
    }
}

} // namespace

TEST_CASE("every lane of every instruction set answers a ray with the same bits") {
    for (const bool lattice : {false, true})
        check(lattice);
}
