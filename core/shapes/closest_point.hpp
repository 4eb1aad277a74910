#pragma once

#include "core/numbers/exact.hpp"
#include "core/shapes/error_predicate.hpp"
#include "core/shapes/types.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

/// The point of a shape's surface that is closest to another point. Each shape has
///   ClosestPoint<Real> closest_point(shape, point, predicate)
/// for Real = Bounded numbers and Exact ones, except ellipsoids and quadrics (closest_on_quadric in
/// core/reference/). Its squared distance is a + b sqrt(c) for rational a, b and c. The predicate
/// decides on which part of the surface the point is. If it has no doubt, or in exact numbers, the
/// result is that of real arithmetic.
namespace raylane::core {

template <class Real>
struct ClosestPoint {
    Real squared; ///< distance, squared
    Vec3<Real> point;
    Face face = body; ///< the lowest of the faces that the point is on
};

template <class Shape>
inline constexpr bool has_closest_point =
    kind_of<Shape> != Kind::quadric&& kind_of<Shape> != Kind::ellipsoid;

/// All points of a sphere are closest to its centre. The result is the one on its z axis.
template <class Real, class Number>
ClosestPoint<Real> closest_point(const SphereOf<Number>& sphere, const Vec3<Real>& point,
                                 ErrorPredicate<Real>& predicate) {
    using std::sqrt;
    const Vec3<Real> center = convert<Real>(sphere.center);
    const Vec3<Real> from_center = point - center;
    const Real radius(sphere.radius);
    const Real squared = squared_length(from_center);
    if (predicate.sign(squared) == 0)
        return {radius * radius, center + Vec3<Real>(Real(0.0), Real(0.0), radius)};
    const Real distance = sqrt(squared);
    const Real height = distance - radius;
    return {height * height, mul_add(Real(radius / distance), from_center, center)};
}

/// Returns the foot of the perpendicular on the plane through the origin.
template <class Real>
ClosestPoint<Real> foot_on_plane(const Vec3<Real>& from_plane, const Vec3<Real>& normal,
                                 const Vec3<Real>& point) {
    const Real height = dot(normal, from_plane), squared = squared_length(normal);
    return {height * height / squared, mul_add(Real(-(height / squared)), normal, point)};
}

template <class Real, class Number>
ClosestPoint<Real> closest_point(const PlaneOf<Number>& plane, const Vec3<Real>& point,
                                 ErrorPredicate<Real>&) {
    return foot_on_plane(Vec3<Real>(point - convert<Real>(plane.point)),
                         convert<Real>(plane.normal), point);
}

/// A point relative to an axis.
template <class Real>
struct AboutAxis {
    Vec3<Real> base, axis;
    Real axis_squared; ///< |axis|^2
    Real height;       ///< along the axis, times |axis|
    Vec3<Real> across; ///< offset from the axis
    Real off_squared;  ///< |across|^2

    template <class Number>
    AboutAxis(const Vec3<Number>& base_, const Vec3<Number>& axis_, const Vec3<Real>& point)
        : base(convert<Real>(base_)), axis(convert<Real>(axis_)) {
        const Vec3<Real> from_base = point - base;
        axis_squared = squared_length(axis);
        height = dot(from_base, axis);
        across = mul_add(Real(-(height / axis_squared)), axis, from_base);
        off_squared = squared_length(across);
    }

    Real off() const {
        using std::sqrt;
        return sqrt(off_squared);
    }
    /// Returns the squared distance of points at another height, if they are on the axis.
    Real squared_along(const Real& other_height) const {
        const Real difference = height - other_height;
        return difference * difference / axis_squared;
    }
    /// Returns the point at a radius from the axis, on the side of the given point. If that is on
    /// the axis, on the side of axis x e, where e is the coordinate axis along which `axis` has
    /// its smallest component, the first of several.
    Vec3<Real> beside(const Real& share_of_axis, const Real& radius,
                      ErrorPredicate<Real>& predicate) const {
        using std::sqrt;
        const Vec3<Real> foot = mul_add(share_of_axis, axis, base);
        if (predicate.sign(off_squared) != 0) return mul_add(Real(radius / off()), across, foot);
        Vec3<Real> least(Real(0.0));
        least[least_component()] = Real(1.0);
        const Vec3<Real> direction = cross(axis, least);
        return mul_add(Real(radius / sqrt(squared_length(direction))), direction, foot);
    }

