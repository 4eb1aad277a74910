#include "simd/query/approach.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace raylane::simd {

namespace {

/// In radii of the scene. Rays that start nearer are off by less than a thousandth of the scene
/// everywhere.
constexpr double far_away = 64.0;

/// Returns true if each term of the product has a factor 0.
bool is_parallel(const core::Vec3d& normal, const core::Vec3d& direction) {
    bool is = true;
    for (int axis = 0; axis < 3; ++axis)
        is = is && (normal[axis] == 0.0 || direction[axis] == 0.0);
    return is;
}

} // namespace

/// Finds the sphere around the tree and all copies. Without both, there is little to distinguish,
/// and no ray is moved from far away.
Approach::Approach(const SceneData& scene) : scene_(scene) {
    const core::Copies* const copies = scene.scene().copies();
    if (!scene.has_tree() && copies == nullptr) return;
    core::Bounds bounds = scene.scene().hierarchy().bounds;
    if (copies != nullptr) bounds.include(copies->bounds());
    const core::Vec3d lower = core::convert<double>(bounds.lower);
    const core::Vec3d upper = core::convert<double>(bounds.upper);
    center_ = 0.5 * (lower + upper);
    radius_ = 0.5 * core::length(upper - lower) * (1.0 + 0x1p-20);
}

double Approach::reach() const {
    return far_away * radius_;
}

void Approach::take_from(Arena& arena, std::size_t capacity) {
    room_ = arena.take<double>(capacity);
    t_ = arena.take<double>(capacity);
}

void Approach::find_starts(const RayColumns& from, RoundedRays& rays) {
    count_ = from.count;
    before_ = from.start;
    is_from_afar_ = are_far(from);
    if (is_from_afar_) {
        for (std::size_t lane = 0; lane < count_; ++lane) {
            core::Ray<double> ray; // of unit length
            for (int axis = 0; axis < 3; ++axis) {
                ray.origin[axis] = from.origin[axis][lane];
                ray.direction[axis] = from.direction[axis][lane];
            }
            room_[lane] = std::max(before_of(ray), from.start != nullptr ? from.start[lane] : 0.0);
        }
        before_ = room_;
    }
    rays.before = before_;
}

bool Approach::are_far(const RayColumns& rays) const {
    if (radius_ < 0.0) return false;
    const double most = reach();
    std::uint64_t signs = 0; // in lanes, unlike a maximum
    for (int axis = 0; axis < 3; ++axis) {
        const double* const origin = rays.origin[axis];
        const double center = center_[axis];
        for (std::size_t lane = 0; lane < rays.count; ++lane)
            signs |= std::bit_cast<std::uint64_t>(most - std::abs(origin[lane] - center));
    }
    return signs >> 63 != 0;
}

/// Returns how far a ray may be moved: up to a radius before the sphere around all bounded shapes,
/// and before any plane that it may cross until there.
double Approach::before_of(const core::Ray<double>& ray) const {
    const core::Vec3d to_center = center_ - ray.origin;
    // The error of the product is less than a few ulps of both lengths. So is that of the value
    // that t is compared with.
    double before = core::dot(to_center, ray.direction) - 2.0 * radius_ -
                    0x1p-49 * (core::length(ray.origin) + core::length(to_center));
    if (!(before > far_away * radius_)) return 0.0;
    const auto stop_before = [&](const core::InDouble<core::Plane>& plane, core::ShapeId) {
        const core::Vec3d& normal = plane.normal;
        const core::Vec3d to_plane = plane.point - ray.origin;
        if (is_parallel(normal, ray.direction)) return;
        const double size = core::length(normal);
        const double approach = core::dot(normal, ray.direction);
        const double t = core::dot(normal, to_plane) / approach;
        // The error of each product is less than a few ulps of its vectors' lengths.
        const double error =
            0x1p-49 * size * (core::length(to_plane) + std::abs(t)) / std::abs(approach);
        if (t + error < 0.0 || t - error > before + radius_) return;
        before = error < radius_ ? std::min(before, t - 2.0 * radius_) : 0.0;
    };
    core::for_each_unbounded_table(scene_.scene().shapes(), [&](const auto& table) {
        core::for_each_shape(table, stop_before);
    });
    return std::max(before, 0.0);
}

const double* Approach::from_there(const double* t) {
    if (!any()) return t;
    for (std::size_t lane = 0; lane < count_; ++lane)
        t_[lane] = t[lane] - before_[lane];
    return t_;
}

} // namespace raylane::simd
