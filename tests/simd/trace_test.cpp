#include "core/reference/search.hpp"
#include "simd/isa.hpp"
#include "simd/stream_tracer.hpp"
#include "simd/wavefront/hit_finder.hpp"
#include "tests/catch.hpp"
#include "tests/ray_sets.hpp"
#include "tests/sanitized.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;

/// Rays through the hierarchy against all shapes one by one, and against the scalar search.

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

template <class Shape>
void add(SceneBuilder& builder, Random& random, int count) {
    for (int i = 0; i < count; ++i)
        builder.add(ray_sets::Target<Shape>::make(random, false), 0);
}

/// `overlapping`: spheres around one point, so that rays have all of the tree before them.
Scene make_scene(bool overlapping) {
    Random random(5);
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    if (overlapping) {
        for (int i = 0; i < 2000; ++i)
            builder.add(Sphere{ray_sets::rounded(random.cube(1.0)),
                               static_cast<float>(random.uniform(4.0, 5.0))},
                        0);
        return std::move(builder).build();
    }
    add<Sphere>(builder, random, 200);
    add<Disc>(builder, random, 40);
    add<Triangle>(builder, random, 40);
    add<SmoothTriangle>(builder, random, 40);
    add<Box>(builder, random, 40);
    add<OpenCylinder>(builder, random, 40);
    add<CappedCylinder>(builder, random, 40);
    add<OpenCone>(builder, random, 40);
    add<CappedCone>(builder, random, 40);
    add<Quadric>(builder, random, 40);
    return std::move(builder).build();
}

struct Rays {
    std::size_t count, padded;
    std::vector<double> of[6];
    std::vector<float> rounded[7], t_most;
    std::vector<std::uint32_t> departed_first, departed_last;

    Rays(std::size_t n, double size)
        : count(n), padded((n + 31) / 16 * 16), t_most(padded), departed_first(padded, no_slot),
          departed_last(padded, no_slot) {
        Random random(7);
        for (std::vector<double>& values : of)
            values.assign(padded, 1.0);
        for (std::vector<float>& values : rounded)
            values.resize(padded);
        for (std::size_t i = 0; i < n; ++i) {
            Vec3d origin = random.cube(size), direction = random.direction();
            if (i % 4 == 1) { // along planes and axes, or all but
                constexpr double little[] = {0.0, -0.0, 1e-40, -1e-40, 1e-12, -1e-33};
                for (int axis = random.integer(0, 2), k = 0; k < random.integer(1, 2); ++k)
                    direction[(axis + k) % 3] = little[random.integer(0, 5)];
                if (squared_length(direction) < 1e-3) direction.x = 1.0;
                direction /= std::sqrt(squared_length(direction));
            }
            if (i % 8 == 2) origin = 50.0 * origin, direction = normalized(random.cube(3) - origin);
            if (i % 16 == 3) origin = convert<double>(ray_sets::rounded(origin)) * 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                of[axis][i] = origin[axis];
                of[3 + axis][i] = direction[axis];
            }
            t_most[i] = static_cast<float>(random.log_uniform(0.05, 30.0));
        }
    }

    RoundedRays round(const Kernels& kernels) {
        const RoundedRays result = {{rounded[0].data(), rounded[1].data(), rounded[2].data()},
                                    {rounded[3].data(), rounded[4].data(), rounded[5].data()},
                                    rounded[6].data(),
                                    departed_first.data(),
                                    departed_last.data(),
                                    {of[0].data(), of[1].data(), of[2].data()},
                                    {of[3].data(), of[4].data(), of[5].data()}};
        kernels.rays.round_rays(count, result);
        return result;
    }

    void aim(std::size_t i, const Vec3d& direction) {
        for (int axis = 0; axis < 3; ++axis)
            of[3 + axis][i] = direction[axis];
    }

    /// The ray starts on the shapes of these ids.
    void leave(std::size_t i, ShapeId first, ShapeId last) {
        departed_first[i] = first;
        departed_last[i] = last;
    }
    bool leaves(std::size_t i, ShapeId id) const {
        return departed_first[i] <= id && id <= departed_last[i];
    }

    void start(std::size_t i, const Vec3d& origin) {
        for (int axis = 0; axis < 3; ++axis)
            of[axis][i] = origin[axis];
    }

    /// As if seen beside the last 16, in one plane.
    void stay_near(std::size_t i) {
        const double row = static_cast<double>(i / 64), along = static_cast<double>(i % 64 / 16);
        of[0][i] = 0.2 * (4.0 * along + static_cast<double>(i % 4));
        of[1][i] = -9.0;
        of[2][i] = 0.2 * (4.0 * row + static_cast<double>(i / 4 % 4)) - 4.0;
    }

    Ray<double> get(std::size_t i) const {
        return {{of[0][i], of[1][i], of[2][i]}, {of[3][i], of[4][i], of[5][i]}};
    }
};

