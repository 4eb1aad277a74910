#pragma once

#include "simd/kernel/filters/axial.hpp"

namespace raylane::simd {

template <class Arch, bool capped>
struct CylinderFilter {
    static constexpr bool is_costly = true;
    static constexpr int values = 7;
    AxialFilter<Arch, false> axial;

    template <class Reader>
    explicit CylinderFilter(Reader reader) : axial(read(reader)) {}

    [[gnu::always_inline]] Mask<Arch> may_meet(const FilterRays<Arch>& rays) const {
        return axial.may_meet(rays);
    }

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        if constexpr (capped)
            return axial.capped_bounds(rays);
        else
            return axial.open_bounds(rays);
    }

  private:
    template <class Reader>
    static AxialFilter<Arch, false> read(Reader& reader) {
        const Vectors<Arch> base = next_vector<Arch>(reader), axis = next_vector<Arch>(reader);
        const Floats<Arch> radius = reader.next();
        return {base, axis, radius, radius};
    }
};

} // namespace raylane::simd
