#pragma once

#include "core/reference/crossing_order.hpp"
#include "core/reference/parts_near.hpp"

namespace raylane::core {

/// The number of parts of a union of many that contain a ray before a crossing, if it is known.
struct WayInUnion {
    Solids::Index counted = Solids::none; ///< the union; none: the number is unknown
    int inside = 0;

    WayInUnion() = default;
    /// Starts the count for a ray whose first crossing is with `shape`. The number is known if the
    /// ray starts on the surface of a single part of the union, or outside of the union's bounds.
    WayInUnion(const Scene& scene, const LeavingRay& from, ShapeId shape);

    /// Counts the crossing of a part of a solid.
    void pass(const Solids& solids, ShapeId part, bool entering) {
        if (has(solids, part)) inside += entering ? 1 : -1;
    }

    /// Returns true if another part of the union contains the crossing of a part of a solid.
    bool hides(const Solids& solids, ShapeId part, bool entering) const {
        return has(solids, part) && inside > (entering ? 0 : 1);
    }

  private:
    bool has(const Solids& solids, ShapeId part) const {
        return counted != Solids::none && solids.node(solids.part_of(part)).parent == counted;
    }
};

/// Tells which crossings with parts of solids are crossings with the solids' surfaces: those at
/// which the ray enters or leaves the solid. If several parts are crossed at one point, one of them
/// stands for all: the first that changes as the solid does. A part that is only touched does not
/// change anything. For use by one thread.
class SolidSurfaces {
  public:
    explicit SolidSurfaces(const Scene& scene)
        : scene_(scene), solids_(scene.solids()), parts_(scene) {}

    /// Decides as real arithmetic does. The crossing must be ahead of the ray or, if it is at the
    /// start, among its origin surfaces. A crossing with a shape that is not a part is always one
    /// of the surface.
    bool is_surface(const LeavingRay& from, const Hit<double>& hit,
                    const WayInUnion& way = WayInUnion()) {
        if (!solids_.has(hit.shape)) return true;
        const Value surely = quickly(from, hit, way);
        return surely == Value::unknown ? exactly(from, hit) : surely == Value::yes;
    }

    /// Returns the part of a union of many that contained the last point; none if no part did.
    Solids::Index last_around() const { return last_around_; }

  private:
    using Index = Solids::Index;

    /// Values just before and just behind a crossing.
    struct Sides {
        bool before, behind;

        bool operator==(const Sides&) const = default;
        bool change() const { return before != behind; }
    };

    Value quickly(const LeavingRay& from, const Hit<double>& hit, const WayInUnion& way);
    Value value_at(Index index, const LeavingRay& from, const Hit<double>& hit,
                   const Somewhere& point, const WayInUnion& way);
    Value value_of_many(Index index, Index without, const LeavingRay& from, const Hit<double>& hit,
                        const Somewhere& point);
    Value value_of_part(Index index, const LeavingRay& from, const Hit<double>& hit,
                        const Somewhere& point);

    bool exactly(const LeavingRay& from, const Hit<double>& hit);
    Sides sides_of(Index index, const LeavingRay& from, const SharpHit& hit, const Bounds& around);
    Sides sides_of_part(Index index, const LeavingRay& from, const SharpHit& hit);

    const Scene& scene_;
    const Solids& solids_;
    PartsNear parts_;
    Index last_around_ = Solids::none;
};

} // namespace raylane::core
