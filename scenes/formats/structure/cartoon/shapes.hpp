#pragma once

#include "core/shapes/types.hpp"
#include "scenes/formats/structure/cartoon/path.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <functional>
#include <variant>
#include <vector>

namespace raylane::scenes {

/// The surface of a short piece of a ribbon, which is about convex, without the walls to the pieces
/// before and behind it.
using RibbonPiece = std::vector<core::SmoothTriangle>;
using CartoonShape = std::variant<RibbonPiece, core::Sphere, core::CappedCylinder, core::Box>;

/// Returns the shape at another place.
inline RibbonPiece moved(RibbonPiece piece, const core::Vec3f& by) {
    for (core::SmoothTriangle& triangle : piece)
        for (core::Vec3f* corner : {&triangle.a, &triangle.b, &triangle.c})
            *corner += by;
    return piece;
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

/// Half of the widths and thicknesses of ribbons, in angstrom.
struct RibbonSizes {
    double coil = 0.22; ///< the radius of round tubes
    double helix_width = 1.25, helix_thickness = 0.22;
    double strand_width = 1.15, strand_thickness = 0.24, arrow_width = 1.9;
};

/// Adds a path as triangles: coils as round tubes, helices as ribbons with round edges, strands as
/// ribbons with square edges and an arrow. Coils and helices are one surface without a seam. The
/// distance of triangles from the surface is about `max_error` at most, in angstrom. Their normals
/// are those of the surface, from its derivatives, in double. Only pieces whose atoms are drawn are
/// added, each with closed ends.
void add_ribbon(const Path& path, const RibbonSizes& sizes, double max_error,
                const IsDrawn& is_drawn, const AddShape& add);

/// Adds a path like add_ribbon(), with a cylinder for each helix of at least four residues: along
/// its axis, which is fitted to the means of four consecutive points. A bent helix gets several
/// cylinders that meet, so that no mean is further than 1 angstrom from an axis.
void add_with_cylinders(const Path& path, const RibbonSizes& sizes, double max_error,
                        const IsDrawn& is_drawn, const AddShape& add);

/// Adds a round tube along the spline through a path's points, as capped cylinders with spheres
/// where they meet. Consecutive cylinders differ by less than 5 degrees in direction, except in
/// turns of more than 160 degrees between two points.
void add_tube(const Path& path, double radius, const IsDrawn& is_drawn, const AddShape& add);

/// Adds a straight cylinder between consecutive points, half of it for each, and spheres at the
/// points.
void add_trace(const Path& path, double radius, const IsDrawn& is_drawn, const AddShape& add);

/// Adds the bases of drawn nucleotides: a box around the rings of each, and a rod from C1' or the
/// base to the nearest point of the backbone's path. Returns the number of drawn nucleotides with
/// less than six atoms of rings, which get no box.
std::size_t add_bases(const Structure& structure, const Segment& segment, const Path& path,
                      const IsDrawn& is_drawn, const AddShape& add);

} // namespace raylane::scenes