struct Answers {
    std::vector<float> first, second;
    std::vector<std::uint32_t> slot;
    std::vector<std::uint8_t> state;

    explicit Answers(std::size_t padded)
        : first(padded, infinity), second(padded, infinity), slot(padded, no_slot),
          state(padded, open) {}
    Candidates candidates() { return {first.data(), second.data(), slot.data()}; }
};

constexpr std::uint32_t all_kinds = (1U << kinds) - 1;

/// What rays may hit: shape by shape, in flight, and by lists.
struct EachWay {
    Answers by_all, by_tree, by_lists;
};

EachWay nearest_each_way(const TraceKernels& trace, const SceneData& data, std::size_t count,
                         const RoundedRays& rounded, std::size_t padded,
                         const Workspace& workspace) {
    EachWay ways{Answers(padded), Answers(padded), Answers(padded)};
    TraceCounters counters{};
    trace.nearest(data.view(), all_kinds, nullptr, count, rounded, ways.by_all.candidates(), {},
                  counters);
    Workspace small = workspace;
    small.capacity = 0;
    trace.nearest(data.view(), 0, nullptr, count, rounded, ways.by_tree.candidates(), small,
                  counters);
    CHECK(counters.in_flight == count);
    trace.nearest(data.view(), 0, &neighbours, count, rounded, ways.by_lists.candidates(),
                  workspace, counters);
    CHECK(counters.in_streams == count);
    return ways;
}

void check(const Kernels& kernels, bool overlapping) {
    CAPTURE(std::string(kernels.name), overlapping);
    const Scene scene = make_scene(overlapping);
    const SceneData data(scene);
    REQUIRE(data.has_tree());
    Rays rays(tests::sanitized ? 301 : 3001, overlapping ? 9.0 : 12.0);
    const RoundedRays rounded = rays.round(kernels);

    Workspace workspace{};
    const Arena arena =
        arena_for([&](Arena& a) { workspace = workspace_for(data, a, rays.padded); });
    const TraceKernels& trace = Tracing{&kernels, Precision::exact}.method().trace;
    TraceCounters counters{};
    auto [by_all, by_tree, by_lists] =
        nearest_each_way(trace, data, rays.count, rounded, rays.padded, workspace);
    trace.occluded(data.view(), all_kinds, nullptr, rays.count, rounded,
                   {rays.t_most.data(), by_all.state.data()}, {}, counters);
    trace.occluded(data.view(), 0, nullptr, rays.count, rounded,
                   {rays.t_most.data(), by_tree.state.data()}, workspace, counters);
    by_lists.state = by_tree.state;

    Searcher<double> searcher(scene, Search::hierarchy);
    int hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.count; ++i) {
        const Hit<double> hit =
            searcher.nearest(rays.get(i), {}, [](const Hit<double>&) { return true; }).hit;
        hits += hit.any() ? 1 : 0;
        for (const Answers* answers : {&by_all, &by_tree, &by_lists}) {
            const auto first = static_cast<double>(answers->first[i]);
            const auto seen_to = static_cast<double>(
                std::min(answers->second[i], answers->first[i] * culling_slack));
            CAPTURE(i, answers == &by_tree, hit.t, first, seen_to);
            if (hit.any() && !(first <= hit.t * (1 + 1e-12))) FAIL("passed the nearest by");
            if (hit.any() && hit.t < seen_to &&
                answers->slot[i] != data.slot_of(hit.kind, hit.slot))
                FAIL("another shape");
            const std::uint8_t state = answers->state[i];
            const auto t_most = static_cast<double>(rays.t_most[i]);
            if (state == blocked && !(hit.any() && hit.t < t_most)) FAIL("nothing blocks it");
            if (state == open && hit.any() && hit.t < t_most) FAIL("not open");
        }
        // What only may be there, the bounds of nodes can rule out: above all along the faces of
        // boxes.
        if (i % 4 == 1) continue;
        const float first = by_all.first[i], limit = first * culling_slack;
        for (const Answers* tree : {&by_tree, &by_lists}) {
            const float seconds[] = {by_all.second[i], tree->second[i]};
            const bool same =
                first == tree->first[i] && by_all.state[i] == tree->state[i] &&
                (by_all.slot[i] == tree->slot[i] || seconds[0] == first) &&
                (seconds[0] == seconds[1] || !(std::min(seconds[0], seconds[1]) < limit));
            different += same ? 0 : 1;
        }
    }
    CAPTURE(different);
    CHECK(hits > static_cast<int>(rays.count) / 4);
    CHECK(different <= static_cast<int>(rays.count) / 100);
}

