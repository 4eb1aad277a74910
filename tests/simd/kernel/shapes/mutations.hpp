#pragma once

#include "core/scene/validate.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/simd/kernel/shapes/hard_cases.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

/// Small changes of rays and shapes, for searches that climb to where a bound is nearly broken.
namespace raylane::mutations {

using namespace hard_cases;

template <class Shape>
struct Attempt {
    Shape shape;
    Ray<double> ray;
};

/// Returns the exact numbers in C++'s notation.
template <class Shape>
std::string description(const Shape& shape, const Ray<double>& ray) {
    std::ostringstream out;
    out << std::hexfloat;
    for (const float value : numbers_of(shape))
        out << value << "F, ";
    for (const Vec3d& v : {ray.origin, ray.direction})
        out << "{" << v.x << ", " << v.y << ", " << v.z << "} ";
    return out.str();
}

template <class Shape>
bool is_valid(const Shape& shape) {
    try {
        validate(shape);
    } catch (const InvalidValue&) {
        return false;
    }
    return true;
}

inline float stepped(float value, int ulps) {
    const float towards =
        std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(ulps));
    for (int i = std::abs(ulps); i > 0; --i)
        value = std::nextafter(value, towards);
    return value;
}

/// Rounds to `bits` significant bits.
inline double snapped(double value, int bits) {
    if (value == 0.0 || !std::isfinite(value)) return value;
    const int exponent = std::ilogb(value) - bits;
    return std::ldexp(std::round(std::ldexp(value, -exponent)), exponent);
}

/// Applies `change` to some of a shape's floats.
template <class Shape, class Change>
Shape some_changed(const Shape& shape, Random& random, const Change& change) {
    Numbers<Shape> floats = numbers_of(shape);
    const int one_in = random.integer(1, number_count<Shape>);
    for (float& value : floats)
        if (random.integer(1, one_in) == 1) value = static_cast<float>(change(value));
    return shape_of<Shape>(floats);
}

template <class Shape>
void change_shape(Shape& shape, Random& random) {
    switch (random.integer(0, 3)) {
    case 0: {
        const double size = random.log_uniform(1e-8, 1e-1);
        shape = some_changed(shape, random, [&](float value) {
            return static_cast<double>(value) * (1.0 + size * random.uniform(-1.0, 1.0));
        });
        return;
    }
    case 1:
        shape = some_changed(shape, random,
                             [&](float value) { return stepped(value, random.integer(-2, 2)); });
        return;
    case 2:
        shape = some_changed(shape, random,
                             [&](float value) { return std::ldexp(value, random.integer(-1, 1)); });
        return;
    default: {
        const int bits = random.integer(1, 12);
        shape = some_changed(
            shape, random, [&](float value) { return snapped(static_cast<double>(value), bits); });
    }
    }
}

inline void change_direction(Vec3d& d, Random& random) {
    const int axis = random.integer(0, 2);
    switch (random.integer(0, 5)) {
    case 0:
        d[axis] = random.integer(0, 1) == 0 ? 0.0 : d[(axis + 1) % 3];
        break;
    case 1:
        d[axis] = snapped(d[axis], random.integer(1, 12));
        break;
    case 2:
        d[axis] = -d[axis];
        break;
    default:
        d += random.direction() * random.log_uniform(1e-16, 1e-1);
        break;
    }
    if (d == Vec3d(0.0)) d[axis] = 1.0;
}

template <class Shape>
void change_origin(Vec3d& origin, const Vec3d& direction, const Shape& shape, Random& random) {
    using T = ray_sets::Target<Shape>;
    const Vec3d center = T::center(shape);
    const double size = random.log_uniform(1e-12, 1e-1);
    switch (random.integer(0, 5)) {
    case 0:
        origin += random.direction() * (size * length(origin));
        break;
    case 1:
        for (int axis = 0; axis < 3; ++axis)
            origin[axis] = static_cast<double>(
                stepped(static_cast<float>(origin[axis]), random.integer(-2, 2)));
        break;
    case 2: { // along the ray, to another order of magnitude
        const double distance = dot(Vec3d(center - origin), direction);
        origin += direction * (distance * (1.0 - std::ldexp(1.0, random.integer(-2, 2))));
        break;
    }
    case 3: {
        const int bits = random.integer(1, 12);
        for (int axis = 0; axis < 3; ++axis)
            if (random.integer(0, 1) == 0) origin[axis] = snapped(origin[axis], bits);
        break;
    }
    case 4: // keeps the aim
        origin = center + (origin - center) * (1.0 + size * random.uniform(-1.0, 1.0));
        break;
    default:
        origin += direction * (random.uniform(-1.0, 1.0) * size * T::size(shape));
        break;
    }
}

template <class Shape>
Attempt<Shape> mutated(Attempt<Shape> attempt, Random& random) {
    do {
        switch (random.integer(0, 7)) {
        case 0:
        case 1:
            change_shape(attempt.shape, random);
            break;
        case 2: {
            const int a = random.integer(0, 2), b = (a + 1) % 3;
            swap_axes(attempt.shape, a, b);
            std::swap(attempt.ray.origin[a], attempt.ray.origin[b]);
            std::swap(attempt.ray.direction[a], attempt.ray.direction[b]);
            break;
        }
        case 3:
        case 4:
            change_direction(attempt.ray.direction, random);
            break;
        default:
            change_origin(attempt.ray.origin, attempt.ray.direction, attempt.shape, random);
            break;
        }
    } while (random.integer(0, 2) == 0);
    return attempt;
}

} // namespace raylane::mutations