  private:
    int least_component() const {
        int least = 0;
        for (int i = 1; i < 3; ++i)
            if (std::abs(static_cast<double>(axis[i])) < std::abs(static_cast<double>(axis[least])))
                least = i;
        return least;
    }
};

/// Returns the closest point of a circle about the axis.
template <class Real>
ClosestPoint<Real> closest_on_rim(const AboutAxis<Real>& about, const Real& share_of_axis,
                                  const Real& radius, ErrorPredicate<Real>& predicate) {
    const Real inwards = about.off() - radius;
    return {about.squared_along(Real(share_of_axis * about.axis_squared)) + inwards * inwards,
            about.beside(share_of_axis, radius, predicate)};
}

template <class Real, class Number>
ClosestPoint<Real> closest_point(const DiscOf<Number>& disc, const Vec3<Real>& point,
                                 ErrorPredicate<Real>& predicate) {
    const AboutAxis<Real> about(disc.center, disc.normal, point);
    const Real radius(disc.radius);
    if (predicate.less(Real(radius * radius), about.off_squared))
        return closest_on_rim(about, Real(0.0), radius, predicate);
    return foot_on_plane(Vec3<Real>(point - about.base), about.axis, point);
}

/// The part of a polygon or a box that a closest point is on: the corners that it is between, as
/// bits. Two faces that share the part have the same closest point.
using Corners = std::uint32_t;

template <class Real>
struct ClosestOfPolygon {
    ClosestPoint<Real> closest;
    Corners corners;
};

/// Returns the closest point of an edge, given a point that it is closest to.
template <class Real>
ClosestOfPolygon<Real> closest_on_edge(const Vec3<Real>& from, const Vec3<Real>& to,
                                       Corners from_corner, Corners to_corner,
                                       const Vec3<Real>& point, ErrorPredicate<Real>& predicate) {
    const Vec3<Real> edge = to - from, from_start = point - from;
    const Real along = dot(from_start, edge), squared = squared_length(edge);
    if (!predicate.positive(along)) return {{squared_length(from_start), from}, from_corner};
    if (!predicate.less(along, squared))
        return {{squared_length(Vec3<Real>(point - to)), to}, to_corner};
    const Real share = along / squared;
    const Vec3<Real> off = mul_add(Real(-share), edge, from_start);
    return {{squared_length(off), mul_add(share, edge, from)}, from_corner | to_corner};
}

/// Replaces `best` if another point is closer. Points of the same part are equally close.
template <class Real>
void keep_closer(ClosestOfPolygon<Real>& best, const ClosestOfPolygon<Real>& other,
                 ErrorPredicate<Real>& predicate) {
    if (other.corners != best.corners &&
        predicate.less(other.closest.squared, best.closest.squared))
        best = other;
}

/// Returns the closest point of a flat, convex polygon. Outside of it, that point is on an edge on
/// whose outer side the point is. `corners`: in order; corner i has the bit `bits`[i].
template <class Real, std::size_t count>
ClosestOfPolygon<Real> closest_on_polygon(const std::array<Vec3<Real>, count>& corners,
                                          const std::array<Corners, count>& bits,
                                          const Vec3<Real>& normal, const Vec3<Real>& point,
                                          ErrorPredicate<Real>& predicate) {
    ClosestOfPolygon<Real> best{{}, 0};
    Corners around = ~Corners{0};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const int side = predicate.sign(dot(
            normal, cross(Vec3<Real>(corners[next] - corners[i]), Vec3<Real>(point - corners[i]))));
        if (side == 0) around &= bits[i] | bits[next]; // unless the closest point is elsewhere
        if (side >= 0) continue;
        const ClosestOfPolygon<Real> on_edge =
            closest_on_edge(corners[i], corners[next], bits[i], bits[next], point, predicate);
        if (best.corners == 0)
            best = on_edge;
        else
            keep_closer(best, on_edge, predicate);
    }
    Corners vertices = 0;
    for (const Corners bit : bits)
        vertices |= bit;
    if (best.corners != 0) return best;
    return {foot_on_plane(Vec3<Real>(point - corners[0]), normal, point), vertices & around};
}

template <class Real, AnyTriangle Shape>
ClosestPoint<Real> closest_point(const Shape& triangle, const Vec3<Real>& point,
                                 ErrorPredicate<Real>& predicate) {
    const Vec3<Real> a = convert<Real>(triangle.a), b = convert<Real>(triangle.b),
                     c = convert<Real>(triangle.c);
    const Vec3<Real> normal = cross(Vec3<Real>(b - a), Vec3<Real>(c - a));
    return closest_on_polygon<Real, 3>({a, b, c}, {1, 2, 4}, normal, point, predicate).closest;
}

