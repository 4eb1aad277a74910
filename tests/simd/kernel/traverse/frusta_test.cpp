#include "simd/isa/isa.hpp"
#include "tests/simd/kernel/traverse/traced.hpp"

using namespace raylane;
using namespace raylane::tests;

/// Compares the answers for coherent rays traced in frusta with those for the same rays one by one,
/// and with those of the scalar search.

namespace {

/// Checks rays to one light, which the search in frusta reorders. In each hundred packets of 16
/// rays, `strays` packets have rays from anywhere. The rays of the other packets start near each
/// other. If frusta give up, other traversals take over, which depend on `small`.
void check_light(const Kernels& kernels, bool overlapping, std::size_t strays, bool small) {
    CAPTURE(std::string(kernels.name), overlapping, strays, small);
    Rays rays(3001, overlapping ? 9.0 : 12.0);
    const Traced traced(make_scene(overlapping), rays.padded);
    SceneView view = traced.data.view();
    view.small = small;
    const Vec3d light(20.0, 15.0, 10.0);
    for (std::size_t i = 0; i < rays.count; ++i) {
        if (i / 16 * 37 % 100 >= strays) rays.stay_near(i);
        const Ray<double> ray = rays.get(i);
        const Vec3d way = light - ray.origin;
        rays.aim(i, normalized(way));
        rays.t_limit[i] = static_cast<float>(length(way));
    }
    const Coherence to_light{{20.0F, 15.0F, 10.0F}, true, false, false, false};
    const TraceKernels& trace = Traced::exactly(kernels);
    for (const std::size_t count : {std::size_t{5}, std::size_t{16}, std::size_t{63},
                                    std::size_t{256}, std::size_t{257}, rays.count}) {
        CAPTURE(count);
        const RoundedRays rounded = rays.round(kernels); // overwrites entries after them
        TraceCounters counters{};
        Answers alone(rays.padded), together(rays.padded);
        for (std::size_t i = 0; i < rays.padded; ++i) // blocked rays must be skipped
            alone.state[i] = together.state[i] = i % 7 == 0   ? blocked
                                                 : i % 7 == 1 ? doubtful
                                                              : unblocked;
        const std::vector<std::uint8_t> before = together.state;
        trace.occluded(view, 0, nullptr, count, rounded, {rays.t_limit.data(), alone.state.data()},
                       traced.workspace, counters);
        trace.occluded(view, 0, &to_light, count, rounded,
                       {rays.t_limit.data(), together.state.data()}, traced.workspace, counters);
        int opposed = 0, different = 0, any = 0, lowered = 0;
        for (std::size_t i = 0; i < rays.padded; ++i) {
            any += i < count && (before[i] == blocked || together.state[i] != before[i]) ? 1 : 0;
            lowered +=
                together.state[i] < before[i] || (i >= count && together.state[i] != before[i]);
            different += alone.state[i] == together.state[i] ? 0 : 1;
            opposed += static_cast<int>(std::max(alone.state[i], together.state[i]) == blocked &&
                                        std::min(alone.state[i], together.state[i]) == unblocked);
        }
        CHECK(lowered == 0);
        CHECK(opposed == 0);
        CHECK(different <= static_cast<int>(count) / 50); // possible but uncertain blockers
        if (count != rays.count) continue;
        CHECK((counters.in_frusta > 0) == !overlapping); // not with too many shapes in front
        CHECK(any > static_cast<int>(count) / 4);        // including rays that were blocked before
        CHECK(any < static_cast<int>(count));
    }
}

/// Checks that coherent rays see the same in a frustum as one by one.
void check_frustum(const Kernels& kernels, const Coherence& coherence, int planes, int node_width) {
    CAPTURE(std::string(kernels.name), coherence.converging, coherence.parallel, coherence.beyond,
            planes, node_width);
    Rays rays(1000, 12.0);
    Traced traced(make_scene(false, planes, node_width), rays.padded);
    const Vec3d apex(coherence.apex[0], coherence.apex[1], coherence.apex[2]);
    for (std::size_t i = 0; i < rays.count; ++i) {
        rays.stay_near(i);
        const Vec3d on_plane = rays.get(i).origin;
        const Vec3d way = normalized(coherence.parallel ? Vec3d(0.3, 1.0, 0.2) : on_plane - apex);
        rays.aim(i, coherence.converging ? -way : way);
        if (!coherence.converging && !coherence.parallel && !coherence.beyond) rays.start(i, apex);
    }
    REQUIRE((traced.data.listed_kinds() != 0) == (planes > 0));
    std::vector<Hit<double>> hits;
    for (std::size_t i = 0; i < rays.count; ++i)
        hits.push_back(traced.nearest(rays.get(i)));
    CHECK(std::count_if(hits.begin(), hits.end(), [](const Hit<double>& hit) {
              return hit.any();
          }) > static_cast<int>(rays.count) / 4);
    const TraceKernels& trace = Traced::exactly(kernels);
    for (const std::size_t count : {std::size_t{3}, std::size_t{16}, std::size_t{100},
                                    std::size_t{256}, std::size_t{259}, rays.count}) {
        CAPTURE(count);
        const RoundedRays rounded = rays.round(kernels);
        Answers alone(rays.padded), together(rays.padded);
        // Either some rays already have a hit before all shapes, or all rays have one just behind
        // the nearest hit.
        for (std::size_t i = 0; i < count; ++i) {
            const bool behind = count % 2 == 0 && hits[i].any();
            const float met = behind                         ? 1.01F * static_cast<float>(hits[i].t)
                              : i % 5 == 0 || count % 2 == 0 ? 2.0F
                                                             : Answers::infinity;
            alone.first[i] = alone.second[i] = together.first[i] = together.second[i] = met;
        }
        TraceCounters counters{};
        trace.nearest(traced.data.view(), all_kinds, nullptr, count, rounded, alone.candidates(),
                      {}, counters);
        trace.nearest(traced.data.view(), traced.data.listed_kinds(), &coherence, count, rounded,
                      together.candidates(), traced.workspace, counters);
        // A frustum of few rays may meet too many shapes, and give up.
        CHECK((counters.in_frusta == count || count % 256 <= 16));
        int different = 0;
        for (std::size_t i = 0; i < count; ++i) {
            traced.check(together, i, hits[i]);
            different += alone.agree(together, i) ? 0 : 1;
        }
        CHECK(different <= static_cast<int>(count) / 50); // possible but uncertain hits
    }
}

} // namespace

