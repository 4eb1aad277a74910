#pragma once

#include "simd/kernel/solvers/shapes.hpp"

namespace raylane::simd {

/// A sphere around a shape, per lane. The radius is rounded up by more than all roundings here can
/// amount to: `rounded_up` adds 2^-20 of the radius and of the centre's coordinates.
template <class Arch>
struct SphereAround {
    Vectors<Arch> center;
    Floats<Arch> radius;
};

template <class Arch>
SphereAround<Arch> rounded_up(const Vectors<Arch>& center, const Floats<Arch>& radius) {
    const Floats<Arch> sizes = abs(center.x) + abs(center.y) + abs(center.z);
    return {center, radius + Floats<Arch>(0x1p-20F) * (radius + sizes)};
}

template <class Arch>
Floats<Arch> length(const Vectors<Arch>& v) {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

template <class Arch>
Vectors<Arch> half(const Vectors<Arch>& v) {
    const Floats<Arch> h(0.5F);
    return {v.x * h, v.y * h, v.z * h};
}

/// By the number of the kind, but for cylinders and cones. Planes have none: their radius is
/// infinite.
template <class Arch, class Reader>
SphereAround<Arch> sphere_around(int kind, Reader reader) {
    using F = Floats<Arch>;
    const Vectors<Arch> first = next_vector<Arch>(reader);
    switch (kind) {
    case 0: // sphere
        return rounded_up<Arch>(first, reader.next());
    case 1: // plane
        return {first, F(__builtin_inff())};
    case 2: { // disc
        next_vector<Arch>(reader);
        return rounded_up<Arch>(first, reader.next());
    }
    case 3:
    case 4: { // triangle
        const Vectors<Arch> b = next_vector<Arch>(reader), c = next_vector<Arch>(reader);
        const Vectors<Arch> center = half<Arch>(first + half<Arch>(b + c));
        const F to_a = length<Arch>(first - center), to_b = length<Arch>(b - center);
        return rounded_up<Arch>(center, max(max(to_a, to_b), length<Arch>(c - center)));
    }
    case 5: { // box
        const Vectors<Arch> u = half<Arch>(next_vector<Arch>(reader));
        const Vectors<Arch> v = half<Arch>(next_vector<Arch>(reader));
        const Vectors<Arch> w = half<Arch>(next_vector<Arch>(reader));
        const F longest = max(max(length<Arch>(u + v + w), length<Arch>(u + v - w)),
                              max(length<Arch>(u - v + w), length<Arch>(u - v - w)));
        return rounded_up<Arch>(first + u + v + w, longest);
    }
    default: { // quadric
        for (int skipped = 0; skipped < 10; ++skipped)
            reader.next();
        const Vectors<Arch> lower = next_vector<Arch>(reader), upper = next_vector<Arch>(reader);
        return rounded_up<Arch>(first + half<Arch>(lower + upper),
                                length<Arch>(half<Arch>(upper - lower)));
    }
    }
}

/// What each shape of a block is in, where it is in memory: spheres, which are the block's own if
/// that is what it holds; or, of cylinders and cones, what is between spheres around both ends.
template <class Arch>
class BlockSpheres {
    using F = Floats<Arch>;

  public:
    const float *center[2][3], *radius[2]; ///< by end, of 16 shapes
    int ends;

    void enclose(int kind, const float (*rows)[16]) {
        const bool are_spheres = kind == 0;
        ends = kind >= 6 && kind <= 9 ? 2 : 1;
        for (int end = 0; end < 2; ++end) {
            for (int axis = 0; axis < 3; ++axis)
                center[end][axis] = are_spheres ? rows[axis] : own_[end][axis];
            radius[end] = are_spheres ? rows[3] : own_[end][3];
        }
        if (are_spheres) return;
        for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
            BlockReader<Arch> reader(rows, from);
            if (ends == 1) {
                store(sphere_around<Arch>(kind, reader), 0, from);
                continue;
            }
            const Vectors<Arch> base = next_vector<Arch>(reader), axis = next_vector<Arch>(reader);
            const F base_radius = reader.next();
            store(rounded_up<Arch>(base, base_radius), 0, from);
            store(rounded_up<Arch>(base + axis, kind < 8 ? base_radius : reader.next()), 1, from);
        }
    }

    BlockSpheres() = default;
    BlockSpheres(const BlockSpheres&) = delete; // refers to itself
    BlockSpheres& operator=(const BlockSpheres&) = delete;

    /// The one around a shape that has one, to all lanes.
    SphereAround<Arch> broadcast(int lane) const {
        return {{F(center[0][0][lane]), F(center[0][1][lane]), F(center[0][2][lane])},
                F(radius[0][lane])};
    }

  private:
    void store(const SphereAround<Arch>& spheres, int end, int from) {
        spheres.center.x.store_unaligned(own_[end][0] + from);
        spheres.center.y.store_unaligned(own_[end][1] + from);
        spheres.center.z.store_unaligned(own_[end][2] + from);
        spheres.radius.store_unaligned(own_[end][3] + from);
    }

    float own_[2][4][16];
};

} // namespace raylane::simd
