#pragma once

#include "simd/kernel/shapes/shapes.hpp"

namespace raylane::simd {

/// Bounding spheres of the shapes of a block, in memory. The spheres of a block of spheres are the
/// block's rows. A cylinder or cone has a sphere around each end, and lies between them.
template <class Arch>
class BlockSpheres {
    using F = Floats<Arch>;

  public:
    const float *center[2][3], *radius[2]; ///< by end, for 16 shapes
    int ends;

    /// Encloses the shapes of a block up to lane `end` - 1.
    void enclose(core::Kind kind, const float (*rows)[16], int end = 16) {
        with_shape(kind, [&]<class Shape>() { enclose<Shape>(rows, end); });
    }

    BlockSpheres() = default;
    BlockSpheres(const BlockSpheres&) = delete; // refers to itself
    BlockSpheres& operator=(const BlockSpheres&) = delete;

    /// Returns the bounding sphere of a shape without ends, in all lanes.
    SphereAround<Arch> broadcast(int lane) const {
        return {{F(center[0][0][lane]), F(center[0][1][lane]), F(center[0][2][lane])},
                F(radius[0][lane])};
    }

  private:
    template <class Shape>
    void enclose(const float (*rows)[16], int filled) {
        using Numbers = typename ShapeKernels<Shape>::template Numbers<Arch>;
        constexpr bool is_own = requires {
            Numbers::encloses_itself;
        };
        constexpr bool has_ends = requires {
            Numbers::ends;
        };
        ends = has_ends ? 2 : 1;
        for (int end = 0; end < 2; ++end) {
            for (int axis = 0; axis < 3; ++axis)
                center[end][axis] = is_own ? rows[axis] : own_[end][axis];
            radius[end] = is_own ? rows[3] : own_[end][3];
        }
        if constexpr (!is_own)
            for (int from = 0; from < filled; from += static_cast<int>(F::size)) {
                const Numbers shapes(BlockReader<Arch>(rows, from));
                if constexpr (has_ends)
                    for (int end = 0; end < 2; ++end)
                        store(shapes.enclosing(end), end, from);
                else
                    store(shapes.enclosing(), 0, from);
            }
    }

    void store(const SphereAround<Arch>& spheres, int end, int from) {
        spheres.center.x.store_unaligned(own_[end][0] + from);
        spheres.center.y.store_unaligned(own_[end][1] + from);
        spheres.center.z.store_unaligned(own_[end][2] + from);
        spheres.radius.store_unaligned(own_[end][3] + from);
    }

    float own_[2][4][16];
};

} // namespace raylane::simd
