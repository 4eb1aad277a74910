#pragma once

#include "simd/query/candidate_resolver.hpp"
#include "simd/query/hits.hpp"
#include "simd/query/search.hpp"
#include "simd/query/tie_breaker.hpp"

#include <optional>
#include <span>

namespace raylane::simd {

/// Second step of the search for hits: solves the shape that may be the nearest, and decides where
/// that is not certain. With core::Precision::exact, a CandidateResolver decides. In double without
/// bounds, a TieBreaker decides, and so it does in float where t is the same.
class Certifier {
  public:
    Certifier(const SceneData& scene, const Tracing& tracing, Asked asked);

    void take_from(Arena& arena, std::size_t capacity);

    /// Solves crossings of rays with the shape that they leave, if they may cross it again. Filters
    /// cannot distinguish these from the rays' starts, so they are solved before the search, and
    /// limit the other candidates.
    void find_own_exits(const Paths& paths, const CandidateSearch& search,
                        const Candidates& candidates);
    /// Decides the hits of rays after a search. On entry, hits.slot holds the candidates' slots.
    void certify(const Paths& paths, CandidateSearch& search, const Candidates& candidates,
                 const Hits& hits, EngineCounters& counters);

    /// Does all of this at once in a scene of few shapes, with a method that certifies nothing.
    void find_of_few(const Paths& paths, const Candidates& candidates, const Hits& hits,
                     EngineCounters& counters);

    /// Returns true if the lane's hit was not certain at first.
    bool was_refined(std::size_t lane) const { return refined_[lane] != 0; }
    /// Lanes of the last rays; see Query.
    std::span<const std::uint32_t> at_contacts() const { return {at_contacts_, contact_count_}; }
    std::span<const HitPoint> points() const { return resolver_.points(); }

  private:
    std::span<const std::uint32_t> break_ties(const Paths& paths, const Candidates& candidates,
                                              const Hits& hits);
    void solve_one(const Paths& paths, std::uint32_t lane, const Hits& hits);
    void compare_in_double(const Paths& paths, std::span<const std::uint32_t> lanes,
                           const Hits& hits, EngineCounters& counters);
    void solve(Found found) const;

    const SceneData& scene_;
    Tracing tracing_;
    Asked asked_;
    std::optional<TieBreaker> tie_breaker_; // without a CandidateResolver
    CandidateResolver resolver_;

    std::uint8_t* doubtful_ = nullptr; // lanes in doubt whatever the search finds
    std::uint8_t* refined_ = nullptr;
    std::uint32_t* at_contacts_ = nullptr;
    std::size_t contact_count_ = 0;
    // Some of the rays, gathered for kernels.
    Paths gathered_{};
    Hits gathered_hits_{};
    std::uint32_t* lanes_ = nullptr;
    std::size_t own_exit_count_ = 0; // the first gathered rays, until others replace them
};

} // namespace raylane::simd
