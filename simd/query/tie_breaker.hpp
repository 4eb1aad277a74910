#pragma once

#include "core/reference/search.hpp"
#include "simd/query/paths.hpp"
#include "simd/query/tracing.hpp"

#include <optional>

namespace raylane::simd {

/// Decides which crossing comes first where a method that certifies nothing cannot distinguish two.
/// The order is the usual one: entering precedes leaving, then the lower id precedes. The scalar
/// formulas give the kernels' bits, so it sees the same t. To be used by one thread.
class TieBreaker {
  public:
    TieBreaker(const SceneData& scene, const Tracing& tracing);

    /// Returns the slot of the first shape that the lane's ray crosses at t, in float, or `found`
    /// if it crosses none.
    std::uint32_t first_at(float t, const Paths& paths, std::size_t lane, std::uint32_t found);

    /// First crossing in double, for lanes whose float candidates are too close. `is_alone`: no
    /// other crossing has the same t.
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
