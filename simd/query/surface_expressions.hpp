#pragma once

#include "simd/query/scene_data.hpp"

#include <array>
#include <deque>
#include <vector>

namespace raylane::simd {

/// The expressions of a scene of few shapes, some of which are parts of solids or visible from one
/// side only, for RefineKernels::first_surfaces.
class SurfaceExpressions {
  public:
    explicit SurfaceExpressions(const SceneData& scene);
    SurfaceExpressions(const SurfaceExpressions&) = delete;
    SurfaceExpressions& operator=(const SurfaceExpressions&) = delete;

    /// Returns true if the expressions are known: false for all other scenes.
    bool any() const { return !nodes_.empty(); }
    SurfaceNodes nodes() const {
        return {nodes_.data(), static_cast<std::uint32_t>(nodes_.size())};
    }

  private:
    static constexpr std::size_t max_numbers = 24;

    SurfaceNode shape_of(core::Kind kind, core::Place place);
    void describe(SurfaceNode& node) const;

    const SceneData& scene_;
    std::vector<SurfaceNode> nodes_;
    std::deque<std::array<double, max_numbers>> numbers_; // of each shape
};

} // namespace raylane::simd