/// A box. Corner k is at the end of edge i if bit i of k is 1, otherwise at its start.
template <class Real>
class ClosestOfBox {
  public:
    template <class Number>
    ClosestOfBox(const BoxOf<Number>& box, const Vec3<Real>& point, ErrorPredicate<Real>& predicate)
        : corner_(convert<Real>(box.corner)), edges_{convert<Real>(box.edge_u),
                                                     convert<Real>(box.edge_v),
                                                     convert<Real>(box.edge_w)},
          normals_{cross(edges_[1], edges_[2]), cross(edges_[2], edges_[0]),
                   cross(edges_[0], edges_[1])},
          point_(point), predicate_(predicate) {
        const Real volume = dot(normals_[0], edges_[0]);
        volume_ = static_cast<double>(volume) < 0.0 ? -volume : volume;
        for (std::size_t i = 0; i < 3; ++i) {
            heights_[i] = dot(normals_[i], Vec3<Real>(point - corner_));
            if (static_cast<double>(volume) < 0.0) heights_[i] = -heights_[i];
        }
    }

    ClosestPoint<Real> closest() const {
        ClosestOfPolygon<Real> best{{}, 0};
        for (std::size_t i = 0; i < 3; ++i) {
            const bool before = predicate_.negative(heights_[i]);
            if (!before && !predicate_.less(volume_, heights_[i])) continue;
            const ClosestOfPolygon<Real> other = on_face(i, !before);
            if (best.corners == 0)
                best = other;
            else
                keep_closer(best, other, predicate_);
        }
        return best.corners == 0 ? from_inside() : best.closest;
    }

  private:
    /// Returns the closest point of the face across edge i at its start or end.
    ClosestOfPolygon<Real> on_face(std::size_t i, bool at_end) const {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const unsigned first = at_end ? 1U << i : 0U;
        const unsigned numbers[] = {first, first | 1U << j, first | 1U << j | 1U << k,
                                    first | 1U << k};
        std::array<Vec3<Real>, 4> corners;
        std::array<Corners, 4> bits;
        for (std::size_t corner = 0; corner < 4; ++corner) {
            corners[corner] = corner_;
            for (std::size_t edge = 0; edge < 3; ++edge)
                if ((numbers[corner] >> edge & 1) != 0)
                    corners[corner] = corners[corner] + edges_[edge];
            bits[corner] = 1U << numbers[corner];
        }
        ClosestOfPolygon<Real> found =
            closest_on_polygon(corners, bits, normals_[i], point_, predicate_);
        found.closest.face = lowest_face(found.corners);
        return found;
    }
    /// Returns the lowest face that has all of these corners.
    static Face lowest_face(Corners corners) {
        constexpr Corners at_end[] = {0xAA, 0xCC, 0xF0}; // corners with bit 0, 1, 2
        for (unsigned edge = 0; edge < 3; ++edge)
            for (unsigned end = 0; end < 2; ++end)
                if ((corners & (end == 0 ? at_end[edge] : ~at_end[edge])) == 0)
                    return static_cast<Face>(2 * edge + end);
        return 0;
    }
    /// Returns the closest foot on the planes of the faces. The ball around the point that touches
    /// the closest plane is on the inner side of all planes, so that foot is on the face.
    ClosestPoint<Real> from_inside() const {
        ClosestPoint<Real> best;
        for (std::size_t i = 0; i < 3; ++i)
            for (unsigned end = 0; end < 2; ++end) {
                const Vec3<Real> through = end == 0 ? corner_ : Vec3<Real>(corner_ + edges_[i]);
                ClosestPoint<Real> other =
                    foot_on_plane(Vec3<Real>(point_ - through), normals_[i], point_);
                other.face = static_cast<Face>(2 * i + end);
                if (other.face == 0 || predicate_.less(other.squared, best.squared)) best = other;
            }
        return best;
    }

    Vec3<Real> corner_;
    std::array<Vec3<Real>, 3> edges_, normals_;
    Vec3<Real> point_;
    ErrorPredicate<Real>& predicate_;
    Real volume_;
    std::array<Real, 3> heights_; // of the point above the faces at the corner; volume_ at the ends
};

template <class Real, class Number>
ClosestPoint<Real> closest_point(const BoxOf<Number>& box, const Vec3<Real>& point,
                                 ErrorPredicate<Real>& predicate) {
    return ClosestOfBox<Real>(box, point, predicate).closest();
}

