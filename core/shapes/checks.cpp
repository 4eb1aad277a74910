#include "core/shapes/checks.hpp"

#include <charconv>
#include <cmath>

namespace raylane::core::checks {

std::string text_of(float value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string text_of(const Vec3f& v) {
    std::string text = "[";
    text.append(text_of(v.x)).append(", ").append(text_of(v.y)).append(", ");
    return text.append(text_of(v.z)).append("]");
}

void refuse(const Field& field, const std::string& must, float got) {
    throw InvalidValue(field.text(), must + ", got " + text_of(got));
}

void require(bool good, const Field& field, const char* must, float got) {
    if (!good) refuse(field, must, got);
}

void require_coordinate(const Field& field, float value) {
    require(std::abs(value) <= coordinate_limit, field, "must be a number from -1e30 to 1e30",
            value);
}

void require_point(const Field& field, const Vec3f& point) {
    for (int axis = 0; axis < 3; ++axis)
        require_coordinate(field.at(axis), point[axis]);
}

void require_direction(const Field& field, const Vec3f& direction) {
    require_point(field, direction);
    if (direction == Vec3f(0.0F))
        throw InvalidValue(field.text(), "must not be the zero vector, got [0, 0, 0]");
}

void require_positive(const Field& field, float value) {
    require(value > 0.0F, field, "must be positive", value);
    require_coordinate(field, value);
}

void require_not_negative(const Field& field, float value) {
    require(value >= 0.0F, field, "must not be negative", value);
    require_coordinate(field, value);
}

void require_fraction(const Field& field, float value) {
    require(value >= 0.0F && value <= 1.0F, field, "must be from 0 to 1", value);
}

void require_count(const char* field, int value, int least, int most) {
    if (value < least || value > most)
        throw InvalidValue(field, "must be from " + std::to_string(least) + " to " +
                                      std::to_string(most) + ", got " + std::to_string(value));
}

bool vanishes(const Wide& a) {
    return !(a.magnitude() > a.error);
}

Vec3<Wide> wide(const Vec3f& v) {
    return {Wide(static_cast<double>(v.x)), Wide(static_cast<double>(v.y)),
            Wide(static_cast<double>(v.z))};
}

void require_spanning(const char* name, const Vec3f& u, const Vec3f& v, const Vec3f& w) {
    const Field field(name);
    require_direction(field.at(0), u);
    require_direction(field.at(1), v);
    require_direction(field.at(2), w);
    if (vanishes(dot(cross(wide(u), wide(v)), wide(w))))
        throw InvalidValue(name, "must span a volume, got " + text_of(u) + ", " + text_of(v) +
                                     ", " + text_of(w));
}

bool parallel(const Vec3<Wide>& a, const Vec3<Wide>& b) {
    const Vec3<Wide> product = cross(a, b);
    return vanishes(product.x) && vanishes(product.y) && vanishes(product.z);
}

} // namespace raylane::core::checks
