#include "simd/query/cut_faces.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::simd {

namespace {

double sum_of_sizes(const core::Vec3d& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns yes if the ray crosses exactly one half-space at the point, one of the shape, and this
/// alone decides whether the point is cut off.
core::Value decides(const CutUnion& cut, core::ShapeId shape, const core::Vec3d& direction,
                    const core::Vec3d& point, double error) {
    const double rounding = 0x1p-48 * sum_of_sizes(point);
    int crossed = 0;
    bool is_cut_off = true, crosses = false; // of the current group
    for (const HalfSpace& half : cut.by) {
        const double outside = core::dot(half.normal, point) - half.offset;
        const double off = error + rounding + 0x1p-48 * half.size;
        if (!(std::abs(outside) > off)) {
            // The ray has to cross clearly: a touch changes nothing.
            if (half.shape != shape || !(std::abs(core::dot(half.normal, direction)) > 0x1p-20))
                return core::Value::unknown;
            ++crossed;
            crosses = true;
        } else if (outside < 0.0) {
            is_cut_off = false;
        }
        if (!half.ends_group) continue;
        if (crosses != is_cut_off) return core::Value::no;
        is_cut_off = true;
        crosses = false;
    }
    return crossed == 1 ? core::Value::yes : core::Value::unknown;
}

} // namespace

core::Value CutFaces::is_surface(const CutUnion& cut, core::ShapeId shape,
                                 const core::Vec3d& direction, const core::Vec3d& point,
                                 double error) {
    if (!cut.is_all) return core::Value::unknown;
    const core::Value decided = decides(cut, shape, direction, point, error);
    if (decided != core::Value::yes) return decided;
    for (Sphere& known : spheres_) {
        if (known.cut != &cut) continue;
        const core::Vec3d from_center = point - known.shape.center;
        const double off =
            2.0 * error + 0x1p-48 * (sum_of_sizes(point) + sum_of_sizes(known.shape.center));
        const double within = known.shape.radius - off;
        if (!(within > 0.0) ||
            !(core::squared_length(from_center) < within * within * (1.0 - 0x1p-48)))
            continue;
        std::rotate(spheres_.data(), &known, &known + 1);
        return core::Value::yes;
    }
    return core::Value::unknown;
}

void CutFaces::remember(const CutUnion& cut, core::Solids::Index part) {
    if (part == core::Solids::none) return;
    const core::Solids::Node& node = scene_.solids().node(part);
    if (node.parent != cut.index || node.kind != core::Kind::sphere) return;
    std::rotate(spheres_.begin(), spheres_.end() - 1, spheres_.end());
    spheres_.front() = {&cut, std::get<core::Table<core::Sphere>>(scene_.shapes()).get(node.place)};
}

} // namespace raylane::simd
