#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/structure/atom_colors.hpp"
#include "scenes/formats/structure/atom_radii.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/cut.hpp"
#include "scenes/formats/structure/drawing.hpp"
#include "scenes/formats/structure/drawn_shapes.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <algorithm>
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
    /// Returns false if no atom of the structure is of the look's kinds.
    bool matches_kinds() const {
        return has_kind.empty() || std::find(has_kind.begin(), has_kind.end(), 1) != has_kind.end();
    }
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

/// Adds a layer's atoms and bonds. A bond between two representations that show bonds has a half in
/// the look of each. `file` is the name in messages. Throws BadInput if displacements are missing.
void add_layer(const DrawnAtoms& atoms, const AtomLayer& layer, const std::string& file,
               DrawnShapes& shapes);

} // namespace raylane::scenes
