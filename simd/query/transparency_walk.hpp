#pragma once

#include "core/reference/search.hpp"
#include "simd/query/cut_faces.hpp"
#include "simd/query/query.hpp"
#include "simd/query/union_skipper.hpp"

#include <memory>
#include <vector>

namespace raylane::simd {

/// Third step of the search for hits, for images: rays pass surfaces that are invisible from their
/// side, and parts of solids where these have no surface. Hits have the form Asked::points.
class TransparencyWalk {
  public:
    TransparencyWalk(const SceneData& scene, const Tracing& tracing);

    void take_from(Arena& arena, std::size_t capacity);

    /// Finds the nearest hits, as Query does.
    void nearest(const Paths& paths, const Coherence* coherence, EngineCounters& counters);
    const Hits& hits() const { return query_.hits(); }
    std::span<const std::uint32_t> at_contacts() const { return at_contacts_; }
    std::span<const HitPoint> points() const { return points_; }
    core::Vec3d point_of(const Paths& paths, std::size_t lane) const;

    /// Returns the query to which all surfaces are visible.
    Query& query() { return query_; }

  private:
    void leave_near_surfaces(const Paths& paths);
    void go_on(const Paths& paths, const Coherence* coherence, EngineCounters& counters);
    bool is_visible(const Paths& paths, const Hits& hits, std::size_t lane, core::WayInUnion& way);
    bool is_apart(const Query& query, const Paths& paths, std::size_t lane);
    void settle(const Paths& paths, std::size_t lane);
    bool fills_first(const Paths& paths, const Hits& hits, std::size_t lane,
                     core::ShapeId shape) const;
    core::Value is_cut_face(const Paths& paths, const Hits& hits, std::size_t lane,
                            core::ShapeId shape, const CutUnion& cut);
    void move_on(const Hits& hits, std::size_t lane, std::size_t to);

    const SceneData& scene_;
    bool is_exact_;
    Query query_;
    std::vector<std::uint32_t> at_contacts_;
    std::vector<HitPoint> points_;

    core::SolidSurfaces solid_surfaces_;
    CutFaces cut_faces_;
    std::vector<core::WayInUnion> ways_; // of rays that go on

    // Search behind invisible surfaces; null if rays pass no surface.
    std::unique_ptr<Query> onward_;
    std::unique_ptr<core::Searcher<double>> searcher_; // for surfaces too close to start between
    std::unique_ptr<UnionSkipper> skipper_;            // null without unions of many
    Paths onward_paths_{};                             // `sample` is the lane
    double* passed_ = nullptr;
};

} // namespace raylane::simd
