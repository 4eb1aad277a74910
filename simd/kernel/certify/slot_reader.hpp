#pragma once

#include "simd/kernel/lanes/bounded.hpp"
#include "simd/kernel/shapes/crossings.hpp"

#include <cstddef>

namespace raylane::simd {

/// Reads the floats of a shape per lane, each from a block of its own.
template <class D>
struct SlotReader {
    static constexpr std::size_t width = Floats<D>::size;
    const float* from[width];
    std::size_t row = 0;

    Floats<D> next() {
        double values[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            values[lane] = static_cast<double>(from[lane][row]);
        row += 16;
        return Floats<D>::load_unaligned(values);
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
