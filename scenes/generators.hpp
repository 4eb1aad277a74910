#pragma once

#include "core/scene/scene.hpp"

/// Shapes that are quicker said than listed. Positions are computed in double and rounded once.
/// All functions throw core::InvalidValue, whose fields are the arguments' names.
namespace raylane::scenes {

struct Sphereflake {
    core::Vec3f center;
    float radius;                     ///< of the middle sphere
    int depth;                        ///< 0: that sphere alone; most_depth: 48 million of them
    core::Vec3f up{0.0F, 0.0F, 1.0F}; ///< direction of the first three, any length but zero

    static constexpr int most_depth = 8;
};

/// The "balls" of the Standard Procedural Databases (Haines 1987): each sphere bears nine of a
/// third of its radius, which touch it: three around its tip, six around its waist. The tip of each
/// of these points away from the sphere that bears it.
void add(core::SceneBuilder& builder, const Sphereflake& flake, core::MaterialIndex material);

struct Lattice {
    core::Vec3d corner;  ///< the node with the least coordinates
    int n;               ///< nodes a side, up to most_nodes
    float spacing;       ///< from node to node, > 0
    float sphere_radius; ///< of the sphere at each node, > 0
    float strut_radius;  ///< of the open cylinder between each two neighbours, > 0

    static constexpr int most_nodes = 256;
};

/// The number of shapes. Throws core::InvalidValue for a depth or a number of nodes out of range.
std::size_t count_of(const Sphereflake& flake);
std::size_t count_of(const Lattice& lattice);

/// n^3 spheres on a cubic grid, then 3 n^2 (n - 1) struts.
void add(core::SceneBuilder& builder, const Lattice& lattice, core::MaterialIndex material,
         core::MaterialIndex strut_material);

} // namespace raylane::scenes
