#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/structure/atom_colors.hpp"
#include "scenes/formats/structure/atom_radii.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/cut.hpp"
#include "scenes/formats/structure/drawing.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace raylane::scenes {

struct DrawnAtoms;

/// A look of the atoms of a representation.
struct AtomLayer {
    std::size_t representation; ///< index
    std::string option;         ///< in messages about the style
    Look look;                  ///< with a style and an opacity
    AtomColors colors;
    AtomRadii radii;
    std::vector<char> has_kind = {}; ///< by kind; empty: the look is that of all kinds

    /// Returns true if an atom of the structure has the look.
    bool has(const DrawnAtoms& atoms, AtomIndex atom) const;
};

/// The parts of a drawing that its layers share.
struct DrawnAtoms {
    static constexpr std::uint16_t hidden = 65535;

    const Structure& structure;
    std::vector<std::uint16_t> representations = {}; ///< of each atom: index, or `hidden`
    std::vector<char> shows_bonds = {};              ///< by representation
    Finish finish = Finish::usual;
    Ellipsoids ellipsoids = Ellipsoids::none;
    double deviations = 0.0;              ///< length of ellipsoids' semi-axes.
    core::Vec3d to_camera{0.0};           ///< from the atoms
    std::vector<core::Vec3f> images = {}; ///< positions of the cells
    /// Images of the atoms side by side, if there are several or if the file has bonds, or the
    /// atoms that fill a crystal's cells.
    std::optional<Structure> repeated = {};
    std::vector<AtomIndex> originals = {}; ///< of a crystal's atoms; empty: see original()
    std::size_t complete = 0;     ///< the first atoms of all(), this many, have all of their bonds
    std::vector<Bond> bonds = {}; ///< of all(); may be empty if no representation shows bonds
    std::vector<CutPlane> cuts = {};

    const Structure& all() const { return repeated ? *repeated : structure; }
    /// Returns the atom of which this one is an image.
    AtomIndex original(AtomIndex atom) const {
        return originals.empty() ? atom % static_cast<AtomIndex>(structure.size())
                                 : originals[atom];
    }
    /// Calls visit(atom, position) for all images of all atoms.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (AtomIndex i = 0; i < originals.size(); ++i)
            visit(originals[i], repeated->positions[i]);
        if (!originals.empty()) return;
        for (AtomIndex atom = 0; atom < structure.size(); ++atom)
            for (const core::Vec3f& image : images)
                visit(atom, structure.positions[atom] + image);
    }
    bool shows_bonds_of(AtomIndex atom) const {
        const std::uint16_t representation = representations[atom];
        return representation != hidden && shows_bonds[representation] != 0;
    }
};

/// Solids of several shapes of a drawing. Transparent shapes of one style and opacity are one
/// solid, as a molecule has no walls inside. Opaque shapes of one material that planes cut are one,
/// as faces that coincide are slow.
class SharedSolids {
  public:
    /// Adds a part, which has a material.
    void add(Style style, float opacity, core::Solid part, const AtomPair& atoms) {
        One& one = solids_[{style, opacity}];
        one.atoms.insert(one.atoms.end(), core::count_parts(part), atoms);
        one.solid.parts.push_back(std::move(part));
    }
    /// Adds an opaque shape that planes cut.
    void add_cut(core::Solid solid, const AtomPair& atoms) {
        One& one = cut_[solid.material];
        one.atoms.push_back(atoms);
        one.solid.parts.push_back(std::move(solid));
    }
    /// Moves the solids into a builder. `cuts`: the planes. `atoms_of_shape`, unless null, receives
    /// their atoms.
    void add_to(core::SceneBuilder& builder, std::span<const CutPlane> cuts,
                std::vector<AtomPair>* atoms_of_shape);

  private:
    struct One {
        core::Solid solid{.made = core::Made::by_union};
        std::vector<AtomPair> atoms;
    };
    std::map<std::pair<Style, float>, One> solids_;
    std::map<core::MaterialIndex, One> cut_;
};

/// Adds the part of a shape that the cuts keep to a builder, or to `shared`.
template <class Shape>
void add_drawn(const Shape& shape, core::MaterialIndex material, const AtomPair& atoms,
               const AtomLayer& layer, std::span<const CutPlane> cuts, core::SceneBuilder& builder,
               SharedSolids& shared, std::vector<AtomPair>* atoms_of_shape) {
    const auto through = planes_through(shape, cuts);
    if (!through) return;
    // Triangles enclose nothing by themselves, so they are not parts of solids.
    if constexpr (!core::AnyTriangle<Shape>) {
        core::Solid solid{.shape = core::to_doubles(shape), .material = material};
        if (*layer.look.opacity < 1.0F)
            return shared.add(
                *layer.look.style, *layer.look.opacity,
                through->empty() ? std::move(solid) : cut_by(std::move(solid), *through), atoms);
        if (!through->empty()) return shared.add_cut(std::move(solid), atoms);
    }
    builder.add(shape, material);
    if (atoms_of_shape != nullptr) atoms_of_shape->push_back(atoms);
}

/// Adds a layer's atoms and bonds to a builder, or to `shared`. A bond between two
/// representations that show bonds has a half in the look of each. `file` is the name in messages.
/// `atoms_of_shape`, unless null, receives the atoms of each shape. Throws BadInput if
/// displacements are missing.
void add_layer(const DrawnAtoms& atoms, const AtomLayer& layer, const std::string& file,
               core::SceneBuilder& builder, SharedSolids& shared,
               std::vector<AtomPair>* atoms_of_shape);

} // namespace raylane::scenes
