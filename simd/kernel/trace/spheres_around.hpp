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
    const Floats<Arch> sizes = xsimd::abs(center.x) + xsimd::abs(center.y) + xsimd::abs(center.z);
    return {center, radius + Floats<Arch>(0x1p-20F) * (radius + sizes)};
}

template <class Arch>
Floats<Arch> length(const Vectors<Arch>& v) {
    return xsimd::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

template <class Arch>
Vectors<Arch> half(const Vectors<Arch>& v) {
    const Floats<Arch> h(0.5F);
    return {v.x * h, v.y * h, v.z * h};
}

/// By the number of the kind. Planes have none: their radius is infinite.
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
        return rounded_up<Arch>(center,
                                xsimd::max(xsimd::max(to_a, to_b), length<Arch>(c - center)));
    }
    case 5: { // box
        const Vectors<Arch> u = half<Arch>(next_vector<Arch>(reader));
        const Vectors<Arch> v = half<Arch>(next_vector<Arch>(reader));
        const Vectors<Arch> w = half<Arch>(next_vector<Arch>(reader));
        const F longest = xsimd::max(xsimd::max(length<Arch>(u + v + w), length<Arch>(u + v - w)),
                                     xsimd::max(length<Arch>(u - v + w), length<Arch>(u - v - w)));
        return rounded_up<Arch>(first + u + v + w, longest);
    }
    case 6:
    case 7: { // cylinder
        const Vectors<Arch> axis = half<Arch>(next_vector<Arch>(reader));
        const F radius = reader.next();
        return rounded_up<Arch>(first + axis,
                                xsimd::sqrt(squared_length<Arch>(axis) + radius * radius));
    }
    case 8:
    case 9: { // cone
        const Vectors<Arch> axis = half<Arch>(next_vector<Arch>(reader));
        const F base = reader.next(), top = reader.next();
        const F radius = xsimd::max(base, top);
        return rounded_up<Arch>(first + axis,
                                xsimd::sqrt(squared_length<Arch>(axis) + radius * radius));
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

/// Spheres around the shapes of a block.
template <class Arch>
struct BlockSpheres {
    using F = Floats<Arch>;

    float center[3][16], radius[16];

    void enclose(int kind, const float (*rows)[16]) {
        for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
            const SphereAround<Arch> spheres =
                sphere_around<Arch>(kind, BlockReader<Arch>(rows, from));
            spheres.center.x.store_unaligned(center[0] + from);
            spheres.center.y.store_unaligned(center[1] + from);
            spheres.center.z.store_unaligned(center[2] + from);
            spheres.radius.store_unaligned(radius + from);
        }
    }

    /// Those from lane `from` on.
    SphereAround<Arch> load(int from) const {
        return {{F::load_unaligned(center[0] + from), F::load_unaligned(center[1] + from),
                 F::load_unaligned(center[2] + from)},
                F::load_unaligned(radius + from)};
    }

    /// That of lane `lane` alone, to all lanes.
    SphereAround<Arch> broadcast(int lane) const {
        return {{F(center[0][lane]), F(center[1][lane]), F(center[2][lane])}, F(radius[lane])};
    }
};

} // namespace raylane::simd
