#pragma once

#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/lanes/bounded.hpp"
#include "simd/kernel/shapes/crossings.hpp"

#include <cstddef>

namespace raylane::simd {

/// Reads the numbers of a shape per lane, all of one table, as lanes of double or of float.
template <class Number>
struct SlotReader {
    using F = Floats<Number>;
    using Value = typename F::value_type;
    static constexpr std::size_t width = F::size;

    const float* floats;
    const double* doubles; ///< null: none
    long long offset[width];
    long long row = 0;

    explicit SlotReader(const TableView& table) : floats(table.blocks), doubles(table.doubles) {}

    F next() {
        Value values[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            values[lane] = at(offset[lane] + row);
        row += 16;
        return F::load_unaligned(values);
    }

    Value at(long long place) const {
        if constexpr (std::is_same_v<Value, double>)
            if (doubles != nullptr) return doubles[place];
        return static_cast<Value>(floats[place]);
    }
};

/// The same as numbers with bounds.
template <class D, class Number>
struct CertifiedSlotReader {
    SlotReader<D> reader;
    Floats<Certified<Number>> next() { return Floats<Certified<Number>>(reader.next()); }
};

/// Rays that are exactly what their doubles say.
template <class Number, class D>
Rays<Certified<Number>> certified(const Rays<D>& rays) {
    using C = Certified<Number>;
    const auto vectors = [](const Vectors<D>& v) {
        return Vectors<C>{Floats<C>(v.x), Floats<C>(v.y), Floats<C>(v.z)};
    };
    return {vectors(rays.origin), vectors(rays.direction)};
}

} // namespace raylane::simd
