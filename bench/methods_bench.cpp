#include "bench/method_rays.hpp"
#include "core/shapes/precision.hpp"
#include "simd/isa/isa.hpp"

/// Measures each precision's speed and error with the same rays and shapes: rays per second that
/// find the nearest of a few shapes, normals included.

namespace raylane::bench {

namespace {

/// Returns the crossings that were found. A query leaves rays that meet several surfaces at one
/// point to the reference tracer; here, the true crossing is taken for them.
std::vector<Crossed> found_in(const simd::Query& finder, const std::vector<Crossed>& truths) {
    const simd::Hits& hits = finder.hits();
    std::vector<Crossed> found(method_ray_count);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (hits.slot[i] != simd::no_slot && (hits.hit[i] & simd::hit_none) == 0)
            found[i] = {hits.slot[i], (hits.hit[i] & simd::hit_entering) != 0, hits.t[i]};
    for (const std::uint32_t i : finder.at_contacts())
        found[i] = truths[i];
    return found;
}

template <class Shape, bool hard>
void find(benchmark::State& state, simd::Isa isa, core::Precision precision) {
    const auto& method_rays = MethodRays<Shape, hard>::get();
    simd::Query finder(method_rays.data, {&simd::kernels_of(isa), precision}, simd::Asked::points);
    const simd::Arena arena =
        simd::arena_for([&](simd::Arena& a) { finder.take_from(a, method_ray_count); });
    simd::EngineCounters counters;
    for (auto _ : state)
        finder.nearest(method_rays.paths, nullptr, counters);
    state.SetItemsProcessed(static_cast<std::int64_t>(method_ray_count) * state.iterations());
    const double rays =
        static_cast<double>(method_ray_count) * static_cast<double>(state.iterations());
    state.counters["refined"] = static_cast<double>(counters.refined) / rays;
    state.counters["left_to_the_reference"] = static_cast<double>(counters.doubtful) / rays;
    report_errors(state, method_rays.truths, found_in(finder, method_rays.truths));
}

template <class Shape, bool hard>
void add() {
    for (const simd::Isa isa : simd::available_isas())
        for (const core::Precision precision : core::all_precisions)
            benchmark::RegisterBenchmark(
                ("methods/" + benchmark_name<Shape>() + (hard ? "/hard/" : "/random/") +
                 std::string(name_of(precision)) + "/" + std::string(simd::name_of(isa)))
                    .c_str(),
                [=](benchmark::State& state) { find<Shape, hard>(state, isa, precision); });
}

const bool registered = [] {
    for_each_kind([]<class Shape>() {
        add<Shape, false>();
        add<Shape, true>();
    });
    return true;
}();

} // namespace

} // namespace raylane::bench
