#include "simd/stream/point_worker.hpp"

#include "core/optics/media.hpp"

#include <cmath>
#include <limits>

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

PointWorker::PointWorker(const SceneData& scene, const Tracing&, const ShapesByName&)
    : scene_(scene.scene()), solids_(scene_), surfaces_(scene_) {}

/// Calls visit(i, point, is_valid) for each point; `is_valid` is false if a coordinate is infinite
/// or NaN. Returns how often `visit` returned false.
template <class Real, class Visit>
std::size_t PointWorker::for_each_point(const PointStream<Real>& points, const Visit& visit) {
    std::size_t refused = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
        const core::Vec3d point(static_cast<double>(points.at[0][i]),
                                static_cast<double>(points.at[1][i]),
                                static_cast<double>(points.at[2][i]));
        const bool is_valid =
            std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
        if (!visit(i, point, is_valid)) ++refused;
    }
    return refused;
}

template <class Real>
std::size_t PointWorker::containing(const PointStream<Real>& points, SolidRows& rows) {
    return for_each_point(points, [&](std::size_t, const core::Vec3d& point, bool is_valid) {
        containing_.clear();
        solids_.add_containing(point, containing_);
        for (const core::Containing& solid : containing_) {
            rows.shape.push_back(solid.shape);
            rows.inside.push_back(solid.inside ? 1 : 0);
            rows.on_surface.push_back(solid.on_surface ? 1 : 0);
        }
        rows.first.push_back(rows.shape.size());
        return is_valid;
    });
}

template <class Real>
std::size_t PointWorker::cells(const PointStream<Real>& points, const CellStream& cells) {
    return for_each_point(points, [&](std::size_t i, const core::Vec3d& point, bool is_valid) {
        containing_.clear();
        solids_.add_containing(point, containing_);
        while (!containing_.empty() && !containing_.back().inside)
            containing_.pop_back();
        const bool any = !containing_.empty();
        const core::Containing cell =
            any ? containing_.back() : core::Containing{core::no_shape, false, false};
        if (cells.shape != nullptr) cells.shape[i] = cell.shape;
        if (cells.material != nullptr)
            cells.material[i] = any ? scene_.medium_index_of(cell.shape) : core::no_medium;
        if (cells.on_surface != nullptr) cells.on_surface[i] = cell.on_surface ? 1 : 0;
        return is_valid;
    });
}

template <class Real>
std::size_t PointWorker::closest(const PointStream<Real>& points, const double* max_distance,
                                 const ClosestStream& closest) {
    return for_each_point(points, [&](std::size_t i, const core::Vec3d& point, bool is_valid) {
        const double limit =
            max_distance != nullptr ? max_distance[i] : std::numeric_limits<double>::infinity();
        is_valid = is_valid && !std::isnan(limit);
        store(closest, i, is_valid ? surfaces_.find(point, limit) : core::Closest{});
        return is_valid;
    });
}

#define RAYLANE_INSTANTIATE(Real)                                                                  \
    template std::size_t PointWorker::containing(const PointStream<Real>&, SolidRows&);            \
    template std::size_t PointWorker::cells(const PointStream<Real>&, const CellStream&);          \
    template std::size_t PointWorker::closest(const PointStream<Real>&, const double*,             \
                                              const ClosestStream&);
RAYLANE_INSTANTIATE(float)
RAYLANE_INSTANTIATE(double)
#undef RAYLANE_INSTANTIATE

} // namespace raylane::simd
