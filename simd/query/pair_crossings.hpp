#pragma once

#include "simd/query/search.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace raylane::simd {

/// All crossings of rays with the shapes that they may cross, with bounds. Crossings 2 k and
/// 2 k + 1 are those of pair k, as in CrossingPairs. For use by one thread.
class PairCrossings {
  public:
    PairCrossings(const SceneData& scene, const Tracing& tracing)
        : scene_(scene), tracing_(tracing) {}

    /// Reserves memory for this many rays at a time.
    void reserve(std::size_t rays);

    /// Lists the pairs of rays, which a search has taken, and of shapes that they may cross before
    /// t_limit, and those that add_own(list) adds. Returns false if they are more than `most`.
    template <class AddOwn>
    bool list(const CandidateSearch& search, const float* t_limit, std::size_t most,
              const AddOwn& add_own) {
        PairList list{};
        do {
            if (list.count > most) return false;
            if (list.count > listed_ray_.size()) {
                listed_ray_.resize(list.count + list.count / 4);
                listed_slot_.resize(listed_ray_.size());
            }
            list = {listed_ray_.data(), listed_slot_.data(), listed_ray_.size(), 0};
            add_own(list);
            search.list_all(t_limit, list);
        } while (list.count > list.room);
        sort(list);
        return true;
    }

    /// Computes the crossings of the listed pairs.
    void cross(const double* const (&origin)[3], const double* const (&direction)[3],
               const double* const (&unit_direction)[3], bool with_normals);

    /// Returns a bound on the difference between a crossing's exact t and `high`.
    double off_by(std::size_t k) const { return (std::abs(low[k]) + error[k]) * (1.0 + 0x1p-50); }

    std::vector<std::uint32_t> first_of_ray; ///< a ray's pairs end at the first of the next ray
    std::vector<std::uint32_t> slot;         ///< of pairs
    std::vector<double> high, low, error;    ///< of crossings
    std::vector<std::uint32_t> bits;
    std::vector<float> normal[3];

  private:
    void sort(const PairList& list);

    const SceneData& scene_;
    Tracing tracing_;
    std::vector<std::uint32_t> listed_ray_, listed_slot_, ray_;
};

} // namespace raylane::simd
