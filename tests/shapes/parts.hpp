#pragma once

#include "core/shapes/ray.hpp"
#include "tests/meetings/touching.hpp"
#include "tests/oracle/ball.hpp"
#include "tests/oracle/normal.hpp"
#include "tests/placing.hpp"
#include "tests/simd/nest.hpp"
#include "tests/simd/variation.hpp"
#include "tests/target.hpp"

#include <array>

/// Parts that tests know of a shape, all of them in its own file here:
///   tests::Nature                  what tests choose it by
///   ray_sets::Target               how to make it, and where to aim at it
///   oracle::crossings, normal      where a line crosses it, in exact numbers
///   oracle::ball_around            what it is within
///   tests::placed                  the same elsewhere and larger
///   meetings::Touching             one that touches others
///   tests::NestOf                  one close between others
///   tests::Restated                one surface in other numbers
///   tests::Written                 one as a file and a program have it
///   tests::Seamed                  solids: where their faces meet
///   tests::distance_to_face        solids, and what has_displacement
///   hard_cases::scaled, extreme, swap_axes   where they are not the usual ones
/// A part that is missing and asked for does not compile.
namespace raylane::tests {

/// Traits of a surface: each shape's Nature is Solid, Flat or Curved, and may differ from the usual
/// in what else there is.
struct AnySurface {
    static constexpr bool is_bounded = true;
    /// Rays that leave it outward may meet it again.
    static constexpr bool may_come_back = false;
    /// There is a bound to how far float may displace it.
    static constexpr bool has_displacement = false;
    /// Many of them may be one polygon.
    static constexpr bool tiles_polygons = false;
    /// Its filter also tells, at a glance, what passes it by.
    static constexpr bool is_sifted = false;
};
/// Closed: what enters it leaves it.
struct Solid : AnySurface {};
/// Rays that leave it do not meet it again.
struct Flat : AnySurface {};
/// It ends at a rim, and what goes inward from it may meet it again.
struct Curved : AnySurface {};

template <class Shape>
struct Nature;

/// One surface, said in ways that are the same in real numbers and whose numbers differ, by i = 0,
/// 1, 2, ..., as far as there are any.
template <class Shape>
struct Restated;

/// Solids made of small integers, and points, four of a solid's, where two of its faces meet or its
/// wall ends in a point: on small integers too as far as there are any.
template <class Shape>
struct Seamed;

/// Text of one such shape's object in a scene file, `text`, and the same by_name<Shape>() of
/// fields, which are the library's as they are core's.
template <class Shape>
struct Written;

using Seams = std::array<Vec3f, 4>;

/// Number whose fifths make Pythagorean triples.
inline float five_times(int least, Random& random) {
    return static_cast<float>(5 * random.integer(least, 2));
}

} // namespace raylane::tests
