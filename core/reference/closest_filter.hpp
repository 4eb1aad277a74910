#pragma once

#include "core/hierarchy/hierarchy.hpp"
#include "core/numbers/float4.hpp"
#include "core/shapes/types.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

/// Bounds on the distances of a point from the 16 children of a node, and from the 16 shapes of a
/// block, in plain doubles. They decide for nearly all shapes that these are not the closest. Loops
/// over lanes have no branches, so that compilers use registers.
namespace raylane::core {

/// Points with larger coordinates have no bounds: their squares might overflow.
inline constexpr double filter_limit = 0x1p500;

struct LaneBounds {
    double lower[block_size], upper[block_size];
};

/// Returns a number whose square is not less than that of a distance, for comparisons with squares
/// that may have underflowed.
inline double squared_limit(double distance) {
    const double at_least = std::max(distance, 0x1p-500);
    return at_least * at_least * (1.0 + 0x1p-48);
}
/// The same for squares in float.
inline double float_squared_limit(double distance) {
    const double at_least = std::max(distance, 0x1p-60);
    return at_least * at_least * (1.0 + 0x1p-48);
}

/// Stores lower bounds on the squared distances from the bounds of a node's entries. The factor
/// covers the roundings: half an ulp of each difference, square and sum.
inline void squared_distances(const WideNode& node, const Vec3d& point,
                              double (&squared)[block_size]) {
    for (double& lane : squared)
        lane = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        for (int lane = 0; lane < block_size; ++lane) {
            const double below = static_cast<double>(node.lower[axis][lane]) - point[axis];
            const double above = point[axis] - static_cast<double>(node.upper[axis][lane]);
            const double farther = below > above ? below : above;
            const double gap = farther > 0.0 ? farther : 0.0;
            squared[lane] += gap * gap;
        }
    for (double& lane : squared)
        lane *= 1.0 - 0x1p-49;
}

/// The same in float, for coordinates below 2^60. `point`: bounds of the point.
inline void squared_distances(const WideNode& node, const Bounds& point,
                              float (&squared)[block_size]) {
    constexpr int width = 4;
    for (int first = 0; first < block_size; first += width) {
        Float4 sum = all4(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            Float4 lower, upper;
            std::memcpy(&lower, node.lower[axis] + first, sizeof lower);
            std::memcpy(&upper, node.upper[axis] + first, sizeof upper);
            const Float4 gap =
                greatest(greatest(lower - all4(point.upper[axis]), all4(point.lower[axis]) - upper),
                         all4(0.0F));
            sum += gap * gap;
        }
        sum *= all4(1.0F - 0x1p-20F);
        std::memcpy(squared + first, &sum, sizeof sum);
    }
}
inline constexpr double float_filter_limit = 0x1p60;

/// Balls around the points of 16 shapes that are closest to a point, or around the whole shapes.
struct LaneBalls {
    double center[3][block_size], radius[block_size];
    double size[block_size]; ///< the sum of the numbers, which bounds their rounding errors

