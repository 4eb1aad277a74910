#include "simd/isa/isa.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "tests/simd/kernel/traverse/traced.hpp"
#include "tests/support/sanitized.hpp"

using namespace raylane;
using namespace raylane::tests;

/// Compares rays through the hierarchy with brute force and with the scalar search.

namespace {

/// Candidates of rays, found by brute force, as interleaved single rays, and by lists.
struct EachWay {
    Answers by_all, by_tree, by_lists;
};

/// Returns the workspace without room for lists.
Workspace without_lists(const Traced& traced) {
    Workspace small = traced.workspace;
    small.capacity = 0;
    return small;
}

EachWay nearest_each_way(const Kernels& kernels, const Traced& traced, const Rays& rays,
                         const RoundedRays& rounded) {
    const TraceKernels& trace = Traced::exactly(kernels);
    const std::size_t count = rays.count;
    EachWay ways{Answers(rays.padded), Answers(rays.padded), Answers(rays.padded)};
    TraceCounters counters{};
    trace.nearest(traced.data.view(), all_kinds, nullptr, count, rounded, ways.by_all.candidates(),
                  {}, counters);
    trace.nearest(traced.data.view(), 0, nullptr, count, rounded, ways.by_tree.candidates(),
                  without_lists(traced), counters);
    CHECK(counters.in_flight == count);
    trace.nearest(traced.data.view(), 0, &neighbours, count, rounded, ways.by_lists.candidates(),
                  traced.workspace, counters);
    CHECK(counters.in_lists == count);
    return ways;
}

void check(const Kernels& kernels, bool overlapping, int node_width) {
    CAPTURE(std::string(kernels.name), overlapping, node_width);
    Rays rays(sanitized ? 301 : 3001, overlapping ? 9.0 : 12.0);
    Traced traced(make_scene(overlapping, 0, node_width), rays.padded);
    REQUIRE(traced.data.has_tree());
    const RoundedRays rounded = rays.round(kernels);

    auto [by_all, by_tree, by_lists] = nearest_each_way(kernels, traced, rays, rounded);
    const TraceKernels& trace = Traced::exactly(kernels);
    TraceCounters counters{};
    trace.occluded(traced.data.view(), all_kinds, nullptr, rays.count, rounded,
                   {rays.t_limit.data(), by_all.state.data()}, {}, counters);
    trace.occluded(traced.data.view(), 0, nullptr, rays.count, rounded,
                   {rays.t_limit.data(), by_tree.state.data()}, without_lists(traced), counters);
    CHECK(counters.in_flight == rays.count);
    trace.occluded(traced.data.view(), 0, &neighbours, rays.count, rounded,
                   {rays.t_limit.data(), by_lists.state.data()}, traced.workspace, counters);
    CHECK(counters.in_lists == rays.count);

    int hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.count; ++i) {
        const Hit<double> hit = traced.nearest(rays.get(i));
        hits += hit.any() ? 1 : 0;
        for (const Answers* answers : {&by_all, &by_tree, &by_lists}) {
            CAPTURE(i, answers == &by_tree, hit.t);
            traced.check(*answers, i, hit);
            const std::uint8_t state = answers->state[i];
            const auto t_limit = static_cast<double>(rays.t_limit[i]);
            if (state == blocked && !(hit.any() && hit.t < t_limit)) FAIL("nothing blocks it");
            if (state == unblocked && hit.any() && hit.t < t_limit) FAIL("not open");
        }
        // Bounds of nodes can rule out uncertain candidates, above all along the faces of boxes.
        if (i % 4 == 1) continue;
        for (const Answers* tree : {&by_tree, &by_lists})
            different += by_all.agree(*tree, i) && by_all.state[i] == tree->state[i] ? 0 : 1;
    }
    CAPTURE(different);
    CHECK(hits > static_cast<int>(rays.count) / 4);
    CHECK(different <= static_cast<int>(rays.count) / 100);
}

