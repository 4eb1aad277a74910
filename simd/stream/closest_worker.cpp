#include "simd/stream/closest_worker.hpp"

#include <cmath>

namespace raylane::simd {

namespace {

void store(const ClosestStream& to, std::size_t i, const core::Closest& closest) {
    if (to.distance != nullptr) to.distance[i] = closest.distance;
    for (int axis = 0; axis < 3; ++axis)
        if (to.point[axis] != nullptr) to.point[axis][i] = closest.point[axis];
    if (to.shape != nullptr) to.shape[i] = closest.shape;
    if (to.face != nullptr) to.face[i] = closest.face;
}

} // namespace

ClosestWorker::ClosestWorker(const SceneData& scene, const Tracing&, const ShapesByName&)
    : searcher_(scene.scene()) {}

template <class Real>
std::size_t ClosestWorker::find(const PointStream<Real>& points, const double* max_distance,
                                const ClosestStream& closest) {
    std::size_t refused = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
        const core::Vec3d point(static_cast<double>(points.at[0][i]),
                                static_cast<double>(points.at[1][i]),
                                static_cast<double>(points.at[2][i]));
        const double limit =
            max_distance != nullptr ? max_distance[i] : std::numeric_limits<double>::infinity();
        const bool is_valid = std::isfinite(point.x) && std::isfinite(point.y) &&
                              std::isfinite(point.z) && !std::isnan(limit);
        if (!is_valid) ++refused;
        store(closest, i, is_valid ? searcher_.find(point, limit) : core::Closest{});
    }
    return refused;
}

template std::size_t ClosestWorker::find(const PointStream<float>&, const double*,
                                         const ClosestStream&);
template std::size_t ClosestWorker::find(const PointStream<double>&, const double*,
                                         const ClosestStream&);

} // namespace raylane::simd