/// Rays that leave what they would hit first, and some the shapes next to it by number, do not find
/// that: by the hierarchy, which looks for it before it packs pairs, as shape by shape.
void check_departures(const Kernels& kernels, bool overlapping) {
    CAPTURE(std::string(kernels.name), overlapping);
    const Scene scene = make_scene(overlapping);
    const SceneData data(scene);
    Rays rays(tests::sanitized ? 301 : 3001, overlapping ? 9.0 : 12.0);
    Searcher<double> searcher(scene, Search::hierarchy);
    for (std::size_t i = 0; i < rays.count; ++i) {
        const Hit<double> hit =
            searcher.nearest(rays.get(i), {}, [](const Hit<double>&) { return true; }).hit;
        if (!hit.any()) continue;
        const ShapeId around = i % 2 != 0 && hit.shape != 0 ? 1 : 0;
        rays.leave(i, hit.shape - around, hit.shape + around);
    }
    const RoundedRays rounded = rays.round(kernels);
    Workspace workspace{};
    const Arena arena =
        arena_for([&](Arena& a) { workspace = workspace_for(data, a, rays.padded); });
    const auto [by_all, by_tree, by_lists] =
        nearest_each_way(Tracing{&kernels, Precision::exact}.method().trace, data, rays.count,
                         rounded, rays.padded, workspace);
    int leave = 0, found = 0, different = 0;
    for (std::size_t i = 0; i < rays.count; ++i) {
        leave += rays.departed_first[i] == no_slot ? 0 : 1;
        for (const Answers* answers : {&by_all, &by_tree, &by_lists}) {
            const std::uint32_t slot = answers->slot[i];
            CAPTURE(i, answers == &by_tree, slot);
            if (slot == no_slot) continue;
            ++found;
            if (rays.leaves(i, data.id_of(slot))) FAIL("what it leaves");
            if (i % 4 != 1 && answers->first[i] != by_all.first[i]) ++different;
        }
    }
    CAPTURE(different);
    CHECK(leave > static_cast<int>(rays.count) / 4);
    CHECK(found > leave);
    CHECK(different <= static_cast<int>(rays.count) / 100);
}

