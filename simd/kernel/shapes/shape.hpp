#pragma once

#include "core/kinds.hpp"
#include "simd/kernel/lanes/vectors.hpp"

/// The shapes of core/shapes, one per lane. Each can be loaded from one shape's floats for all
/// lanes, or from a block of shapes, structure of arrays.
namespace raylane::simd {

/// Parts of the kernels for a kind of shape: from its own file, where it is specialised.
///   Numbers<Arch>           its floats; and, for what no ray of a frustum meets, spheres around
///   it:
///       enclosing() is one, or enclosing(end) one around each of its `ends`, which it is between;
///       or it `encloses_itself`
///   Solver<Arch, textbook>  has crossings(rays, starts) and outward_normal(point, face): core's
///       formulas, one shape per lane, in lanes of any numbers; by the textbooks' where there are
///       better ones
///   Filter<Arch>            float bounds on where rays cross it (filter.hpp)
///   Finisher<D>             its certified crossing in double (finisher.hpp)
/// Each is made of a reader, which gives the shape's floats one after the other. The solver in
/// numbers with bounds is what widens, and what comes behind it is core's.
template <class Shape>
struct ShapeKernels;

/// ShapeKernels by its parts.
template <template <class> class NumbersOf, template <class> class FilterOf,
          template <class, bool> class SolverOf, template <class> class FinisherOf>
struct ShapeKernelsOf {
    template <class Arch>
    using Numbers = NumbersOf<Arch>;
    template <class Arch>
    using Filter = FilterOf<Arch>;
    template <class Arch, bool textbook>
    using Solver = SolverOf<Arch, textbook>;
    template <class D>
    using Finisher = FinisherOf<D>;
};

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

/// In the order that the braces say. Where the numbers were named first, GCC 12 would keep a copy
/// of them in memory.
template <class Arch, class Reader>
[[gnu::always_inline]] inline Vectors<Arch> next_vector(Reader& reader) {
    return {reader.next(), reader.next(), reader.next()};
}

/// Reads what a solver or filter has derived from its shape's floats, and shows by derived(visit):
/// numbers of each shape that are the same for all rays.
template <class Reader>
struct Derived {
    Reader reader;
    auto next() { return reader.next(); }
};

/// Calls visit(number) for the numbers of some vectors and numbers.
template <class Visit, class... Values>
[[gnu::always_inline]] inline void visit_each(const Visit& visit, const Values&... values) {
    const auto one = [&](const auto& value) __attribute__((always_inline)) {
        if constexpr (requires { value.x; }) {
            visit(value.x);
            visit(value.y);
            visit(value.z);
        } else {
            visit(value);
        }
    };
    (one(values), ...);
}

/// Reads on behalf of another reader.
template <class Arch, class Reader>
struct PassOn {
    Reader& reader;
    Floats<Arch> next() { return reader.next(); }
};

} // namespace raylane::simd
