#pragma once

#include "core/shapes/bounds.hpp"
#include "core/solids/solid.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Cuts through atoms. Cut shapes are solids, whose faces on the plane have their material.
namespace raylane::scenes {

/// Keeps the points p with dot(normal, p) <= offset.
struct CutPlane {
    core::Vec3d normal{0.0};
    double offset = 0.0;      ///< in angstrom, times the normal's length
    bool from_middle = false; ///< `offset` counts from the middle of the atoms
};

/// Parses "z<1.5", "x > 0" or "A,B,C,D", which keeps A x + B y + C z <= D. The number may be
/// "middle", "middle+1" or "middle-1". Throws BadInput.
CutPlane cut_plane_of(const std::string& option, const std::string& text);

/// Returns the range of dot(normal, p) over a box.
std::pair<double, double> range_along(const core::Vec3d& normal, const core::Bounds& bounds);

/// Returns the part of a solid that all planes keep. Its faces on them have the solid's material.
core::Solid cut_by(core::Solid solid, std::span<const CutPlane> planes);

/// Returns the planes that cross a box, or nothing if one of them removes it.
std::optional<std::vector<CutPlane>> planes_through(const core::Bounds& bounds,
                                                    std::span<const CutPlane> planes);

/// Returns true if all planes keep a point.
bool keep_point(const core::Vec3d& point, std::span<const CutPlane> planes);

} // namespace raylane::scenes
