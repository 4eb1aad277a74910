#pragma once

#include "raylane/raylane.h"
#include "raylane/raylane.hpp"
#include "scenes/api/cpp/convert.hpp"

#include <string>
#include <utility>

/// Calls call(shapes, shape, Shape, c_shape) for each type of shapes: the words for several and for
/// one in the names of functions, the type of C++, and the struct's word.
#define RAYLANE_C_SHAPES(call)                                                                     \
    call(spheres, sphere, Sphere, sphere) call(planes, plane, Plane, plane)                        \
        call(discs, disc, Disc, disc) call(triangles, triangle, Triangle, triangle)                \
            call(smooth_triangles, smooth_triangle, SmoothTriangle, smooth_triangle)               \
                call(boxes, box, Box, box)                                                         \
                    call(open_cylinders, open_cylinder, OpenCylinder, cylinder)                    \
                        call(capped_cylinders, capped_cylinder, CappedCylinder, cylinder)          \
                            call(open_cones, open_cone, OpenCone, cone)                            \
                                call(capped_cones, capped_cone, CappedCone, cone)                  \
                                    call(quadrics, quadric, Quadric, quadric)                      \
                                        call(ellipsoids, ellipsoid, Ellipsoid, ellipsoid)

/// Conversions between the values of the C++ library and those of the C interface. Enumerators have
/// the same numbers on both sides, and the library rejects invalid ones.
namespace raylane::c {

using library::converted;

/// Converts a material, and keeps the texts of its formula and its image until the thread's next
/// call.
inline raylane_material kept_in_c(Material material) {
    thread_local Material kept; // NOLINT: owns the texts
    kept = std::move(material);
    return converted<raylane_material>(kept);
}

/// Converts an enumerator from an int. Throws InvalidValue outside of 0 to 255; the library rejects
/// other invalid ones.
template <class Enum>
Enum enum_from_int(const char* name, int number) {
    if (number < 0 || number > 255)
        throw InvalidValue(name, "must be one of its enumerators, got " + std::to_string(number));
    return static_cast<Enum>(number);
}

} // namespace raylane::c
