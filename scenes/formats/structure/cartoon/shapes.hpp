#pragma once

#include "core/shapes/types.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <functional>
#include <variant>

namespace raylane::scenes {

using CartoonShape =
    std::variant<core::SmoothTriangle, core::Sphere, core::CappedCylinder, core::Box>;

/// Returns the shape at another place.
inline core::SmoothTriangle moved(core::SmoothTriangle shape, const core::Vec3f& by) {
    for (core::Vec3f* corner : {&shape.a, &shape.b, &shape.c})
        *corner += by;
    return shape;
}
inline core::Sphere moved(core::Sphere shape, const core::Vec3f& by) {
    shape.center += by;
    return shape;
}
inline core::CappedCylinder moved(core::CappedCylinder shape, const core::Vec3f& by) {
    shape.base += by;
    return shape;
}
inline core::Box moved(core::Box shape, const core::Vec3f& by) {
    shape.corner += by;
    return shape;
}

/// Receives the shapes of a cartoon, each with the atom that stands for its residue.
using AddShape = std::function<void(const CartoonShape& shape, AtomIndex atom)>;
/// Returns true for the atoms whose residues are drawn.
using IsDrawn = std::function<bool(AtomIndex atom)>;

} // namespace raylane::scenes
