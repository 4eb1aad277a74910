#include "bench/peers/crossings.hpp"

#include "bench/peers/workload.hpp"
#include "simd/stream/row_worker.hpp"
#include "simd/stream/stream_tracer.hpp"

#include <algorithm>

namespace raylane::bench {

namespace {

/// The library as users call it.
class Library {
  public:
    Library(const core::Scene& scene, simd::Isa isa, const RaySet& rays)
        : tracer_(scene, /*threads=*/1, isa), count_(rays.count) {
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis].resize(count_);
            direction_[axis].resize(count_);
        }
        for (std::size_t i = 0; i < count_; ++i) {
            const core::Ray<float> ray = rays.ray_in_float(i);
            for (int axis = 0; axis < 3; ++axis) {
                origin_[axis][i] = ray.origin[axis];
                direction_[axis][i] = ray.direction[axis];
            }
        }
    }

    void run() {
        const auto component = [](const std::vector<float>(&columns)[3], int axis) {
            return columns[axis].data();
        };
        simd::CrossingCounters counters;
        tracer_.crossings(
            simd::RayStream<float>{
                count_,
                {component(origin_, 0), component(origin_, 1), component(origin_, 2)},
                {component(direction_, 0), component(direction_, 1), component(direction_, 2)}},
            {}, rows_, counters);
    }

    const simd::CrossingRows& rows() const { return rows_; }

  private:
    simd::StreamTracer tracer_;
    std::size_t count_;
    std::vector<float> origin_[3], direction_[3];
    simd::CrossingRows rows_;
};

/// Counts the rays whose crossings differ from the library's, or whose order does. Ties may have
/// either order.
std::size_t count_wrong(const simd::CrossingRows& right, const ShapeRows& other) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i + 1 < right.first.size(); ++i) {
        const std::uint64_t begin = right.first[i], end = right.first[i + 1];
        bool is_same = end - begin == other.first[i + 1] - other.first[i];
        for (std::uint64_t crossing = begin; is_same && crossing < end;) {
            std::uint64_t last = crossing + 1; // of the crossings at one t
            while (last < end && right.tied[last] != 0)
                ++last;
            const auto shapes_of = [&](const std::vector<core::ShapeId>& shapes,
                                       std::uint64_t first) {
                std::vector<core::ShapeId> part(
                    shapes.begin() + static_cast<std::ptrdiff_t>(first + crossing - begin),
                    shapes.begin() + static_cast<std::ptrdiff_t>(first + last - begin));
                std::sort(part.begin(), part.end());
                return part;
            };
            is_same = shapes_of(right.shape, begin) == shapes_of(other.shape, other.first[i]);
            crossing = last;
        }
        wrong += is_same ? 0 : 1;
    }
    return wrong;
}

} // namespace

Row measure_crossings(const simd::SceneData& scene, const Measuring& how) {
    const std::vector<RaySet> sets = make_ray_sets(scene.scene(), scene, how.side);
    const RaySet& rays = *std::find_if(sets.begin(), sets.end(),
                                       [](const RaySet& set) { return set.name == "random"; });
    Row row{"crossings", rays.count, /*is_speed=*/true, {}};
    Library library(scene.scene(), how.isa, rays);
    std::vector<TimedRun> runs = {
        {"library", [&](int /*threads*/) { return seconds_of([&] { library.run(); }); }}};
    const std::unique_ptr<Gatherer> embree = embree_gatherer(scene.scene(), how.isa, rays);
    if (embree != nullptr)
        runs.push_back({"embree 1 filter",
                        [&](int /*threads*/) { return seconds_of([&] { embree->run(); }); }});
    Measuring alone = how;
    alone.threads = 1;
    row.by = alternate(runs, alone);
    row.by[0].wrong = 0; // tests compare it with the oracle
    if (embree != nullptr) row.by[1].wrong = count_wrong(library.rows(), embree->rows());
    for (Result& result : row.by)
        result.in_millions_per_second(rays.count);
    return row;
}

} // namespace raylane::bench
