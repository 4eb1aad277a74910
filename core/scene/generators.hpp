#pragma once

#include "core/scene/scene.hpp"

/// Generators of shapes that are too many to list. Positions are computed in double and rounded
/// once. All functions throw InvalidValue, whose field is the name of the argument.
namespace raylane::core {

struct Sphereflake {
    Vec3f center;
    float radius;               ///< of the middle sphere
    int depth;                  ///< 0: that sphere alone; max_depth: 48 million spheres
    Vec3f up{0.0F, 0.0F, 1.0F}; ///< direction of the first three; any length except zero

    static constexpr int max_depth = 8;
};

/// Adds the "balls" of the Standard Procedural Databases (Haines 1987). Each sphere bears nine
/// spheres of a third of its radius, which touch it: three around its tip, six around its waist.
/// The tip of each of these points away from the sphere that bears it.
void add(SceneBuilder& builder, const Sphereflake& flake, MaterialIndex material);

struct Lattice {
    Vec3d corner;        ///< the node with the smallest coordinates
    int n;               ///< nodes per side, up to max_nodes
    float spacing;       ///< from node to node, > 0
    float sphere_radius; ///< of the sphere at each node, > 0
    float strut_radius;  ///< of the open cylinder between any two neighbours, > 0

    static constexpr int max_nodes = 256;
};

/// Returns the corner of a lattice of n nodes per side around a centre.
Vec3d corner_around(const Vec3d& center, int n, float spacing);

/// Returns the number of shapes. Throws InvalidValue if the depth or the number of nodes is
/// out of range.
std::size_t count_of(const Sphereflake& flake);
std::size_t count_of(const Lattice& lattice);

/// Adds n^3 spheres on a cubic grid, then 3 n^2 (n - 1) struts.
void add(SceneBuilder& builder, const Lattice& lattice, MaterialIndex material,
         MaterialIndex strut_material);

} // namespace raylane::core
