#pragma once

#include "simd/kernel/solvers/quadratic.hpp"
#include "simd/kernel/solvers/shapes.hpp"

namespace raylane::simd {

/// core/shapes/quadric.hpp
template <class Arch, bool textbook = false>
struct QuadricLanes {
    Vectors<Arch> center;
    Floats<Arch> xx, yy, zz, xy, xz, yz;
    Vectors<Arch> linear;
    Floats<Arch> one;
    Vectors<Arch> lower, upper;

    template <class Reader>
    explicit QuadricLanes(Reader reader)
        : center(next_vector<Arch>(reader)), xx(reader.next()), yy(reader.next()),
          zz(reader.next()), xy(reader.next()), xz(reader.next()), yz(reader.next()),
          linear(next_vector<Arch>(reader)), one(reader.next()), lower(next_vector<Arch>(reader)),
          upper(next_vector<Arch>(reader)) {}

    Crossings<Arch> crossings(const Rays<Arch>& rays, const Starts<Arch>& starts) const {
        const Floats<Arch> o = zero<Arch>();
        const Vectors<Arch> from_center = rays.origin - center;
        const Floats<Arch> A = dot(rays.direction, product(rays.direction));
        const Floats<Arch> B = dot(rays.direction, half_gradient(from_center));
        const Floats<Arch> scale = squared_length(rays.direction) * largest_coefficient();

        Crossings<Arch> roots = solve_quadratic<Arch, textbook>(
            A, B, value(from_center), scale, [&](const Floats<Arch>& tau) {
                return value(mul_add<Arch>(tau, rays.direction, from_center));
            });
        const Mask<Arch> turns = (starts.inward & (A > o)) | (~starts.inward & (A < o));
        roots.first.exists = roots.first.exists & ~starts.on_surface;
        roots.second.exists =
            (roots.second.exists & ~starts.on_surface) | (starts.on_surface & turns);
        roots.second.t =
            select(starts.on_surface, not_behind<Arch>(negated(B + B) / A), roots.second.t);
        roots.second.entering =
            (roots.second.entering & ~starts.on_surface) | (starts.on_surface & ~starts.inward);

        for (Crossing<Arch>* root : {&roots.first, &roots.second}) {
            const Vectors<Arch> p = mul_add<Arch>(root->t, rays.direction, from_center);
            const Mask<Arch> outside = (p.x < lower.x) | (upper.x < p.x) | (p.y < lower.y) |
                                       (upper.y < p.y) | (p.z < lower.z) | (upper.z < p.z);
            root->exists = root->exists & ~outside;
        }
        return roots;
    }

    Vectors<Arch> outward_normal(const Vectors<Arch>& point, const Floats<Arch>&) const {
        const Floats<Arch> o = zero<Arch>();
        const Vectors<Arch> gradient = half_gradient(point - center);
        const Vectors<Arch> unit_z = {o, o, constant<Arch>(1.0F)};
        return select(squared_length(gradient) > o, normalized(gradient), unit_z);
    }

    Vectors<Arch> product(const Vectors<Arch>& p) const {
        return {dot(Vectors<Arch>{xx, xy, xz}, p), dot(Vectors<Arch>{xy, yy, yz}, p),
                dot(Vectors<Arch>{xz, yz, zz}, p)};
    }
    Vectors<Arch> half_gradient(const Vectors<Arch>& p) const { return product(p) + linear; }
    Floats<Arch> value(const Vectors<Arch>& p) const {
        return dot(p, half_gradient(p) + linear) + one;
    }
    Floats<Arch> largest_coefficient() const {
        Floats<Arch> largest = abs(xx);
        for (const Floats<Arch>* coefficient : {&yy, &zz, &xy, &xz, &yz}) {
            const Floats<Arch> size = abs(*coefficient);
            largest = select(largest < size, size, largest);
        }
        return largest;
    }
};

} // namespace raylane::simd
