#pragma once

#include "core/scene/film.hpp"
#include "core/scene/outline.hpp"
#include "simd/first_hits/first_hits.hpp"

namespace raylane::simd {

/// Draws the lines of an outline over a region of an image. To be used by one thread.
///
/// Edges are searched between neighbouring points of a grid finer than the pixels. The share of a
/// point's square that a line covers follows from its distance to the nearest edge. So lines are as
/// smooth as the grid allows, and have the requested width in any image.
class Outlines {
  public:
    Outlines(FirstHits& tracer, const core::Outline& outline);

    void draw(const core::Region& region, core::Film& film);

    /// Points on a pixel's side.
    static constexpr int per_pixel = 4;

  private:
    bool find_edges();
    void find_distances();
    void find_distances_in(int row);
    double hidden_at(int column, int row) const;
    bool is_edge(const FirstHit& a, const FirstHit& b) const;
    bool is_crease(const FirstHit& a, const FirstHit& b) const;

    FirstHits& tracer_;
    core::Outline outline_;
    double max_bend_; // cosine of the angle
    double radius_;   // of a line, in points
    int reach_;       // distance in points from a line's middle at which the line has ended

    // The points around a region. An edge is in the middle between two of them, so edges have rows
    // at the points' rows and in between.
    int columns_ = 0, rows_ = 0;
    std::vector<FirstHit> hits_;
    // By row of edges and column of points: an edge here or behind.
    std::vector<std::uint8_t> edges_;
    // Distance along the row to its nearest edge, in halves of the points' spacing.
    std::vector<int> aside_;
};

} // namespace raylane::simd