TEST_CASE("reordering rays to a light does not change their answers") {
    for (const Isa isa : available_isas()) {
        for (const bool small : {false, true}) {
            check_light(kernels_of(isa), true, 100, small);
            for (const std::size_t strays : {100, 30, 20, 5, 0})
                check_light(kernels_of(isa), false, strays, small);
        }
    }
}

TEST_CASE("rays to a light behind many shapes go as lists, unless they are scattered") {
    for (const Isa isa : available_isas()) {
        const Kernels& kernels = kernels_of(isa);
        CAPTURE(std::string(kernels.name));
        Rays rays(256, 9.0);
        Random random(3);
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        for (int i = 0; i < 5000; ++i)
            builder.add(Sphere{{static_cast<float>(random.uniform(-8.0, 0.0)),
                                static_cast<float>(random.uniform(0.0, 0.15)),
                                static_cast<float>(random.uniform(0.0, 0.15))},
                               0.0005F},
                        0);
        const Traced traced(std::move(builder).build(), rays.padded);
        SceneView view = traced.data.view();
        view.small = false;
        const Vec3d light(20.0, 0.0, 0.0);
        for (std::size_t i = 0; i < rays.padded; ++i) {
            rays.start(
                i, {-9.0, 0.01 * static_cast<double>(i % 16), 0.01 * static_cast<double>(i / 16)});
            const Vec3d way = light - rays.get(i).origin;
            rays.aim(i, normalized(way));
            rays.t_limit[i] = static_cast<float>(length(way));
        }
        for (const bool scattered : {false, true}) {
            CAPTURE(scattered);
            Coherence to_light{{20.0F, 0.0F, 0.0F}, true, false, false, false};
            to_light.scattered = scattered;
            const RoundedRays rounded = rays.round(kernels);
            Answers answers(rays.padded);
            TraceCounters counters{};
            Traced::exactly(kernels).occluded(view, 0, &to_light, rays.count, rounded,
                                              {rays.t_limit.data(), answers.state.data()},
                                              traced.workspace, counters);
            CHECK((scattered ? counters.in_flight : counters.in_lists) == rays.count);
            const auto dark =
                std::count(answers.state.begin(), answers.state.begin() + 256, blocked);
            CHECK((dark > 0 && dark < 256));
        }
    }
}

TEST_CASE("rays see the same in a frustum as alone") {
    for (const Isa isa : available_isas()) {
        for (const Coherence& coherence : {
                 Coherence{{4.0F, -20.0F, 2.0F}, false, false, false, false}, // from the camera
                 Coherence{{4.0F, -20.0F, 2.0F}, false, false, false, true},  // off a mirror
                 Coherence{{6.0F, 25.0F, 5.0F}, true, false, false, false},   // to a light
                 Coherence{{0.0F, 0.0F, 0.0F}, false, true, false, false},    // parallel
             })
            for (const int planes : {0, 2}) // planes are in no tree and their t has no limit
                for (const int node_width : {16, 8})
                    check_frustum(kernels_of(isa), coherence, planes, node_width);
    }
}
