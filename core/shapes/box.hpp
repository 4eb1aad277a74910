#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/clip_interval.hpp"
#include "core/shapes/form.hpp"
#include "core/shapes/types.hpp"

#include <array>

namespace raylane::core {

template <class Number>
void validate(const BoxOf<Number>& box) {
    checks::require_point("corner", box.corner);
    checks::require_spanning("edges", box.edge_u, box.edge_v, box.edge_w);
}

template <class Number>
Bounds bounds_of(const BoxOf<Number>& box) {
    const Vec3d half_u = 0.5 * convert<double>(box.edge_u);
    const Vec3d half_v = 0.5 * convert<double>(box.edge_v);
    const Vec3d half_w = 0.5 * convert<double>(box.edge_w);
    const Vec3d corner = convert<double>(box.corner);
    const Vec3d extent = absolute(half_u) + absolute(half_v) + absolute(half_w);
    return bounds_around(corner + half_u + half_v + half_w, extent, absolute(corner) + extent);
}

/// Returns the normals of the faces opposite to the corner, of length volume / height: v x w, w x
/// u, u x v. They point outwards if the edges are right-handed, inwards otherwise.
template <class Real, class Number>
std::array<Vec3<Real>, 3> box_normals(const BoxOf<Number>& box) {
    const Vec3<Real> u = convert<Real>(box.edge_u);
    const Vec3<Real> v = convert<Real>(box.edge_v);
    const Vec3<Real> w = convert<Real>(box.edge_w);
    return {cross(v, w), cross(w, u), cross(u, v)};
}

/// The edge coordinate u of a point p is ((v x w) . p) / ((v x w) . u), likewise v and w: three
/// slabs [0, 1].
template <class Real, class Number>
Crossings<Real> crossings(const BoxOf<Number>& box, const Ray<Real>& ray, const Start& start,
                          ErrorPredicate<Real>& predicate) {
    if (start.on_surface && !start.inward) return {};

    const Vec3<Real> from_corner = ray.origin - convert<Real>(box.corner);
    const std::array<Vec3<Real>, 3> normals = box_normals<Real>(box);
    const Real volume =
        dot(normals[0], convert<Real>(box.edge_u)); // its sign is the handedness of the edges
    const bool left_handed = static_cast<double>(volume) < 0.0;
    const auto turned = [&](const Real& a) { return left_handed ? Real(-a) : a; };

    ClipInterval<Real> interval(predicate);
    for (int i = 0; i < 3; ++i) {
        const Real position = turned(dot(normals[i], from_corner));
        const Real slope = turned(dot(normals[i], ray.direction));
        const Face low = static_cast<Face>(2 * i), high = static_cast<Face>(2 * i + 1);
        if (!start.on_surface) {
            interval.clip_slab(position, slope, turned(volume), low, high);
            continue;
        }
        // From a face inward, only exits count, and not the face itself.
        const int direction = predicate.sign(slope);
        if (direction > 0 && start.face != high)
            interval.clip_back((turned(volume) - position) / slope, high);
        if (direction < 0 && start.face != low) interval.clip_back(-position / slope, low);
    }
    return start.on_surface ? interval.exit() : interval.crossings();
}

template <class Real, class Number>
Vec3<Real> outward_direction(const BoxOf<Number>& box, const Vec3<Real>&, Face face) {
    const std::array<Vec3<Real>, 3> normals = box_normals<Real>(box);
    const bool left_handed = static_cast<double>(dot(normals[0], convert<Real>(box.edge_u))) < 0.0;
    const bool through_corner = face % 2 == 0;
    const Vec3<Real>& normal = normals[face / 2];
    return left_handed == through_corner ? normal : -normal;
}

template <class Real, class Number>
NormalAlong<Real> normal_along(const BoxOf<Number>& box, const Ray<Real>&, Face face) {
    const bool left_handed =
        dot(box_normals<Dyadic>(box)[0], convert<Dyadic>(box.edge_u)).sign() < 0;
    const bool through_corner = face % 2 == 0;
    const Vec3<Real> normal = box_normals<Real>(box)[face / 2];
    return {left_handed == through_corner ? normal : -normal};
}

template <class Number>
ExactQuadratic form_along(const BoxOf<Number>& box, const ExactRay& ray, Face face) {
    Vec3<Dyadic> point = ray.origin - convert<Dyadic>(box.corner);
    const Vec3<Number> edges[] = {box.edge_u, box.edge_v, box.edge_w};
    if (face % 2 == 1) point = point - convert<Dyadic>(edges[face / 2]);
    return plane_along(normal_along(box, ray, face).v, point, ray.direction);
}

/// Returns the forms of the faces. Multiplying by the volume gives each form the right sign.
template <class Real, class Number>
std::array<Real, 6> forms_at(const BoxOf<Number>& box, const Vec3<Real>& point) {
    const Vec3<Real> from_corner = point - convert<Real>(box.corner);
    const std::array<Vec3<Real>, 3> normals = box_normals<Real>(box);
    const Real volume = dot(normals[0], convert<Real>(box.edge_u));
    std::array<Real, 6> forms;
    for (int i = 0; i < 3; ++i) {
        const Real position = dot(normals[i], from_corner);
        forms[2 * i] = -(position * volume);
        forms[2 * i + 1] = (position - volume) * volume;
    }
    return forms;
}

} // namespace raylane::core
