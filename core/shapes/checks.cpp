#include "core/shapes/checks.hpp"

#include "core/numbers/bounded.hpp"
#include "core/numbers/dyadic.hpp"

#include <charconv>
#include <cmath>
#include <type_traits>

namespace raylane::core::checks {

template <class Number>
std::string text_of(Number value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Number>
std::string text_of(const Vec3<Number>& v) {
    std::string text = "[";
    text.append(text_of(v.x)).append(", ").append(text_of(v.y)).append(", ");
    return text.append(text_of(v.z)).append("]");
}

template <class Number>
void refuse(const Field& field, const std::string& must, Number got) {
    throw InvalidValue(field.text(), must + ", got " + text_of(got));
}

template <class Number>
void require(bool good, const Field& field, const char* must, Number got) {
    if (!good) refuse(field, must, got);
}

namespace {

/// `least`: the message for a double that is too small.
template <class Number>
void require_in_range(const Field& field, Number value, const char* least) {
    require(std::abs(value) <= Number(coordinate_limit), field,
            "must be a number from -1e30 to 1e30", value);
    if constexpr (std::is_same_v<Number, double>)
        require(std::abs(value) >= min_double || is_float(value), field, least, value);
}

} // namespace

template <class Number>
void require_coordinate(const Field& field, Number value) {
    require_in_range(field, value, "must be 0 or at least 1.2e-38 in size");
}

template <class Number>
void require_point(const Field& field, const Vec3<Number>& point) {
    for (int axis = 0; axis < 3; ++axis)
        require_coordinate(field.at(axis), point[axis]);
}

template <class Number>
void require_direction(const Field& field, const Vec3<Number>& direction) {
    require_point(field, direction);
    if (direction == Vec3<Number>(Number(0)))
        throw InvalidValue(field.text(), "must not be the zero vector, got [0, 0, 0]");
}

template <class Number>
void require_positive(const Field& field, Number value) {
    require(value > Number(0), field, "must be positive", value);
    require_in_range(field, value, "must be at least 1.2e-38");
}

template <class Number>
void require_not_negative(const Field& field, Number value) {
    require(value >= Number(0), field, "must not be negative", value);
    require_coordinate(field, value);
}

template <class Number>
void require_fraction(const Field& field, Number value) {
    require(value >= Number(0) && value <= Number(1), field, "must be from 0 to 1", value);
}

void require_count(const char* field, int value, int least, int most) {
    if (value < least || value > most)
        throw InvalidValue(field, "must be from " + std::to_string(least) + " to " +
                                      std::to_string(most) + ", got " + std::to_string(value));
}

namespace {

using Extended = Bounded<DoubleDouble>;

/// Returns true if volume() is 0. Uses numbers with bounds, and exact ones if these leave a doubt.
template <class Volume>
bool vanishes(const Volume& volume) {
    const Extended wide = volume(std::type_identity<Extended>());
    if (wide.magnitude() > wide.error) return false;
    return volume(std::type_identity<Dyadic>()).sign() == 0;
}

} // namespace

template <class Number>
void require_spanning(const char* name, const Vec3<Number>& u, const Vec3<Number>& v,
                      const Vec3<Number>& w) {
    const Field field(name);
    require_direction(field.at(0), u);
    require_direction(field.at(1), v);
    require_direction(field.at(2), w);
    const bool flat = vanishes([&]<class Real>(std::type_identity<Real>) {
        return dot(cross(convert<Real>(u), convert<Real>(v)), convert<Real>(w));
    });
    if (flat)
        throw InvalidValue(name, "must span a volume, got " + text_of(u) + ", " + text_of(v) +
                                     ", " + text_of(w));
}

template <class Number>
bool are_collinear(const Vec3<Number>& a, const Vec3<Number>& b, const Vec3<Number>& c) {
    const auto component_vanishes = [&](int i, int j) {
        return vanishes([&]<class Real>(std::type_identity<Real>) {
            const auto edge = [&](const Vec3<Number>& to, int axis) {
                return Real(Real(to[axis]) - Real(a[axis]));
            };
            return Real(Real(edge(b, i) * edge(c, j)) - Real(edge(b, j) * edge(c, i)));
        });
    };
    return component_vanishes(1, 2) && component_vanishes(2, 0) && component_vanishes(0, 1);
}

#define RAYLANE_INSTANTIATE(Number)                                                                \
    template std::string text_of(Number);                                                          \
    template std::string text_of(const Vec3<Number>&);                                             \
    template void refuse(const Field&, const std::string&, Number);                                \
    template void require(bool, const Field&, const char*, Number);                                \
    template void require_coordinate(const Field&, Number);                                        \
    template void require_point(const Field&, const Vec3<Number>&);                                \
    template void require_direction(const Field&, const Vec3<Number>&);                            \
    template void require_positive(const Field&, Number);                                          \
    template void require_not_negative(const Field&, Number);                                      \
    template void require_fraction(const Field&, Number);                                          \
    template void require_spanning(const char*, const Vec3<Number>&, const Vec3<Number>&,          \
                                   const Vec3<Number>&);                                           \
    template bool are_collinear(const Vec3<Number>&, const Vec3<Number>&, const Vec3<Number>&);
RAYLANE_INSTANTIATE(float)
RAYLANE_INSTANTIATE(double)
#undef RAYLANE_INSTANTIATE

} // namespace raylane::core::checks