/// The lateral surface of a cylinder or cone, in the half-plane of the point and the axis: the
/// segment from (base_radius, 0) to (top_radius, |axis|). Heights are scaled by |axis|. `place` is
/// the dot product of the segment with the point's offset from its start, and `above` the cross
/// product, scaled by |axis|, which is > 0 outside.
template <class Real>
class LateralSurface {
  public:
    LateralSurface(const AboutAxis<Real>& about, Real base_radius, Real top_radius,
                   ErrorPredicate<Real>& predicate)
        : about_(about), base_radius_(std::move(base_radius)), top_radius_(std::move(top_radius)),
          predicate_(predicate) {
        widening_ = top_radius_ - base_radius_;
        const Real off = about_.off() - base_radius_;
        place_ = off * widening_ + about_.height;
        above_ = off * about_.axis_squared - about_.height * widening_;
        slant_squared_ = widening_ * widening_ + about_.axis_squared;
    }

    bool is_outside() { return !predicate_.negative(above_); }
    /// Returns the squared distance from the line of the segment.
    Real squared_above() const { return above_ * above_ / (about_.axis_squared * slant_squared_); }
    /// Returns the closest point of the surface with its rims.
    ClosestPoint<Real> closest() {
        if (!predicate_.positive(place_))
            return closest_on_rim(about_, Real(0.0), base_radius_, predicate_);
        if (!predicate_.less(place_, slant_squared_))
            return closest_on_rim(about_, Real(1.0), top_radius_, predicate_);
        return foot();
    }
    /// Returns the foot of the perpendicular on the segment's line.
    ClosestPoint<Real> foot() {
        const Real share = place_ / slant_squared_;
        return {squared_above(),
                about_.beside(share, mul_add(share, widening_, base_radius_), predicate_)};
    }

  private:
    const AboutAxis<Real>& about_;
    Real base_radius_, top_radius_, widening_, place_, above_, slant_squared_;
    ErrorPredicate<Real>& predicate_;
};

/// A capped cylinder or cone. It is convex. So the closest point to one beyond a cap, within the
/// cap's radius, is on the cap, and the closest point to others outside is on the lateral surface.
/// The largest ball inside around a point touches the closest face.
template <class Real>
ClosestPoint<Real> closest_of_capped(const AboutAxis<Real>& about, const Real& base_radius,
                                     const Real& top_radius, const Vec3<Real>& point,
                                     ErrorPredicate<Real>& predicate) {
    const Vec3<Real> top = about.base + about.axis;
    const auto on_cap = [&](Face face) {
        ClosestPoint<Real> foot = foot_on_plane(
            Vec3<Real>(point - (face == base_cap ? about.base : top)), about.axis, point);
        foot.face = face;
        return foot;
    };
    const auto is_within = [&](const Real& radius) {
        return predicate.less(about.off_squared, Real(radius * radius));
    };
    LateralSurface<Real> lateral(about, base_radius, top_radius, predicate);
    const Real to_top = about.axis_squared - about.height;
    const bool below = predicate.negative(about.height), above = predicate.negative(to_top);
    if (below && is_within(base_radius)) return on_cap(base_cap);
    if (above && is_within(top_radius)) return on_cap(top_cap);
    if (below || above || lateral.is_outside()) return lateral.closest();
    const bool to_base = !predicate.less(to_top, about.height);
    const Real cap_squared = about.squared_along(to_base ? Real(0.0) : about.axis_squared);
    if (predicate.less(cap_squared, lateral.squared_above()))
        return on_cap(to_base ? base_cap : top_cap);
    return lateral.foot();
}

template <class Real>
ClosestPoint<Real> closest_of_frustum(Ends ends, const AboutAxis<Real>& about,
                                      const Real& base_radius, const Real& top_radius,
                                      const Vec3<Real>& point, ErrorPredicate<Real>& predicate) {
    if (ends == Ends::capped)
        return closest_of_capped(about, base_radius, top_radius, point, predicate);
    return LateralSurface<Real>(about, base_radius, top_radius, predicate).closest();
}

template <class Real, class Number, Ends ends>
ClosestPoint<Real> closest_point(const CylinderOf<Number, ends>& cylinder, const Vec3<Real>& point,
                                 ErrorPredicate<Real>& predicate) {
    const AboutAxis<Real> about(cylinder.base, cylinder.axis, point);
    const Real radius(cylinder.radius);
    return closest_of_frustum(ends, about, radius, radius, point, predicate);
}

template <class Real, class Number, Ends ends>
ClosestPoint<Real> closest_point(const ConeOf<Number, ends>& cone, const Vec3<Real>& point,
                                 ErrorPredicate<Real>& predicate) {
    const AboutAxis<Real> about(cone.base, cone.axis, point);
    return closest_of_frustum(ends, about, Real(cone.base_radius), Real(cone.top_radius), point,
                              predicate);
}

} // namespace raylane::core
