#pragma once

#include "core/reference/crossing_order.hpp"
#include "core/reference/parts_near.hpp"

namespace raylane::core {

/// What is known of a ray before a crossing: of how many parts of a union of many it is
/// inside.
struct WayInUnion {
    Solids::Index counted = Solids::none; ///< the union; none: nothing is known
    int inside = 0;

    WayInUnion() = default;
    /// Of a ray that starts on a solid's surface, or somewhere else, and crosses a shape first.
    WayInUnion(const Scene& scene, const LeavingRay& from, ShapeId shape);

    /// Through a part.
    void pass(const Scene& scene, const Hit<double>& hit) {
        if (counted == Solids::none || !scene.solids().has(hit.shape)) return;
        const Solids::Index part = scene.solids().part_of(hit.shape);
        if (scene.solids().node(part).parent == counted) inside += hit.entering ? 1 : -1;
    }
};

/// Says which crossings with parts of solids are crossings with the solids' surfaces: those where
/// being inside of the solid changes. Several parts may be crossed at one point; then one of them
/// stands for all, the first whose change is the solid's. What is only touched does not change
/// anything. To be used by one thread.
class SolidSurfaces {
  public:
    explicit SolidSurfaces(const Scene& scene)
        : scene_(scene), solids_(scene.solids()), parts_(scene) {}

    /// As real arithmetic says, for a crossing that is ahead of a ray or, if it is at the start,
    /// among its origin surfaces. Those with shapes that are no parts are surfaces.
    bool is_surface(const LeavingRay& from, const Hit<double>& hit,
                    const WayInUnion& way = WayInUnion()) {
        if (!solids_.has(hit.shape)) return true;
        const Value surely = quickly(from, hit, way);
        return surely == Value::unknown ? exactly(from, hit) : surely == Value::yes;
    }

    /// The part of a union of many that the last point was found inside of; none if it was not.
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
