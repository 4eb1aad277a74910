#pragma once

#include "core/scene/formula.hpp"
#include "core/shapes/ray.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/object_space.hpp"

namespace raylane::core {

/// Returns the coordinates of a point on the surface of a shape. Turns are from 0 to 1. They are
/// counter-clockwise seen from the end of the axis, and begin at +x if the axis is +y.
///
///   sphere, ellipsoid   u: turn about +y (an ellipsoid's axis_v), v: latitude, 0 to 1.
///   cylinder, cone      u: turn about the axis, v: 0 at the base, 1 at the top.
///   plane               lengths: v upwards (+y; on floors -z), u to the right of it.
///   disc                the same in radii, from the center.
///   triangle            weights of the corners b and c.
///   box                 fractions of the two edges of the face, in the cyclic order of the edges
///   quadric             0
///
/// `space`: the space of the object, if transforms moved it; "+y" and lengths are then those of
/// that space. `pole`: in place of +y for spheres and ellipsoids, of any length but zero; turns are
/// then those about a cylinder with this axis.
ShapeCoordinates coordinates_on(const Tables& shapes, Kind kind, Place place, Face face,
                                const Vec3d& point, const ObjectSpace* space = nullptr,
                                const Vec3d& pole = Vec3d(0.0, 1.0, 0.0));

} // namespace raylane::core
