#pragma once

#include "core/reference/search.hpp"
#include "scenes/formats/structure/structure_file.hpp"

#include <optional>
#include <vector>

namespace raylane::scenes {

/// The atoms that a scene shows, and the places of their copies.
class ShownAtoms {
  public:
    /// The legend must outlive it.
    explicit ShownAtoms(const Legend& legend);

    /// Returns true if an atom has a shape, or if it is in a cartoon and its residue has one.
    bool has(AtomIndex atom) const { return is_shown_.empty() || is_shown_[atom] != 0; }
    /// Returns true if an atom has a shape.
    bool has_shape(AtomIndex atom) const { return !has_shape_.empty() && has_shape_[atom] != 0; }
    /// Returns the places of an atom's copies that are shown, that in the first cell first.
    std::vector<core::Vec3d> places_of(AtomIndex atom) const;

    const Legend& legend() const { return legend_; }

  private:
    const Legend& legend_;
    std::vector<char> has_shape_, is_shown_; // by atom; empty: unknown
};

/// Finds whether a camera sees atoms. All arguments must outlive it.
class AtomVisibility {
  public:
    /// `scene` may be null: nothing is hidden.
    AtomVisibility(const ShownAtoms& atoms, const core::Camera& camera, const core::Scene* scene);

    /// Returns false if opaque shapes of other atoms, or of other copies, hide a place of some
    /// atoms. Places of atoms without shapes are visible.
    bool is_visible(const std::vector<AtomIndex>& atoms, const core::Vec3d& place);

  private:
    bool is_of(core::ShapeId shape, const std::vector<AtomIndex>& atoms) const;
    bool is_nearest_copy(const std::vector<AtomIndex>& atoms, const core::Vec3d& place,
                         const core::Vec3d& point) const;

    const ShownAtoms& atoms_;
    const core::Camera& camera_;
    const core::Scene* scene_;
    std::optional<core::Searcher<double>> searcher_;
};

} // namespace raylane::scenes
