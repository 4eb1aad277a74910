#include "bench/random_shapes.hpp"
#include "core/precision.hpp"
#include "core/reference/search.hpp"
#include "simd/isa.hpp"
#include "simd/wavefront/hit_finder.hpp"
#include "tests/ray_sets.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

/// Each precision's speed beside its error, over the same rays at the same shapes: rays per second
/// that find the nearest of a few shapes, normals included; and of these rays how many hit
/// something else than they should, and the ulps that t is off by for the others. What is right
/// core::Searcher<double> says, which certifies it. Rays are as the engine has them: their
/// directions are in double, so what a method loses by rounding them counts.

namespace {

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

constexpr std::size_t ray_count = 4096;
constexpr int shape_count = 12;

struct Truth {
    std::uint32_t slot;
    bool entering;
    double t;
};

/// `hard`: of rays made to be so; else random ones.
template <class Shape, bool hard>
struct Setup {
    Scene scene;
    simd::SceneData data{scene};
    simd::Arena arena;
    simd::Paths paths{};
    std::vector<Truth> truths; ///< by ray

    explicit Setup(Random random = Random(static_cast<std::uint64_t>(kind_of<Shape>) + 1))
        : scene(make(random)) {
        simd::Arena measure;
        paths.take_from(measure, ray_count, false);
        arena = simd::Arena(measure.used());
        paths.take_from(arena, ray_count, false);
        paths.count = ray_count;
        paths.start_in_the_open(0, ray_count);
        Searcher<double> searcher(scene, Search::every_shape);
        const auto& table = std::get<Table<Shape>>(scene.shapes());
        for (std::size_t i = 0; i < ray_count; ++i) {
            const Shape shape = table.blocks()[0].get(random.integer(0, shape_count - 1));
            const Set set = hard ? ray_sets::all_sets[random.integer(1, 6)] : Set::random;
            const Ray<float> aimed = ray_sets::make_ray(shape, set, random);
            const Ray<double> ray{convert<double>(aimed.origin),
                                  normalized(convert<double>(aimed.direction))};
            for (int axis = 0; axis < 3; ++axis) {
                paths.origin[axis][i] = ray.origin[axis];
                paths.direction[axis][i] = ray.direction[axis];
            }
            const Hit<double> hit =
                searcher.nearest(ray, {}, [](const Hit<double>&) { return true; }).hit;
            truths.push_back({hit.any() ? data.slot_of(hit.kind, hit.slot) : simd::no_slot,
                              hit.entering, hit.t});
        }
    }

    static Scene make(Random& random) {
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        for (int i = 0; i < shape_count; ++i)
            builder.add(ray_sets::Target<Shape>::make(random, false), 0);
        return std::move(builder).build();
    }
};

template <class Shape, bool hard>
const Setup<Shape, hard>& setup() {
    static const Setup<Shape, hard> only;
    return only;
}

/// Floats between two of the same sign.
double ulps(double t, double truth) {
    const auto exponent = std::max(std::ilogb(truth), -126);
    return std::abs(static_cast<double>(static_cast<float>(t)) - truth) /
           std::ldexp(1.0, exponent - 23);
}

void report(benchmark::State& state, const std::vector<Truth>& truths, const simd::Hits& hits) {
    int wrong = 0;
    std::vector<double> errors;
    for (std::size_t i = 0; i < ray_count; ++i) {
        const Truth& truth = truths[i];
        const bool hit = hits.slot[i] != simd::no_slot && (hits.hit[i] & simd::hit_none) == 0;
        const bool same = hit ? hits.slot[i] == truth.slot &&
                                    ((hits.hit[i] & simd::hit_entering) != 0) == truth.entering
                              : truth.slot == simd::no_slot;
        wrong += same ? 0 : 1;
        if (same && hit) errors.push_back(ulps(hits.t[i], truth.t));
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
        return errors.empty() ? 0.0
                              : errors[static_cast<std::size_t>(
                                    share * static_cast<double>(errors.size() - 1))];
    };
    state.counters["wrong"] = wrong / static_cast<double>(ray_count);
    state.counters["ulps_median"] = at(0.5);
    state.counters["ulps_p99"] = at(0.99);
    state.counters["ulps_max"] = at(1.0);
}

template <class Shape, bool hard>
void find(benchmark::State& state, simd::Isa isa, Precision precision) {
    const Setup<Shape, hard>& of = setup<Shape, hard>();
    ReferenceTracer<double> reference(of.scene, of.scene.settings(), Search::hierarchy, precision);
    simd::HitFinder finder(of.data, {&simd::kernels_of(isa), precision}, &reference);
    simd::Arena measure;
    finder.take_from(measure, ray_count);
    simd::Arena arena(measure.used());
    finder.take_from(arena, ray_count);
    Counters counters;
    for (auto _ : state)
        finder.find(of.paths, nullptr, counters);
    state.SetItemsProcessed(static_cast<std::int64_t>(ray_count) * state.iterations());
    const double rays = static_cast<double>(ray_count) * static_cast<double>(state.iterations());
    state.counters["refined"] = static_cast<double>(counters.refined) / rays;
    state.counters["left_to_the_reference"] = static_cast<double>(counters.doubtful) / rays;
    report(state, of.truths, finder.hits());
}

template <class Shape, bool hard>
void add() {
    std::string shape(name_of(kind_of<Shape>));
    std::replace(shape.begin(), shape.end(), ' ', '_');
    for (const simd::Isa isa : simd::all_isas)
        if (simd::is_available(isa))
            for (const Precision precision : all_precisions)
                benchmark::RegisterBenchmark(
                    ("methods/" + shape + (hard ? "/hard/" : "/random/") +
                     std::string(name_of(precision)) + "/" + std::string(simd::name_of(isa)))
                        .c_str(),
                    [=](benchmark::State& state) { find<Shape, hard>(state, isa, precision); });
}

const bool registered = [] {
    bench::for_each_kind([]<class Shape>() {
        add<Shape, false>();
        add<Shape, true>();
    });
    return true;
}();

} // namespace