/// Rays from anywhere to one light, which groups of them see in another order.
/// `strays`: of each hundred bunches, those that hold rays from anywhere between the others.
void check_light(const Kernels& kernels, bool overlapping, std::size_t strays) {
    CAPTURE(std::string(kernels.name), overlapping, strays);
    const Scene scene = make_scene(overlapping);
    const SceneData data(scene);
    Rays rays(3001, overlapping ? 9.0 : 12.0);
    const Vec3d light(20.0, 15.0, 10.0);
    for (std::size_t i = 0; i < rays.count; ++i) {
        if (i / 16 * 37 % 100 >= strays) rays.stay_near(i);
        const Ray<double> ray = rays.get(i);
        const Vec3d way = light - ray.origin;
        rays.aim(i, normalized(way));
        rays.t_most[i] = static_cast<float>(length(way));
    }
    Workspace workspace{};
    const Arena arena =
        arena_for([&](Arena& a) { workspace = workspace_for(data, a, rays.padded); });
    const Bundle to_light{{20.0F, 15.0F, 10.0F}, true, false, false, false};
    const TraceKernels& trace = Tracing{&kernels, Precision::exact}.method().trace;
    for (const std::size_t count : {std::size_t{5}, std::size_t{16}, std::size_t{63},
                                    std::size_t{256}, std::size_t{257}, rays.count}) {
        CAPTURE(count);
        const RoundedRays rounded = rays.round(kernels); // what is behind them is overwritten
        TraceCounters counters{};
        Answers alone(rays.padded), grouped(rays.padded);
        for (std::size_t i = 0; i < rays.padded; ++i) // what is blocked is not to be looked at
            alone.state[i] = grouped.state[i] = i % 7 == 0 ? blocked : i % 7 == 1 ? doubtful : open;
        const std::vector<std::uint8_t> before = grouped.state;
        trace.occluded(data.view(), 0, nullptr, count, rounded,
                       {rays.t_most.data(), alone.state.data()}, workspace, counters);
        trace.occluded(data.view(), 0, &to_light, count, rounded,
                       {rays.t_most.data(), grouped.state.data()}, workspace, counters);
        int opposed = 0, any = 0, lowered = 0;
        for (std::size_t i = 0; i < rays.padded; ++i) {
            any += i < count && (before[i] == blocked || grouped.state[i] != before[i]) ? 1 : 0;
            lowered +=
                grouped.state[i] < before[i] || (i >= count && grouped.state[i] != before[i]);
            opposed += static_cast<int>(std::max(alone.state[i], grouped.state[i]) == blocked &&
                                        std::min(alone.state[i], grouped.state[i]) == open);
        }
        CHECK(lowered == 0);
        CHECK(opposed == 0);
        if (count != rays.count) continue;
        CHECK((counters.in_frusta > 0) == !overlapping); // where too much is before them, none are
        CHECK(any > static_cast<int>(count) / 4);        // with those that were blocked before
        CHECK(any < static_cast<int>(count));
    }
}

/// Rays that have something in common see as a group what they see one by one.
void check_bundle(const Kernels& kernels, const Bundle& bundle) {
    CAPTURE(std::string(kernels.name), bundle.towards, bundle.parallel, bundle.beyond);
    const Scene scene = make_scene(false);
    const SceneData data(scene);
    Rays rays(1000, 12.0);
    const Vec3d apex(bundle.apex[0], bundle.apex[1], bundle.apex[2]);
    for (std::size_t i = 0; i < rays.count; ++i) {
        rays.stay_near(i);
        const Vec3d on_plane = rays.get(i).origin;
        const Vec3d way = normalized(bundle.parallel ? Vec3d(0.3, 1.0, 0.2) : on_plane - apex);
        rays.aim(i, bundle.towards ? -way : way);
        if (!bundle.towards && !bundle.parallel && !bundle.beyond) rays.start(i, apex);
    }
    Workspace workspace{};
    const Arena arena =
        arena_for([&](Arena& a) { workspace = workspace_for(data, a, rays.padded); });
    const TraceKernels& trace = Tracing{&kernels, Precision::exact}.method().trace;
    Searcher<double> searcher(scene, Search::hierarchy);
    for (const std::size_t count : {std::size_t{3}, std::size_t{16}, std::size_t{100},
                                    std::size_t{256}, std::size_t{259}, rays.count}) {
        CAPTURE(count);
        const RoundedRays rounded = rays.round(kernels);
        Answers alone(rays.padded), grouped(rays.padded);
        for (std::size_t i = 0; i < count; i += 5) // some have met something before all else
            alone.first[i] = alone.second[i] = grouped.first[i] = grouped.second[i] = 2.0F;
        TraceCounters counters{};
        trace.nearest(data.view(), all_kinds, nullptr, count, rounded, alone.candidates(), {},
                      counters);
        trace.nearest(data.view(), 0, &bundle, count, rounded, grouped.candidates(), workspace,
                      counters);
        CHECK(counters.in_frusta == count);
        int hits = 0, different = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Hit<double> hit =
                searcher.nearest(rays.get(i), {}, [](const Hit<double>&) { return true; }).hit;
            const auto first = static_cast<double>(grouped.first[i]);
            const auto seen_to =
                static_cast<double>(std::min(grouped.second[i], grouped.first[i] * culling_slack));
            CAPTURE(i, hit.t, first, seen_to);
            if (hit.any()) ++hits;
            if (hit.any() && !(first <= hit.t * (1 + 1e-12))) FAIL("passed the nearest by");
            if (hit.any() && hit.t < seen_to && grouped.slot[i] != data.slot_of(hit.kind, hit.slot))
                FAIL("another shape");
            different += alone.first[i] == grouped.first[i] ? 0 : 1;
        }
        CHECK(different <= static_cast<int>(count) / 50); // what only may be there
        if (count == rays.count) CHECK(hits > static_cast<int>(count) / 4);
    }
}

} // namespace

