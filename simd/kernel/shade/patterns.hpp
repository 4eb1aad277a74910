#pragma once

#include "simd/kernel/lanes/elementary.hpp"
#include "simd/kernel/lanes/vectors.hpp"
#include "simd/units/shade_kernels.hpp"

/// Same patterns as core/scene/pattern.hpp, per lane.
namespace raylane::simd {

template <class Arch>
Vectors<Arch> broadcast_vector(const double (&v)[3]) {
    return {Floats<Arch>(v[0]), Floats<Arch>(v[1]), Floats<Arch>(v[2])};
}

template <class Arch>
struct Patterns {
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using Elementary = core::Elementary<F>;

    static F parity(const F& value) {
        const F to_round(0x1.8p24);
        const F cell = floor((value + to_round) - to_round);
        return cell - F(2.0) * floor(cell * F(0.5));
    }

    static Vectors<Arch> color_at(const MaterialView& material, const Vectors<Arch>& point) {
        const Vectors<Arch> first = broadcast_vector<Arch>(material.colors[0]);
        const Vectors<Arch> second = broadcast_vector<Arch>(material.colors[1]);
        switch (material.pattern) {
        case core::PatternKind::solid:
            return first;
        case core::PatternKind::checker: {
            const F zero(0.0), one(1.0);
            F sum = zero;
            const F* coordinates[3] = {&point.x, &point.y, &point.z};
            for (int axis = 0; axis < 3; ++axis) {
                if ((material.axes >> axis & 1) == 0) continue;
                const F cells = *coordinates[axis] / F(material.size);
                const bool holds_upper_edge = (material.axes >> (axis + 3) & 1) != 0;
                sum = sum + (holds_upper_edge ? one - parity(zero - cells) : parity(cells));
            }
            return select<Arch>(parity(sum) < one, first, second);
        }
        case core::PatternKind::stripes:
            return select<Arch>(
                parity(dot<Arch>(point, broadcast_vector<Arch>(material.direction)) /
                       F(material.size)) < F(1.0),
                first, second);
        case core::PatternKind::gradient: {
            const F raw = dot<Arch>(point - broadcast_vector<Arch>(material.from),
                                    broadcast_vector<Arch>(material.run));
            const F fraction = min(max(raw, F(0.0)), F(1.0));
            const F rest = F(1.0) - fraction;
            return {fraction * second.x + rest * first.x, fraction * second.y + rest * first.y,
                    fraction * second.z + rest * first.z};
        }
        case core::PatternKind::back_plane:
            return back_plane(point.x, point.y);
        }
        __builtin_unreachable();
    }

    static Vectors<Arch> back_plane(const F& x, const F& y) {
        const F zero(0.0);
        const M above = y > zero, below = y < zero;
        const M sun = (x * x + y * y < F(150.0)) & (above | below);
        const F root = sqrt(max(y, zero));
        const M sky = y >= zero;
        const Vectors<Arch> bands = select<Arch>(
            sky,
            Vectors<Arch>{abs(Elementary::sin_cos(x).cosine), abs(Elementary::sin_cos(root).sine),
                          abs(Elementary::sin_cos(root).cosine)},
            Vectors<Arch>{zero, zero, abs(Elementary::sin_cos(y).cosine)});
        const Vectors<Arch> orange{select(above, F(1.0), F(0.7)), F(0.2), zero};
        return select<Arch>(sun, orange, bands);
    }
};

} // namespace raylane::simd
