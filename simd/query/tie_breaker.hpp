#pragma once

#include "core/reference/search.hpp"
#include "simd/query/paths.hpp"
#include "simd/tracing.hpp"

#include <optional>

namespace raylane::simd {

/// Says which crossing comes first where a method that certifies nothing cannot tell two apart: as
/// everywhere, what is entered before what is left, then the lower id. The scalar formulas have the
/// kernels' bits, so it sees the same t. To be used by one thread.
class TieBreaker {
  public:
    TieBreaker(const SceneData& scene, const Tracing& tracing);

    /// Slot of the first shape of all that the lane's ray crosses at t, in float; `found` if there
    /// is none.
    std::uint32_t first_at(float t, const Paths& paths, std::size_t lane, std::uint32_t found);

    /// First crossing of all, in double, where candidates in float are too close, and whether there
    /// are others at the same t.
    struct First {
        core::Hit<double> hit;
        bool is_alone;
    };
    First first_of(const Paths& paths, std::size_t lane);

  private:
    const SceneData& scene_;
    std::optional<core::Searcher<float>> in_float_;
    std::optional<core::Searcher<double>> in_double_;
};

} // namespace raylane::simd
