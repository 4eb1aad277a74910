#include "bench/ceiling/prepare.hpp"
#include "bench/method_rays.hpp"
#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"

/// Measures, for each kind of shape, the simplest fast float loop (ceiling.hpp). Its speed is an
/// upper bound for raylane's float methods. The rays and shapes are those of the other benchmarks
/// of methods.
namespace raylane::bench {

namespace {

CeilingUnit unit_of(simd::Isa isa) {
    return simd::of_isa(isa, []<simd::Isa which>() { return ceiling<which>(); });
}

template <class Shape>
CeilingLoop loop_of(const CeilingUnit& unit) {
    switch (core::kind_of<Shape>) {
    case core::Kind::sphere:
        return unit.sphere;
    case core::Kind::plane:
        return unit.plane;
    case core::Kind::disc:
        return unit.disc;
    case core::Kind::triangle:
    case core::Kind::smooth_triangle:
        return unit.triangle;
    case core::Kind::box:
        return unit.box;
    case core::Kind::open_cylinder:
        return unit.open_cylinder;
    case core::Kind::capped_cylinder:
        return unit.capped_cylinder;
    case core::Kind::open_cone:
        return unit.open_cone;
    case core::Kind::capped_cone:
        return unit.capped_cone;
    case core::Kind::quadric:
        return unit.quadric;
    case core::Kind::ellipsoid:
        return unit.ellipsoid;
    }
    return nullptr;
}

/// Columns of floats: the rays and hits of a tracer in float.
struct Columns {
    std::vector<float> origin[3], direction[3], t, normal[3];
    std::vector<std::uint32_t> shape;

    explicit Columns(const simd::Paths& paths) : t(paths.count), shape(paths.count) {
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis].assign(paths.origin[axis], paths.origin[axis] + paths.count);
            direction[axis].assign(paths.direction[axis], paths.direction[axis] + paths.count);
            normal[axis].resize(paths.count);
        }
    }
    CeilingRays rays() const {
        return {t.size(),
                {origin[0].data(), origin[1].data(), origin[2].data()},
                {direction[0].data(), direction[1].data(), direction[2].data()}};
    }
    CeilingHits hits() {
        return {t.data(), shape.data(), {normal[0].data(), normal[1].data(), normal[2].data()}};
    }
    Crossed crossed(std::size_t i, const simd::SceneData& data, core::Kind kind) const {
        if (t[i] == std::numeric_limits<float>::infinity()) return {};
        double along = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            along += static_cast<double>(normal[axis][i]) * static_cast<double>(direction[axis][i]);
        return {data.slot_of(kind, {0, static_cast<std::uint8_t>(shape[i])}), along < 0.0,
                static_cast<double>(t[i])};
    }
};

template <class Shape, bool hard>
void find(benchmark::State& state, simd::Isa isa) {
    const auto& method_rays = MethodRays<Shape, hard>::get();
    Numbers numbers;
    for (int i = 0; i < method_shape_count; ++i)
        prepare(method_rays.shape(i), numbers);
    Columns columns(method_rays.paths);
    const CeilingLoop loop = loop_of<Shape>(unit_of(isa));
    for (auto _ : state)
        loop(numbers.data(), method_shape_count, columns.rays(), columns.hits());
    state.SetItemsProcessed(static_cast<std::int64_t>(method_ray_count) * state.iterations());
    std::vector<Crossed> found;
    for (std::size_t i = 0; i < method_ray_count; ++i)
        found.push_back(columns.crossed(i, method_rays.data, core::kind_of<Shape>));
    report_errors(state, method_rays.truths, found);
}

template <class Shape, bool hard>
void add() {
    for (const simd::Isa isa : simd::available_isas())
        benchmark::RegisterBenchmark(
            ("methods/" + benchmark_name<Shape>() + (hard ? "/hard/" : "/random/") + "ceiling/" +
             std::string(simd::name_of(isa)))
                .c_str(),
            [=](benchmark::State& state) { find<Shape, hard>(state, isa); });
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
