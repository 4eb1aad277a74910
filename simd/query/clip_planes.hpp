#pragma once

#include "core/scene/scene.hpp"
#include "simd/units/scene_view.hpp"

#include <cstdint>
#include <vector>

namespace raylane::simd {

/// Half-space. Outside of it, normal . point > offset.
struct HalfSpace {
    core::Vec3d normal; ///< of length 1 except for rounding
    double offset;
    double size;         ///< of the terms of the offset, whose error is at most 2^-50 of that
    core::ShapeId shape; ///< that has it as a face; no_shape - 1 if rays cross no such shape
    /// If a ray that starts on the shape is outside of the half-space later, it has been outside of
    /// it since its start.
    bool stays;
    bool ends_group; ///< as in ClipPlanesView
};

/// Union of many parts that is cut, and its clip planes: the half-spaces that cut it.
struct CutUnion {
    core::Solids::Index index;
    std::vector<HalfSpace> by;
    bool is_all; ///< the whole solid consists of nothing else
};

/// Finds the clip planes of unions of many parts, and owns them in the kernels' format. A union is
/// cut by planes and boxes beside it in an intersection, or beside an intersection that contains
/// it.
class ClipPlanes {
  public:
    /// Completes `view`, whose tables must be set. The view then refers to this object.
    void find(const core::Scene& scene, SceneView& view, std::uint32_t slots);

    /// Returns true if a union is cut, so that rays do not stop at each crossing with its parts.
    bool cuts(core::Solids::Index of_many) const {
        return of_many < number_.size() && number_[of_many] != 0;
    }
    /// Returns the union that a part cuts, if the part does nothing else; otherwise null.
    const CutUnion* cut_by(core::Solids::Index part) const {
        return part < cut_by_.size() && cut_by_[part] != 0 ? &unions_[cut_by_[part]] : nullptr;
    }

  private:
    void let_faces_wait(const core::Scene& scene);

    std::vector<CutUnion> unions_;
    std::vector<ClipPlanesView> views_;
    std::vector<std::uint16_t> number_; // index in unions_ by node of the solids; 0: not cut
    std::vector<std::uint16_t> cut_by_; // the same of the union that a part cuts, if it only cuts
    std::vector<std::uint16_t> of_block_;
    std::vector<std::uint16_t> only_cut_;
    std::vector<std::uint16_t> deferred_;
};

} // namespace raylane::simd