/// Checks rays that leave the shape that they would hit first, and in part those with the ids next
/// to it. They must not find these shapes by brute force or by the hierarchy, which looks for them
/// before it packs pairs.
void check_departures(const Kernels& kernels, bool overlapping, int node_width) {
    CAPTURE(std::string(kernels.name), overlapping, node_width);
    Rays rays(sanitized ? 301 : 3001, overlapping ? 9.0 : 12.0);
    Traced traced(make_scene(overlapping, 0, node_width), rays.padded);
    for (std::size_t i = 0; i < rays.count; ++i) {
        const Hit<double> hit = traced.nearest(rays.get(i));
        if (!hit.any()) continue;
        const ShapeId around = i % 2 != 0 && hit.shape != 0 ? 1 : 0;
        rays.leave(i, hit.shape - around, hit.shape + around);
    }
    const RoundedRays rounded = rays.round(kernels);
    const auto [by_all, by_tree, by_lists] = nearest_each_way(kernels, traced, rays, rounded);
    int leave = 0, found[3] = {}, different = 0;
    for (std::size_t i = 0; i < rays.count; ++i) {
        leave += rays.origin_first[i] == no_slot ? 0 : 1;
        const Answers* const ways[] = {&by_all, &by_tree, &by_lists};
        for (int way = 0; way < 3; ++way) {
            const std::uint32_t slot = ways[way]->slot[i];
            CAPTURE(i, way, slot);
            if (i % 4 != 1 && ways[way]->first[i] != by_all.first[i]) ++different;
            if (slot == no_slot) continue;
            ++found[way];
            if (rays.leaves(i, traced.data.id_of(slot))) FAIL("what it leaves");
        }
    }
    CAPTURE(different);
    CHECK(leave > static_cast<int>(rays.count) / 4);
    for (const int by_way : found)
        CHECK(by_way > leave / 3);
    CHECK(different <= static_cast<int>(rays.count) / 100);
}

} // namespace

TEST_CASE("all traversals find crossings whose squares are too large for float") {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 1e20F}, 0);
    for (int i = 0; i < 60; ++i) // off the rays, and enough for a tree
        builder.add(
            Sphere{{1e19F * static_cast<float>(i % 8), -4e20F, 1e19F * static_cast<float>(i / 8)},
                   1e18F},
            0);
    const Scene scene = std::move(builder).build();
    const std::size_t count = 100;
    std::vector<float> x(count, -1e21F), y(count), zero(count, 0.0F), one(count, 1.0F);
    for (std::size_t i = 0; i < count; ++i)
        y[i] = 5e19F + 1e17F * static_cast<float>(i);
    const RayStream<float> rays{
        count, {x.data(), y.data(), zero.data()}, {one.data(), zero.data(), zero.data()}};
    for (const Isa isa : available_isas()) {
        const StreamTracer tracer(scene, 1, isa);
        std::vector<ShapeId> shape(count);
        std::vector<std::uint8_t> occluded(count);
        HitStream hits;
        hits.shape = shape.data();
        tracer.nearest(rays, hits);
        tracer.occluded(rays, occluded.data());
        CHECK(std::count(shape.begin(), shape.end(), ShapeId{0}) == static_cast<int>(count));
        CHECK(std::count(occluded.begin(), occluded.end(), 1) == static_cast<int>(count));
    }
}

TEST_CASE("the hierarchy loses no hit") {
    for (const Isa isa : available_isas())
        for (const bool overlapping : {false, true})
            for (const int node_width : {16, 8})
                check(kernels_of(isa), overlapping, node_width);
}

TEST_CASE("no traversal finds the shape that a ray leaves") {
    for (const Isa isa : available_isas())
        for (const bool overlapping : {false, true})
            for (const int node_width : {16, 8})
                check_departures(kernels_of(isa), overlapping, node_width);
}

TEST_CASE("random rays use lists if these are long or the hierarchy fits in the cache") {
    const Kernels& kernels = kernels_of(best_isa());
    Rays rays(4096, 12.0);
    const Traced traced(make_scene(false), rays.padded);
    const RoundedRays rounded = rays.round(kernels);
    for (const bool small : {false, true})
        for (const bool large : {false, true})
            for (const std::size_t count : {std::size_t{4095}, std::size_t{4096}})
                for (const Precision precision :
                     {Precision::exact, Precision::plain_double, Precision::robust}) {
                    SceneView view = traced.data.view();
                    view.small = small;
                    view.large = large;
                    Answers found(rays.padded);
                    TraceCounters counters{};
                    const TraceKernels& trace = Tracing{&kernels, precision}.method().trace;
                    trace.nearest(view, 0, nullptr, count, rounded, found.candidates(),
                                  traced.workspace, counters);
                    CAPTURE(small, large, count, precision == Precision::exact);
                    // Only `exact` has more than one traversal.
                    const bool makes_lists =
                        precision == Precision::exact && (small || (!large && count == 4096));
                    CHECK(counters.in_lists == (makes_lists ? count : 0));
                    CHECK(counters.in_flight == (makes_lists ? 0 : count));

                    // Occlusion of long lists is faster in flight.
                    counters = {};
                    trace.occluded(view, 0, nullptr, count, rounded,
                                   {rays.t_limit.data(), found.state.data()}, traced.workspace,
                                   counters);
                    CHECK(counters.in_lists ==
                          (precision == Precision::exact && small ? count : 0));
                }
}
