#pragma once

#include "core/reference/search.hpp"
#include "simd/wavefront/paths.hpp"
#include "simd/wavefront/scene_data.hpp"

namespace raylane::simd {

/// Says which of the crossings at one t comes first, by the precisions that are float: as
/// everywhere, what is entered before what is left, then the lower id. The scalar formulas have the
/// kernels' bits, so it sees the same t. To be used by one thread.
class TieBreaker {
  public:
    TieBreaker(const SceneData& scene, core::Precision precision)
        : scene_(scene), searcher_(scene.scene(), core::Search::hierarchy, precision) {}

    /// The slot of the first shape of all that the lane's ray crosses at t; `found` if there is
    /// none.
    std::uint32_t first_at(float t, const Paths& paths, std::size_t lane, std::uint32_t found);

  private:
    const SceneData& scene_;
    core::Searcher<float> searcher_;
};

} // namespace raylane::simd
