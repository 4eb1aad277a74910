#pragma once

#include "simd/kernel/solvers/shapes.hpp"

/// core/shapes/flat.hpp
namespace raylane::simd {

template <class Arch>
Crossing<Arch> cross_plane(const Vectors<Arch>& to_point, const Vectors<Arch>& normal,
                           const Vectors<Arch>& direction) {
    const Floats<Arch> approach = dot(normal, direction);
    const Mask<Arch> falls = approach < zero<Arch>();
    return {falls | (approach > zero<Arch>()), dot(normal, to_point) / approach, zero<Arch>(),
            falls};
}

template <class Arch>
Crossings<Arch> only(const Crossing<Arch>& crossing) {
    return {{crossing.exists, crossing.t, crossing.face, crossing.entering},
            {none<Arch>(), zero<Arch>(), zero<Arch>(), none<Arch>()}};
}

template <class Arch>
struct PlaneLanes {
    Vectors<Arch> point, normal;

    template <class Reader>
    explicit PlaneLanes(Reader reader)
        : point(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)) {}

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        Crossing<Arch> crossing = cross_plane(point - rays.origin, normal, rays.direction);
        crossing.exists = crossing.exists & ~starts.on_surface;
        return only(crossing);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>&) const {
        return normalized(normal);
    }
};

template <class Arch>
struct DiscLanes {
    Vectors<Arch> center, normal;
    Floats<Arch> radius;

    template <class Reader>
    explicit DiscLanes(Reader reader)
        : center(next_vector<Arch>(reader)), normal(next_vector<Arch>(reader)),
          radius(reader.next()) {}

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> to_center = center - rays.origin;
        Crossing<Arch> crossing = cross_plane(to_center, normal, rays.direction);
        const Vectors<Arch> from_center = mul_add<Arch>(crossing.t, rays.direction, -to_center);
        const Mask<Arch> outside = radius * radius < squared_length(from_center);
        crossing.exists = crossing.exists & ~outside & ~starts.on_surface;
        return only(crossing);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>&) const {
        return normalized(normal);
    }
};

template <class Arch>
struct TriangleLanes {
    Vectors<Arch> a, b, c;

    template <class Reader>
    explicit TriangleLanes(Reader reader)
        : a(next_vector<Arch>(reader)), b(next_vector<Arch>(reader)), c(next_vector<Arch>(reader)) {
    }

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Vectors<Arch> to_a = a - rays.origin, to_b = b - rays.origin, to_c = c - rays.origin;
        const Floats<Arch> u = dot(rays.direction, cross(to_c, to_b));
        const Floats<Arch> v = dot(rays.direction, cross(to_a, to_c));
        const Floats<Arch> w = dot(rays.direction, cross(to_b, to_a));
        const Floats<Arch> o = zero<Arch>();
        const Mask<Arch> some_negative = (u < o) | (v < o) | (w < o);
        const Mask<Arch> some_positive = (u > o) | (v > o) | (w > o);
        const Mask<Arch> inside =
            (some_negative & ~some_positive) | (some_positive & ~some_negative);
        Crossing<Arch> crossing =
            cross_plane(to_a, cross(to_b - to_a, to_c - to_a), rays.direction);
        crossing.exists = crossing.exists & inside & ~starts.on_surface;
        return only(crossing);
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>&, const Floats<Arch>&) const {
        return normalized(cross(b - a, c - a));
    }
};

/// Reads on behalf of another reader.
template <class Arch, class Reader>
struct PassOn {
    Reader& reader;
    Floats<Arch> next() { return reader.next(); }
};

/// Of a smooth triangle.
template <class Arch>
struct CornerNormals {
    Vectors<Arch> a, b, c;

    template <class Reader>
    explicit CornerNormals(Reader& reader)
        : a(next_vector<Arch>(reader)), b(next_vector<Arch>(reader)), c(next_vector<Arch>(reader)) {
    }

    /// core::shading_normal
    Vectors<Arch> interpolated(const TriangleLanes<Arch>& triangle, const Vectors<Arch>& point,
                               const Vectors<Arch>& unit_flat) const {
        const Vectors<Arch> to_a = triangle.a - point, to_b = triangle.b - point,
                            to_c = triangle.c - point;
        const auto share = [&](const Vectors<Arch>& p, const Vectors<Arch>& q,
                               const Vectors<Arch>& normal) {
            return scaled(dot(unit_flat, cross(p, q)), unit(normal));
        };
        const Vectors<Arch> sum =
            share(to_b, to_c, a) + share(to_c, to_a, b) + share(to_a, to_b, c);
        const Floats<Arch> square = squared_length(sum);
        return select<Arch>(square > zero<Arch>(), sum / sqrt(square), unit_flat);
    }
};

template <class Arch>
struct SmoothTriangleLanes : TriangleLanes<Arch> {
    CornerNormals<Arch> normals;

    template <class Reader>
    explicit SmoothTriangleLanes(Reader reader)
        : TriangleLanes<Arch>(PassOn<Arch, Reader>{reader}), normals(reader) {}

    Vectors<Arch> shading_normal(const Vectors<Arch>& point, const Vectors<Arch>& unit_flat) const {
        return normals.interpolated(*this, point, unit_flat);
    }
};

} // namespace raylane::simd
