#include "simd/first_hits/outlines.hpp"

#include "core/numbers/elementary.hpp"
#include "core/numbers/infinity.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::simd {

namespace {

core::Vec3d point_of(const FirstHit& hit) {
    return core::mul_add(hit.t, hit.ray.direction, hit.ray.origin);
}

/// Returns the distance of a hit from the plane that touches a surface at another hit.
double from_plane(const FirstHit& hit, const FirstHit& other) {
    return std::abs(core::dot(other.flat_normal, core::Vec3d(point_of(hit) - point_of(other))));
}

/// Returns t where a ray crosses the plane that touches a surface at its hit, or infinity if the
/// ray never reaches the hidden side.
double t_of_plane(const FirstHit& hit, const core::Ray<double>& ray) {
    const double slope = core::dot(hit.flat_normal, ray.direction);
    if (!(slope < 0.0)) return core::infinity<double>;
    return core::dot(hit.flat_normal, core::Vec3d(point_of(hit) - ray.origin)) / slope;
}

/// Returns the distance between the points of two rays at the depth of the nearer hit.
double spacing(const FirstHit& a, const FirstHit& b) {
    const double t = std::min(a.t, b.t);
    return core::length(core::Vec3d(core::mul_add(t, b.ray.direction, b.ray.origin) -
                                    core::mul_add(t, a.ray.direction, a.ray.origin)));
}

/// Returns true if one hit is in front of the other: if, by the planes that touch the surfaces
/// there, the same hit is the nearer one on both rays, by more than a pixel. The planes cross if
/// surfaces meet or one is bent between the rays, however steep they are. Next to each other on a
/// steep mesh are facets that do not touch; they are less than a pixel apart across their planes.
bool is_step(const FirstHit& a, const FirstHit& b) {
    const double along_a = a.t - t_of_plane(b, a.ray), along_b = t_of_plane(a, b.ray) - b.t;
    if ((along_a < 0.0) != (along_b < 0.0)) return false;
    const double least = Outlines::per_pixel * spacing(a, b);
    if (!(std::min(std::abs(along_a), std::abs(along_b)) > least)) return false;
    return std::max(from_plane(a, b), from_plane(b, a)) > least;
}

} // namespace

Outlines::Outlines(FirstHits& tracer, const core::Outline& outline)
    : tracer_(tracer), outline_(outline) {
    constexpr double degree = 3.14159265358979323846 / 180.0;
    max_bend_ = core::cos(static_cast<double>(outline.creases) * degree);
    radius_ = 0.5 * per_pixel * static_cast<double>(outline.width);
    reach_ = static_cast<int>(std::ceil(radius_ + 0.5));
}

bool Outlines::is_edge(const FirstHit& a, const FirstHit& b) const {
    if (!a.any() || !b.any()) return a.any() != b.any();
    if (a.shape == b.shape && a.face == b.face && a.flat_normal == b.flat_normal) return false;
    return is_step(a, b) || (outline_.has_creases() && is_crease(a, b));
}

/// Returns true if there is a crease between two hits. A single face is smooth, however much it is
/// bent between points.
bool Outlines::is_crease(const FirstHit& a, const FirstHit& b) const {
    if (a.material != b.material) return true;
    return (a.shape != b.shape || a.face != b.face) &&
           core::dot(a.shading_normal, b.shading_normal) < max_bend_;
}

void Outlines::draw(const core::Region& region, core::Film& film) {
    const core::Region around{region.x0 * per_pixel - reach_, region.y0 * per_pixel - reach_,
                              region.x1 * per_pixel + reach_, region.y1 * per_pixel + reach_};
    columns_ = around.x1 - around.x0;
    rows_ = around.y1 - around.y0;
    tracer_.trace(around, per_pixel, hits_);
    if (!find_edges()) return;
    find_distances();
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) {
            double hidden = 0.0;
            for (int point = 0; point < per_pixel * per_pixel; ++point)
                hidden += hidden_at((x - region.x0) * per_pixel + reach_ + point % per_pixel,
                                    (y - region.y0) * per_pixel + reach_ + point / per_pixel);
            const auto share = static_cast<float>(hidden / (per_pixel * per_pixel));
            if (share == 0.0F) continue;
            film.at(x, y) = (1.0F - share) * film.at(x, y) + share * outline_.color;
            if (film.has_alpha())
                film.alpha_at(x, y) = (1.0F - share) * film.alpha_at(x, y) + share;
        }
}

/// Returns true if there are any edges. Row 2 j has the edges between points of row j, row 2 j + 1
/// those between rows j and j + 1.
bool Outlines::find_edges() {
    const auto columns = static_cast<std::size_t>(columns_);
    bool any = false;
    edges_.assign(2 * columns * static_cast<std::size_t>(rows_), 0);
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column) {
            const FirstHit* const center = &hits_[static_cast<std::size_t>(row) * columns + column];
            std::uint8_t* const edge =
                &edges_[2 * static_cast<std::size_t>(row) * columns + column];
            edge[0] = column + 1 < columns_ && is_edge(center[0], center[1]) ? 1 : 0;
            edge[columns] = row + 1 < rows_ && is_edge(center[0], center[columns]) ? 1 : 0;
            any = any || edge[0] != 0 || edge[columns] != 0;
        }
    return any;
}

void Outlines::find_distances() {
    aside_.resize(edges_.size());
    for (int row = 0; row < 2 * rows_; ++row)
        find_distances_in(row);
}

void Outlines::find_distances_in(int row) {
    const std::uint8_t* const edges = &edges_[static_cast<std::size_t>(row) * columns_];
    int* const aside = &aside_[static_cast<std::size_t>(row) * columns_];
    const int behind = row % 2 == 0 ? 1 : 0; // the edge's offset in halves of the spacing
    const int far = 2 * columns_ + 2 * reach_ + 1;
    int last = -far, next = 2 * columns_ + far;
    for (int column = 0; column < columns_; ++column) {
        if (edges[column] != 0 && behind == 0) last = 2 * column;
        aside[column] = 2 * column - last;
        if (edges[column] != 0) last = 2 * column + behind;
    }
    for (int column = columns_ - 1; column >= 0; --column) {
        if (edges[column] != 0) next = 2 * column + behind;
        aside[column] = std::min(aside[column], next - 2 * column);
    }
}

/// Returns the share of a point's square that a line covers: all, none, or the part on this side of
/// the line's border.
double Outlines::hidden_at(int column, int row) const {
    const int far = 2 * reach_;
    const int end = std::min(2 * row + far, 2 * rows_ - 1);
    int nearest = far * far;
    for (int other = std::max(2 * row - far, 0); other <= end; ++other) {
        const int aside = aside_[static_cast<std::size_t>(other) * columns_ + column];
        nearest = std::min(nearest, aside * aside + (other - 2 * row) * (other - 2 * row));
    }
    const double distance = 0.5 * std::sqrt(static_cast<double>(nearest));
    return std::clamp(radius_ - distance + 0.5, 0.0, 1.0);
}

} // namespace raylane::simd
