#pragma once

#include "core/reference/crossing_order.hpp"
#include "core/reference/parts_near.hpp"

namespace raylane::core {

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
    bool is_surface(const LeavingRay& from, const Hit<double>& hit) {
        if (!solids_.has(hit.shape)) return true;
        const Value surely = quickly(from, hit);
        return surely == Value::unknown ? exactly(from, hit) : surely == Value::yes;
    }

  private:
    using Index = Solids::Index;

    /// Values just before and just behind a crossing.
    struct Sides {
        bool before, behind;

        bool operator==(const Sides&) const = default;
        bool change() const { return before != behind; }
    };

    Value quickly(const LeavingRay& from, const Hit<double>& hit);
    Value value_at(Index index, const LeavingRay& from, const Hit<double>& hit,
                   const Somewhere& point);
    Value value_of_part(Index index, const LeavingRay& from, const Hit<double>& hit,
                        const Somewhere& point);

    bool exactly(const LeavingRay& from, const Hit<double>& hit);
    Sides sides_of(Index index, const LeavingRay& from, const SharpHit& hit, const Bounds& around);
    Sides sides_of_part(Index index, const LeavingRay& from, const SharpHit& hit);

    const Scene& scene_;
    const Solids& solids_;
    PartsNear parts_;
};

} // namespace raylane::core
