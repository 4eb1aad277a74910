#pragma once

#include "simd/kernel/shapes/crossings.hpp"

/// The shapes of core/shapes/shapes.hpp, one per lane. Each can be loaded from one shape's floats
/// for all lanes, or from a block of shapes, structure of arrays.
namespace raylane::simd {

/// Reads the floats of one shape after the other from a block: row k, from `lane` on.
template <class Arch>
class BlockReader {
  public:
    BlockReader(const float (*rows)[16], int lane) : rows_(rows), lane_(lane) {}
    Floats<Arch> next() { return Floats<Arch>::load_unaligned(*rows_++ + lane_); }

  private:
    const float (*rows_)[16];
    int lane_;
};

/// The same for lane `lane` alone, to all lanes.
template <class Arch>
class BroadcastReader {
  public:
    BroadcastReader(const float (*rows)[16], int lane) : rows_(rows), lane_(lane) {}
    Floats<Arch> next() { return Floats<Arch>((*rows_++)[lane_]); }

  private:
    const float (*rows_)[16];
    int lane_;
};

template <class Arch, class Reader>
[[gnu::always_inline]] inline Vectors<Arch> next_vector(Reader& reader) {
    const Floats<Arch> x = reader.next(), y = reader.next(), z = reader.next();
    return {x, y, z};
}

} // namespace raylane::simd
