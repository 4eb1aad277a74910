#pragma once

#include "core/shapes/shapes.hpp"
#include "core/solids/solid.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Cuts through atoms. Cut shapes are solids, whose faces on the plane have their material.
namespace raylane::scenes {

/// Keeps the points p with dot(normal, p) <= offset.
struct CutPlane {
    core::Vec3d normal{0.0};
    double offset = 0.0; ///< in angstrom, times the normal's length
};

/// Parses "z<1.5", "x > 0" or "A,B,C,D", which keeps A x + B y + C z <= D. Throws BadInput.
CutPlane cut_plane_of(const std::string& option, const std::string& text);

/// Returns the range of dot(normal, p) over a box.
std::pair<double, double> range_along(const core::Vec3d& normal, const core::Bounds& bounds);

/// Returns the part of a solid that all planes keep. Its faces on them have the solid's material.
core::Solid cut_by(core::Solid solid, std::span<const CutPlane> planes);

/// Returns the planes that cross a shape, or nothing if one of them removes it. Triangles enclose
/// nothing, so they are kept or removed whole, by their middles.
template <class Shape>
std::optional<std::vector<CutPlane>> planes_through(const Shape& shape,
                                                    std::span<const CutPlane> planes) {
    std::vector<CutPlane> through;
    for (const CutPlane& plane : planes) {
        const auto [least, most] = range_along(plane.normal, core::bounds_of(shape));
        if (least > plane.offset) return std::nullopt;
        if (most <= plane.offset) continue;
        if constexpr (!core::AnyTriangle<Shape>)
            through.push_back(plane);
        else if (least + most > 2.0 * plane.offset)
            return std::nullopt;
    }
    return through;
}

} // namespace raylane::scenes
