#pragma once

#include "core/shapes/types.hpp"

#include <vector>

/// Polygons that planes cut, on their way to triangles.
namespace raylane::scenes {

/// A corner, with the normal of the surface there, of any length.
struct PolygonCorner {
    core::Vec3d at{0.0};
    core::Vec3d normal{0.0};
};

/// The corners of a convex polygon, in order.
using Polygon = std::vector<PolygonCorner>;

Polygon polygon_of(const core::SmoothTriangle& triangle);

/// Returns the part of a polygon with dot(normal, p) <= offset. An edge is cut in the same point
/// from both of its sides.
Polygon clipped(const Polygon& polygon, const core::Vec3d& normal, double offset);

/// Returns the part of a convex body with dot(normal, p) <= offset, and its face on that plane. The
/// body may lack the walls between itself and its neighbours. A flat body gets no face.
std::vector<Polygon> clipped(const std::vector<Polygon>& body, const core::Vec3d& normal,
                             double offset);

/// Returns polygons as triangles with an area, in floats. Normals need a length above 0.
std::vector<core::SmoothTriangle> smooth_triangles_of(const std::vector<Polygon>& polygons);
std::vector<core::Triangle> triangles_of(const std::vector<Polygon>& polygons);

} // namespace raylane::scenes
