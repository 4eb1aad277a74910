#pragma once

#include "core/shapes/shapes.hpp"
#include "core/solids/solid.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <variant>

/// Cuts through atoms. Cut shapes are solids, whose faces on the plane have their material.
namespace raylane::scenes {

/// Keeps the points p with dot(normal, p) <= offset.
struct CutPlane {
    core::Vec3d normal{0.0};
    double offset = 0.0; ///< in angstrom, times the normal's length
};

/// Parses "z<1.5", "x > 0" or "A,B,C,D", which keeps A x + B y + C z <= D. Throws BadInput.
CutPlane cut_plane_of(const std::string& option, const std::string& text);

/// Parses the depths of a slab, "A B" or "A:B", in angstrom. Throws BadInput.
std::pair<double, double> depths_of(const std::string& option, const std::string& text);

/// Returns the range of dot(normal, p) over a box.
std::pair<double, double> range_along(const core::Vec3d& normal, const core::Bounds& bounds);

/// Returns the half-space of a plane, as a part of a solid.
inline core::Solid half_space_of(const CutPlane& plane, core::MaterialIndex material) {
    const double size = core::dot(plane.normal, plane.normal);
    core::Solid part =
        core::of_shape(core::PlaneOf<double>{(plane.offset / size) * plane.normal, plane.normal});
    part.material = material;
    return part;
}

/// Returns the part of a shape that all planes keep: nothing, the shape itself, or a solid.
template <class Shape>
std::optional<std::variant<Shape, core::Solid>>
kept_part(const Shape& shape, std::span<const CutPlane> planes, core::MaterialIndex material) {
    std::optional<core::Solid> solid;
    for (const CutPlane& plane : planes) {
        const auto [least, most] = range_along(plane.normal, core::bounds_of(shape));
        if (least > plane.offset) return std::nullopt;
        if (most <= plane.offset) continue;
        if constexpr (core::AnyTriangle<Shape>) { // encloses nothing
            if (least + most > 2.0 * plane.offset) return std::nullopt;
        } else {
            if (!solid) {
                solid.emplace(core::Solid{.made = core::Made::by_intersection});
                solid->parts.push_back(core::of_shape(core::to_doubles(shape)));
                solid->parts.back().material = solid->material = material;
            }
            solid->parts.push_back(half_space_of(plane, material));
        }
    }
    if (solid) return *std::move(solid);
    return shape;
}

} // namespace raylane::scenes
