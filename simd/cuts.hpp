#pragma once

#include "core/scene/scene.hpp"
#include "simd/scene_view.hpp"

#include <cstdint>
#include <vector>

namespace raylane::simd {

/// Outside of it, normal . point > offset.
struct HalfSpace {
    core::Vec3d normal; ///< of length 1 but for rounding
    double offset;
    double size;         ///< of what the offset has been made of, which is off by 2^-50 of that
    core::ShapeId shape; ///< that has it as a face; no_shape - 1 if none that rays cross
    bool stays;          ///< what starts on the shape, and then is outside, has been so from there
    bool ends_group;     ///< as in CutView
};

/// A union of many that is cut, and how.
struct CutUnion {
    core::Solids::Index index;
    std::vector<HalfSpace> by;
    bool is_all; ///< there is nothing else that the whole solid is made of
};

/// What cuts the parts of unions of many, in the kernels' terms: the planes and boxes beside a
/// union in an intersection, or beside an intersection that has it.
class Cuts {
  public:
    /// Completes the view, whose tables are there. It refers to this.
    void find(const core::Scene& scene, SceneView& view, std::uint32_t slots);

    /// True if rays do not stop at each crossing with the parts of a union.
    bool cuts(core::Solids::Index of_many) const {
        return of_many < number_.size() && number_[of_many] != 0;
    }
    /// The union that a part cuts, if that is all that it does; else null.
    const CutUnion* cut_by(core::Solids::Index part) const {
        return part < cut_by_.size() && cut_by_[part] != 0 ? &unions_[cut_by_[part]] : nullptr;
    }

  private:
    void let_faces_wait(const core::Scene& scene);

    std::vector<CutUnion> unions_;
    std::vector<CutView> views_;
    std::vector<std::uint16_t> number_; // of these, by node of the solids; 0: none
    std::vector<std::uint16_t> cut_by_; // the same, of what only cuts
    std::vector<std::uint16_t> of_block_;
    std::vector<std::uint16_t> only_cut_;
    std::vector<std::uint16_t> waiting_;
};

} // namespace raylane::simd
