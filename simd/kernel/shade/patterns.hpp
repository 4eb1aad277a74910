#pragma once

#include "simd/kernel/lanes/vectors.hpp"
#include "simd/units/shade_kernels.hpp"

/// Same patterns as core/scene/pattern.hpp, per lane, except formulas.
namespace raylane::simd {

template <class Arch>
Vectors<Arch> broadcast_vector(const double (&v)[3]) {
    return {Floats<Arch>(v[0]), Floats<Arch>(v[1]), Floats<Arch>(v[2])};
}

template <class Arch>
struct Patterns {
    using F = Floats<Arch>;

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
        case core::PatternKind::formula: // see Formulas
        case core::PatternKind::image:   // see HitPaths::pattern
        case core::PatternKind::cutaway:
            return first;
        }
        __builtin_unreachable();
    }
};

} // namespace raylane::simd
