#include "scenes/formats/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raylane::scenes {

std::span<const Triangulator::Corners>
Triangulator::triangulate(std::span<const core::Vec3f> polygon) {
    triangles_.clear();
    if (polygon.size() >= 3 && project(polygon)) clip_ears();
    return triangles_;
}

/// Fills vertices_ with the polygon, counter-clockwise in the plane. Returns false if it has no
/// area.
bool Triangulator::project(std::span<const core::Vec3f> polygon) {
    // Twice the area of each projection, by the shoelace formula. Its sign must be correct although
    // the formula cancels: a small polygon may be far from the origin.
    std::array<ExactSum, 3> areas;
    const core::Vec3f* previous = &polygon.back();
    for (const core::Vec3f& vertex : polygon) {
        const auto a = core::convert<double>(*previous);
        const auto b = core::convert<double>(vertex);
        for (int axis = 0; axis < 3; ++axis) {
            const int x = (axis + 1) % 3;
            const int y = (axis + 2) % 3;
            areas[axis].add(a[x] * b[y]);
            areas[axis].add(-a[y] * b[x]);
        }
        previous = &vertex;
    }
    const auto largest =
        std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) {
            return std::abs(a.value()) < std::abs(b.value());
        });
    if (largest->sign() == 0) return false;

    const int axis = static_cast<int>(largest - areas.begin());
    int x = (axis + 1) % 3;
    int y = (axis + 2) % 3;
    if (largest->sign() < 0) std::swap(x, y);
    const auto count = static_cast<std::uint32_t>(polygon.size());
    vertices_.resize(count);
    std::vector<PlanePoint> points(count);
    for (std::uint32_t v = 0; v < count; ++v) {
        const auto p = core::convert<double>(polygon[v]);
        vertices_[v] = {.point = {p[x], p[y]},
                        .previous = v == 0 ? count - 1 : v - 1,
                        .next = v + 1 == count ? 0 : v + 1,
                        .version = 0,
                        .removed = false,
                        .convex = true};
        points[v] = vertices_[v].point;
    }
    tree_.reset(std::move(points));
    left_ = count;
    reflex_ = 0;
    return true;
}

void Triangulator::clip_ears() {
    for (Queue* queue : {&candidates_, &touched_}) {
        queue->items.clear();
        queue->head = 0;
    }
    for (std::uint32_t v = 0; v < vertices_.size(); ++v)
        changed_.push_back(v);
    settle();

    // Clipping an ear makes ears of its two neighbours at most. So if no candidates are left, no
    // ears are left, and the polygon crosses itself. Then any convex corner is clipped.
    bool crossing = false;
    while (left_ >= 3) {
        std::optional<std::uint32_t> ear = take(candidates_);
        if (ear && !crossing) {
            const Ear kind = ear_at(*ear);
            if (kind == Ear::touched) touched_.items.push_back({*ear, vertices_[*ear].version});
            if (kind != Ear::clear) continue;
        } else if (!ear && !crossing) {
            ear = take(touched_);
            if (ear && ear_at(*ear) == Ear::blocked) continue;
        }
        if (ear) {
            triangles_.push_back({vertices_[*ear].previous, *ear, vertices_[*ear].next});
            remove(*ear);
            settle();
        } else if (!crossing) {
            crossing = true;
            for (std::uint32_t v = 0; v < vertices_.size(); ++v)
                if (!vertices_[v].removed && vertices_[v].convex)
                    candidates_.items.push_back({v, vertices_[v].version});
        } else {
            return; // the rest is clockwise
        }
    }
}

void Triangulator::remove(std::uint32_t v) {
    Vertex& vertex = vertices_[v];
    vertex.removed = true;
    tree_.mark(v, false);
    if (!vertex.convex) --reflex_;
    --left_;
    vertices_[vertex.previous].next = vertex.next;
    vertices_[vertex.next].previous = vertex.previous;
    changed_.push_back(vertex.next);
    changed_.push_back(vertex.previous);
}

/// Updates the vertices whose neighbours changed: removes those that bound no area, and makes
/// convex ones candidates.
void Triangulator::settle() {
    // In this order, which determines the order of the triangles.
    for (std::size_t i = 0; i < changed_.size(); ++i) {
        const std::uint32_t v = changed_[i];
        Vertex& vertex = vertices_[v];
        if (vertex.removed) continue;
        if (vertex.point == vertices_[vertex.next].point || is_spike(v)) {
            remove(v);
            continue;
        }
        const bool convex = turn_at(v) > 0;
        if (convex != vertex.convex) reflex_ += convex ? -1 : 1;
        vertex.convex = convex;
        ++vertex.version;
        tree_.mark(v, !convex);
        if (convex) candidates_.items.push_back({v, vertex.version});
    }
    changed_.clear();
}

std::optional<std::uint32_t> Triangulator::take(Queue& queue) const {
    while (queue.head < queue.items.size()) {
        const Candidate candidate = queue.items[queue.head++];
        const Vertex& vertex = vertices_[candidate.vertex];
        if (!vertex.removed && vertex.version == candidate.version) return candidate.vertex;
    }
    return std::nullopt;
}

/// Tests for an ear: the triangle of the convex vertex v and its neighbours can be clipped if no
/// other part of the outline enters it. An outline that enters it without a crossing has a reflex
/// vertex in the triangle, or on its boundary with an edge that leads inside. A vertex that is only
/// on the open third side "touches". Another ear is preferred then, because that vertex would lie
/// on an edge of a triangle and not at a corner, where rounding could open a crack.
Triangulator::Ear Triangulator::ear_at(std::uint32_t v) const {
    if (reflex_ == 0) return Ear::clear;
    const PlanePoint& b = vertices_[v].point;
    const PlanePoint& a = vertices_[vertices_[v].previous].point;
    const PlanePoint& c = vertices_[vertices_[v].next].point;
    bool touched = false;
    const bool blocked = tree_.any_in(a, b, c, [&](std::uint32_t other) {
        const Vertex& vertex = vertices_[other];
        const int ab = orientation(a, b, vertex.point);
        const int bc = orientation(b, c, vertex.point);
        const int ca = orientation(c, a, vertex.point);
        if (ab < 0 || bc < 0 || ca < 0) return false;
        for (const std::uint32_t neighbour : {vertex.previous, vertex.next}) {
            const PlanePoint& to = vertices_[neighbour].point;
            if ((ab > 0 || orientation(a, b, to) > 0) && (bc > 0 || orientation(b, c, to) > 0) &&
                (ca > 0 || orientation(c, a, to) > 0))
                return true;
        }
        touched = touched || (ca == 0 && ab > 0 && bc > 0);
        return false;
    });
    if (blocked) return Ear::blocked;
    return touched ? Ear::touched : Ear::clear;
}

int Triangulator::turn_at(std::uint32_t v) const {
    const Vertex& vertex = vertices_[v];
    return orientation(vertices_[vertex.previous].point, vertex.point,
                       vertices_[vertex.next].point);
}

/// Returns true if the outline runs back at v along the line on which it came.
bool Triangulator::is_spike(std::uint32_t v) const {
    if (turn_at(v) != 0) return false;
    const PlanePoint& a = vertices_[vertices_[v].previous].point;
    const PlanePoint& b = vertices_[v].point;
    const PlanePoint& c = vertices_[vertices_[v].next].point;
    return a.x != b.x ? (a.x < b.x) == (c.x < b.x) : (a.y < b.y) == (c.y < b.y);
}

} // namespace raylane::scenes
