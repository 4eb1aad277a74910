#pragma once

#include "simd/kernel/solvers/shapes.hpp"

namespace raylane::simd {

/// core/shapes/box.hpp
template <class Arch>
struct BoxLanes {
    Vectors<Arch> corner, edge_u, edge_v, edge_w;

    template <class Reader>
    explicit BoxLanes(Reader reader)
        : corner(next_vector<Arch>(reader)), edge_u(next_vector<Arch>(reader)),
          edge_v(next_vector<Arch>(reader)), edge_w(next_vector<Arch>(reader)) {}

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> from_corner = rays.origin - corner;
        const Vectors<Arch> normals[3] = {cross(edge_v, edge_w), cross(edge_w, edge_u),
                                          cross(edge_u, edge_v)};
        const Floats<Arch> volume = dot(normals[0], edge_u);
        const Mask<Arch> left_handed = volume < zero<Arch>();
        const auto turned = [&](const Floats<Arch>& a) {
            return select(left_handed, negated(a), a);
        };

        Span<Arch> span;
        for (int i = 0; i < 3; ++i) {
            const Floats<Arch> position = turned(dot(normals[i], from_corner));
            const Floats<Arch> slope = turned(dot(normals[i], rays.direction));
            const float low = static_cast<float>(2 * i), high = static_cast<float>(2 * i + 1);
            span.clip_slab(~starts.on_surface, position, slope, turned(volume), low, high);
            const Mask<Arch> rises =
                starts.on_surface & (slope > zero<Arch>()) & (starts.face != constant<Arch>(high));
            const Mask<Arch> falls =
                starts.on_surface & (slope < zero<Arch>()) & (starts.face != constant<Arch>(low));
            span.clip_back(rises, (turned(volume) - position) / slope, constant<Arch>(high));
            span.clip_back(falls, negated(position) / slope, constant<Arch>(low));
        }
        return inward_only(span.crossings(starts.on_surface), starts);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>& face) const {
        const Vectors<Arch> normals[3] = {cross(edge_v, edge_w), cross(edge_w, edge_u),
                                          cross(edge_u, edge_v)};
        const Mask<Arch> left_handed = dot(normals[0], edge_u) < zero<Arch>();
        const auto is = [&](float f) { return face == constant<Arch>(f); };
        const Vectors<Arch> normal =
            select(is(0) | is(1), normals[0], select(is(2) | is(3), normals[1], normals[2]));
        const Mask<Arch> through_corner = is(0) | is(2) | is(4);
        const Mask<Arch> same = (left_handed & through_corner) | (~left_handed & ~through_corner);
        const Vectors<Arch> unit = normalized(normal);
        return select(same, unit, -unit);
    }
};

} // namespace raylane::simd
