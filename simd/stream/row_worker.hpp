#pragma once

#include "core/reference/path_lengths.hpp"
#include "core/reference/search.hpp"
#include "core/reference/solid_surfaces.hpp"
#include "simd/query/pair_crossings.hpp"
#include "simd/stream/intake.hpp"
#include "simd/stream/rows.hpp"
#include "simd/threads/arena.hpp"

#include <span>
#include <vector>

namespace raylane::simd {

/// Counts of rows of crossings.
struct CrossingCounters {
    core::OrderCounters order;
    std::uint64_t widened = 0; ///< pairs of ray and shape that needed more than double

    CrossingCounters& operator+=(const CrossingCounters& other) {
        return core::add_counts(*this, other);
    }
};

/// Answers rays with rows of any length, always exactly. For one thread.
class RowWorker {
  public:
    RowWorker(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes);

    /// Each of these appends to the rows. Returns the number of refused rays, as
    /// StreamIntake::refused.
    template <class Real>
    std::size_t crossings(const RayStream<Real>& rays, const CrossingRequest& wanted,
                          CrossingRows& rows, CrossingCounters& counters);
    template <class Real>
    std::size_t path_lengths(const RayStream<Real>& rays, core::Bodies bodies, LengthRows& rows);
    /// Stores the number of crossings of each ray.
    template <class Real>
    std::size_t count_crossings(const RayStream<Real>& rays, std::uint64_t* counts);

  private:
    /// A crossing of one ray, with t in extended precision.
    struct Crossed {
        core::Hit<double> hit;
        core::DoubleDouble t;
        double error;
    };

    template <class Real, class Visit>
    std::size_t for_each_ray(const RayStream<Real>& rays, bool with_normals, const Visit& visit);
    template <class Real, class Visit>
    std::size_t for_each_row(const RayStream<Real>& rays, bool with_normals, const Visit& visit);
    bool list_pairs(std::size_t begin, std::size_t end);
    template <class Real, class Counts>
    bool sort_at_once(const RayStream<Real>& rays, std::size_t lane, const Counts& counts);
    template <class Real>
    bool add_lengths_at_once(const RayStream<Real>& lines, const LoneRay& ray, std::size_t lane,
                             core::Bodies bodies);
    template <class Real>
    void add_keys(const RayStream<Real>& rays, std::size_t lane, const CrossingRequest& wanted,
                  CrossingRows& rows);
    template <class Real>
    core::Vec3f normal_of(const RayStream<Real>& rays, std::size_t lane, std::size_t k);
    core::Hit<double> hit_at(std::size_t k) const;
    core::Crossing<double> crossing_at(std::size_t k, const core::DoubleDouble& t) const;
    template <class Real>
    bool is_seen(const RayStream<Real>& rays, std::size_t lane, std::size_t k);
    template <class Counts>
    void find(const LoneRay& ray, std::size_t lane, const Counts& counts);
    void sort(const LoneRay& ray);
    bool are_surely_in_order() const;
    void leave_one_of_polygons();
    void find_lengths(LoneRay ray, std::size_t lane, core::Bodies bodies);
    void add(const LoneRay& ray, const CrossingRequest& wanted, CrossingRows& rows);
    void add_at_one_t(const LoneRay& ray, std::span<const Crossed> group, std::size_t most,
                      const CrossingRequest& wanted, CrossingRows& rows);

    static constexpr std::size_t at_a_time = 1024;      // rays
    static constexpr std::size_t max_pairs = 1U << 18U; // of several rays at a time

    const SceneData& scene_;
    Tracing tracing_;
    core::SolidSurfaces solid_surfaces_;
    core::PathLengths lengths_;
    core::Searcher<double> searcher_;
    StreamIntake intake_;
    CandidateSearch search_;
    float* t_limit_ = nullptr;
    Arena arena_;

    PairCrossings pairs_;

    struct Key {
        double t;
        std::uint32_t crossing;
    };
    std::vector<Key> keys_;                 // of one ray, in order
    std::vector<Crossed> crossed_, sorted_; // likewise
    std::vector<core::SharpHit> sharp_;
    std::vector<std::uint32_t> order_;
    std::vector<core::Hit<double>> hits_;
    std::vector<core::SolidCrossing> solid_crossings_;
    std::vector<core::BodyLength> lengths_found_;
    CrossingCounters counters_;
};

} // namespace raylane::simd
