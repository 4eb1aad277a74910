#pragma once

#include "simd/kernel/filters/axial.hpp"

namespace raylane::simd {

template <class Arch, bool capped>
struct ConeFilter {
    static constexpr bool is_costly = true;
    static constexpr int values = 8;
    AxialFilter<Arch, true> axial;

    template <class Reader>
    explicit ConeFilter(Reader reader) : axial(read(reader)) {}

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
    static AxialFilter<Arch, true> read(Reader& reader) {
        const Vectors<Arch> base = next_vector<Arch>(reader), axis = next_vector<Arch>(reader);
        const Floats<Arch> base_radius = reader.next(), top_radius = reader.next();
        return {base, axis, base_radius, top_radius};
    }
};

} // namespace raylane::simd
