#pragma once

#include "core/kinds.hpp"
#include "simd/kernel/lanes/vectors.hpp"

/// The shapes of core/shapes, one per lane. They are loaded either from one shape's floats for all
/// lanes, or from a block of shapes in structure-of-arrays layout.
namespace raylane::simd {

/// The kernels' classes for one kind of shape. Each shape's file specialises it.
///   Numbers<Arch>           its floats, and its bounding spheres, by which frusta reject shapes:
///       enclosing() returns one sphere; or enclosing(end) returns one for each of the shape's
///       `ends`, and the shape lies between these; or `encloses_itself` is true for a sphere
///   Solver<Arch, textbook>  has crossings(rays, starts) and outward_normal(point, face): core's
///       formulas, one shape per lane, for lanes of any number type; if `textbook`, the textbook
///       formulas where core has better ones
///   Filter<Arch>            float bounds on a ray's crossing (filter.hpp)
///   Certified solver<D>             the certified first crossing in double (certified solver.hpp)
/// Each is constructed from a reader, which returns the shape's floats one after the other. To
/// extend precision, the solver runs in numbers with bounds. The stages after that are in core.
template <class Shape>
struct ShapeKernels;

/// ShapeKernels assembled from its parts.
template <template <class> class NumbersOf, template <class> class FilterOf,
          template <class, bool> class SolverOf, template <class> class CertifiedSolverOf>
struct ShapeKernelsOf {
    template <class Arch>
    using Numbers = NumbersOf<Arch>;
    template <class Arch>
    using Filter = FilterOf<Arch>;
    template <class Arch, bool textbook>
    using Solver = SolverOf<Arch, textbook>;
    template <class D>
    using CertifiedSolver = CertifiedSolverOf<D>;
};

/// Reads the floats of consecutive shapes of a block, one row after the other, from `lane` on.
template <class Arch>
class BlockReader {
  public:
    BlockReader(const float (*rows)[16], int lane) : rows_(rows), lane_(lane) {}
    Floats<Arch> next() { return Floats<Arch>::load_unaligned(*rows_++ + lane_); }

  private:
    const float (*rows_)[16];
    int lane_;
};

/// Reads the floats of the one shape in lane `lane` into all lanes.
template <class Arch>
class BroadcastReader {
  public:
    BroadcastReader(const float (*rows)[16], int lane) : rows_(rows), lane_(lane) {}
    Floats<Arch> next() { return Floats<Arch>((*rows_++)[lane_]); }

  private:
    const float (*rows_)[16];
    int lane_;
};

/// Reads three numbers in the order that braces guarantee. If they were variables first, GCC 12
/// would keep a copy of them in memory.
template <class Arch, class Reader>
[[gnu::always_inline]] inline Vectors<Arch> next_vector(Reader& reader) {
    return {reader.next(), reader.next(), reader.next()};
}

/// Reads the numbers that a solver or filter derives from its shape's floats and lists in
/// derived(visit). They are the same for all rays.
template <class Reader>
struct Derived {
    Reader reader;
    auto next() { return reader.next(); }
};

/// Calls visit(number) for each number in `values`, which are vectors and numbers.
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

/// A reader that reads from another one by reference, so that the other one advances.
template <class Arch, class Reader>
struct PassOn {
    Reader& reader;
    Floats<Arch> next() { return reader.next(); }
};

} // namespace raylane::simd
