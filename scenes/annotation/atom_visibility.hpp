#pragma once

#include "core/reference/search.hpp"
#include "scenes/annotation/annotations.hpp"

#include <optional>
#include <vector>

namespace raylane::scenes {

/// Finds the copies of atoms, and whether the camera sees them.
class AtomVisibility {
  public:
    /// Both must outlive it.
    AtomVisibility(const Legend& legend, const AnnotatedView& view);

    /// Returns the places of an atom's copies, that in the first cell first.
    std::vector<core::Vec3d> places_of(AtomIndex atom) const;

    /// Returns false if opaque shapes of other atoms, or of other copies, hide a place of some
    /// atoms. Places of atoms without shapes are visible.
    bool is_visible(const std::vector<AtomIndex>& atoms, const core::Vec3d& place);

  private:
    bool is_of(core::ShapeId shape, const std::vector<AtomIndex>& atoms) const;
    bool is_nearest_copy(const std::vector<AtomIndex>& atoms, const core::Vec3d& place,
                         const core::Vec3d& point) const;

    const Legend& legend_;
    const AnnotatedView& view_;
    std::vector<char> has_shape_; // by atom; empty: nothing is hidden
    std::optional<core::Searcher<double>> searcher_;
};

} // namespace raylane::scenes
