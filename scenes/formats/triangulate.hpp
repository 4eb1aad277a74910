#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/formats/nff/point_tree.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace raylane::scenes {

/// Cuts flat polygons into triangles by ear clipping (Meisters 1975), on the projection along the
/// axis nearest to the normal. Polygons may be concave. They may repeat vertices, have vertices on
/// edges, and touch themselves: a polygon with holes may be drawn as one outline with bridges.
/// Every side test is exact, so the triangles tile the projected polygon exactly.
///
/// A polygon that crosses itself has no such tiling. It gets some triangles, always the same.
///
/// Testing an ear takes the time in which a k-d tree finds that no reflex vertex is in a triangle:
/// at most the square root of their number, unless many are on its boundary. An object of this
/// class can be reused for any number of polygons and keeps its memory.
class Triangulator {
  public:
    /// Indices of vertices, counter-clockwise where the polygon is counter-clockwise.
    using Corners = std::array<std::uint32_t, 3>;

    /// Returns the triangles, valid until the next call; empty if the polygon has no area.
    std::span<const Corners> triangulate(std::span<const core::Vec3f> polygon);

  private:
    enum class Ear { clear, touched, blocked };
    struct Vertex {
        PlanePoint point;
        std::uint32_t previous;
        std::uint32_t next;
        std::uint32_t version; // counts how often its neighbours changed
        bool removed;
        bool convex;
    };
    /// A vertex that may be an ear, unless its neighbours have changed since.
    struct Candidate {
        std::uint32_t vertex;
        std::uint32_t version;
    };
    /// First in, first out, so that ears are clipped all around the polygon rather than in a fan.
    struct Queue {
        std::vector<Candidate> items;
        std::size_t head = 0;
    };

    bool project(std::span<const core::Vec3f> polygon);
    void clip_ears();
    void remove(std::uint32_t v);
    void settle();
    Ear ear_at(std::uint32_t v) const;
    std::optional<std::uint32_t> take(Queue& queue) const;
    int turn_at(std::uint32_t v) const;
    bool is_spike(std::uint32_t v) const;

    std::vector<Vertex> vertices_;
    std::size_t left_ = 0;   // vertices not removed
    std::size_t reflex_ = 0; // of these, reflex vertices
    PointTree tree_;         // marks the reflex vertices
    std::vector<std::uint32_t> changed_;
    Queue candidates_;
    Queue touched_;
    std::vector<Corners> triangles_;
};

} // namespace raylane::scenes