TEST_CASE("crossings whose squares are too large for float are met however rays go") {
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
    const RayStream rays{
        count, {x.data(), y.data(), zero.data()}, {one.data(), zero.data(), zero.data()}};
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
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

TEST_CASE("rays to a light are put in another order for nobody to notice") {
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        check_light(kernels_of(isa), true, 100);
        for (const std::size_t strays : {100, 30, 20, 5, 0})
            check_light(kernels_of(isa), false, strays);
    }
}

TEST_CASE("the hierarchy loses nothing of what rays meet") {
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        check(kernels_of(isa), false);
        check(kernels_of(isa), true);
    }
}

TEST_CASE("rays do not find what they leave however they go") {
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        check_departures(kernels_of(isa), false);
        check_departures(kernels_of(isa), true);
    }
}

TEST_CASE("rays see as a group what they see alone") {
    for (const Isa isa : all_isas) {
        if (!is_available(isa)) continue;
        for (const Bundle& bundle : {
                 Bundle{{4.0F, -20.0F, 2.0F}, false, false, false, false}, // from the camera
                 Bundle{{4.0F, -20.0F, 2.0F}, false, false, false, true},  // off a mirror
                 Bundle{{6.0F, 25.0F, 5.0F}, true, false, false, false},   // to a light
                 Bundle{{0.0F, 0.0F, 0.0F}, false, true, false, false},    // parallel
             })
            check_bundle(kernels_of(isa), bundle);
    }
}

TEST_CASE("random rays make lists where these are long and the hierarchy is in the cache") {
    const Scene scene = make_scene(false);
    const SceneData data(scene);
    const Kernels& kernels = kernels_of(*best_isa());
    Rays rays(4096, 12.0);
    const RoundedRays rounded = rays.round(kernels);
    Workspace workspace{};
    const Arena arena =
        arena_for([&](Arena& a) { workspace = workspace_for(data, a, rays.padded); });
    for (const bool small : {false, true})
        for (const bool large : {false, true})
            for (const std::size_t count : {std::size_t{4095}, std::size_t{4096}})
                for (const Precision precision :
                     {Precision::exact, Precision::plain_double, Precision::robust}) {
                    SceneView view = data.view();
                    view.small = small;
                    view.large = large;
                    Answers found(rays.padded);
                    TraceCounters counters{};
                    Tracing{&kernels, precision}.method().trace.nearest(
                        view, 0, nullptr, count, rounded, found.candidates(), workspace, counters);
                    CAPTURE(small, large, count, precision == Precision::exact);
                    // What a float method makes of a ray may not depend on how many there are.
                    const bool makes_lists =
                        small || (!large && count == 4096 && precision == Precision::exact);
                    CHECK(counters.in_streams == (makes_lists ? count : 0));
                    CHECK(counters.in_flight == (makes_lists ? 0 : count));
                }
}