    void add_size(const float (&row)[block_size]) {
        for (int lane = 0; lane < block_size; ++lane)
            size[lane] += std::abs(static_cast<double>(row[lane]));
    }
};

namespace detail {

/// Row k of a block as doubles.
template <class Shape>
double value(const Block<Shape>& block, int row, int lane) {
    return static_cast<double>(block.values[row][lane]);
}

/// Returns the squared length of the vector in the rows from `row` on.
template <class Shape>
double squared_row(const Block<Shape>& block, int row, int lane) {
    const double x = value(block, row, lane), y = value(block, row + 1, lane),
                 z = value(block, row + 2, lane);
    return x * x + y * y + z * z;
}

/// The center, and the radius.
template <class Shape>
void fill_ball(const Block<Shape>& block, int radius_row, LaneBalls& balls) {
    for (int lane = 0; lane < block_size; ++lane) {
        for (int axis = 0; axis < 3; ++axis)
            balls.center[axis][lane] = value(block, axis, lane);
        balls.radius[lane] = value(block, radius_row, lane);
    }
}
inline void fill(const Block<Sphere>& block, const Vec3d&, LaneBalls& balls) {
    fill_ball(block, 3, balls);
}
inline void fill(const Block<Disc>& block, const Vec3d&, LaneBalls& balls) {
    fill_ball(block, 6, balls);
}

template <AnyTriangle Shape>
void fill(const Block<Shape>& block, const Vec3d&, LaneBalls& balls) {
    for (int lane = 0; lane < block_size; ++lane) {
        double corners[3] = {};
        for (int axis = 0; axis < 3; ++axis) {
            const double a = value(block, axis, lane), b = value(block, 3 + axis, lane),
                         c = value(block, 6 + axis, lane);
            const double center = (a + b + c) * (1.0 / 3.0);
            balls.center[axis][lane] = center;
            corners[0] += (a - center) * (a - center);
            corners[1] += (b - center) * (b - center);
            corners[2] += (c - center) * (c - center);
        }
        const double farther = corners[0] > corners[1] ? corners[0] : corners[1];
        balls.radius[lane] = std::sqrt(farther > corners[2] ? farther : corners[2]);
    }
}

inline void fill(const Block<Box>& block, const Vec3d&, LaneBalls& balls) {
    for (int lane = 0; lane < block_size; ++lane) {
        double diagonals[4] = {};
        for (int axis = 0; axis < 3; ++axis) {
            const double u = 0.5 * value(block, 3 + axis, lane),
                         v = 0.5 * value(block, 6 + axis, lane),
                         w = 0.5 * value(block, 9 + axis, lane);
            balls.center[axis][lane] = value(block, axis, lane) + u + v + w;
            diagonals[0] += (u + v + w) * (u + v + w);
            diagonals[1] += (u + v - w) * (u + v - w);
            diagonals[2] += (u - v + w) * (u - v + w);
            diagonals[3] += (u - v - w) * (u - v - w);
        }
        const double first = diagonals[0] > diagonals[1] ? diagonals[0] : diagonals[1];
        const double second = diagonals[2] > diagonals[3] ? diagonals[2] : diagonals[3];
        balls.radius[lane] = std::sqrt(first > second ? first : second);
    }
}

/// The ball around the closest point of the axis.
template <class Shape>
void fill_axial(const Block<Shape>& block, int top_radius_row, const Vec3d& point,
                LaneBalls& balls) {
    for (int lane = 0; lane < block_size; ++lane) {
        double along = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            along += (point[axis] - value(block, axis, lane)) * value(block, 3 + axis, lane);
        const double share = along / squared_row(block, 3, lane);
        const double at_least = share > 0.0 ? share : 0.0;
        const double nearest = at_least < 1.0 ? at_least : 1.0;
        for (int axis = 0; axis < 3; ++axis)
            balls.center[axis][lane] =
                value(block, axis, lane) + nearest * value(block, 3 + axis, lane);
        const double base = value(block, 6, lane), top = value(block, top_radius_row, lane);
        balls.radius[lane] = base > top ? base : top;
    }
}
template <Ends ends>
void fill(const Block<Cylinder<ends>>& block, const Vec3d& point, LaneBalls& balls) {
    fill_axial(block, 6, point, balls);
}
template <Ends ends>
void fill(const Block<Cone<ends>>& block, const Vec3d& point, LaneBalls& balls) {
    fill_axial(block, 7, point, balls);
}

/// No semi-axis is longer than the root of the sum of the squares of all axes.
inline void fill(const Block<Ellipsoid>& block, const Vec3d&, LaneBalls& balls) {
    for (int lane = 0; lane < block_size; ++lane) {
        for (int axis = 0; axis < 3; ++axis)
            balls.center[axis][lane] = value(block, axis, lane);
        balls.radius[lane] = std::sqrt(squared_row(block, 3, lane) + squared_row(block, 6, lane) +
                                       squared_row(block, 9, lane));
    }
}

/// The ball around the closest point of the box.
inline void fill(const Block<Quadric>& block, const Vec3d& point, LaneBalls& balls) {
    constexpr int lower = 13, upper = 16;
    for (int lane = 0; lane < block_size; ++lane)
        for (int axis = 0; axis < 3; ++axis) {
            const double center = value(block, axis, lane);
            const double from = center + value(block, lower + axis, lane),
                         to = center + value(block, upper + axis, lane);
            const double at_least = point[axis] > from ? point[axis] : from;
            balls.center[axis][lane] = at_least < to ? at_least : to;
            balls.radius[lane] = 0.0;
        }
}

} // namespace detail

/// Stores bounds on the distances from a block's shapes. Upper bounds are infinite for quadrics,
/// which may have no surface. `has_doubles`: the floats of the block are rounded. All errors are
/// less than a few ulps of the sum of all numbers.
template <class Shape>
void bound_distances(const Block<Shape>& block, const Vec3d& point, bool has_doubles,
                     LaneBounds& bounds) {
    LaneBalls balls;
    detail::fill(block, point, balls);
    std::fill_n(balls.size, block_size, std::abs(point.x) + std::abs(point.y) + std::abs(point.z));
    for (const auto& row : block.values)
        balls.add_size(row);
    const double rounding = has_doubles ? 0x1p-20 : 0x1p-48;
    for (int lane = 0; lane < block_size; ++lane) {
        double squared = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double off = point[axis] - balls.center[axis][lane];
            squared += off * off;
        }
        const double distance = std::sqrt(squared), error = rounding * balls.size[lane];
        const double above = distance - balls.radius[lane];
        constexpr bool is_sphere = kind_of<Shape> == Kind::sphere;
        const double height = is_sphere ? std::abs(above) : above;
        const double lower = height - error;
        bounds.lower[lane] = lower > 0.0 ? lower : 0.0;
        bounds.upper[lane] = is_sphere ? height + error
                             : kind_of<Shape> == Kind::quadric
                                 ? infinity<double>
                                 : distance + balls.radius[lane] + error;
    }
}

} // namespace raylane::core
