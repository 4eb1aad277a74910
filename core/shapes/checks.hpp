#pragma once

#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"

#include <string>

/// Checks the numbers of a scene. All functions named require_ throw InvalidValue.
namespace raylane::core {

/// Largest magnitude of coordinates and lengths, so that no product in the solvers can overflow.
inline constexpr float coordinate_limit = 1e30F;
/// Least magnitude of doubles that are not floats: the least normal float. Their error as floats is
/// therefore relative to them.
inline constexpr double min_double = 0x1p-126;

namespace checks {

/// Returns true if a number is representable as a float.
template <class Number>
bool is_float(Number number) {
    return static_cast<Number>(static_cast<float>(number)) == number;
}

/// The place of a number in a scene. It becomes text only for an error message: ten million spheres
/// have forty million places.
struct Field {
    const char* name;
    int row = -1;
    int column = -1;

    Field(const char* name_) : name(name_) {}
    Field at(int index) const {
        Field element = *this;
        (row < 0 ? element.row : element.column) = index;
        return element;
    }
    std::string text() const {
        std::string text = name;
        for (const int index : {row, column})
            if (index >= 0) text.append("/").append(std::to_string(index));
        return text;
    }
};

/// The following functions exist for float and double.
template <class Number>
std::string text_of(Number value);
template <class Number>
std::string text_of(const Vec3<Number>& v);

template <class Number>
[[noreturn]] void refuse(const Field& field, const std::string& must, Number got);
template <class Number>
void require(bool good, const Field& field, const char* must, Number got);
template <class Number>
void require_coordinate(const Field& field, Number value);
template <class Number>
void require_point(const Field& field, const Vec3<Number>& point);
template <class Number>
void require_direction(const Field& field, const Vec3<Number>& direction);
template <class Number>
void require_positive(const Field& field, Number value);
template <class Number>
void require_not_negative(const Field& field, Number value);
template <class Number>
void require_fraction(const Field& field, Number value);
void require_count(const char* field, int value, int least, int most);
/// Requires an enumerator from 0 to `last`.
template <class Enum>
void require_enumerator(const char* field, Enum value, Enum last) {
    if (value > last)
        throw InvalidValue(field, "must be one of its enumerators, 0 to " +
                                      std::to_string(static_cast<unsigned>(last)) + ", got " +
                                      std::to_string(static_cast<unsigned>(value)));
}

/// Requires three vectors, fields name/0 to name/2, to span a volume.
template <class Number>
void require_spanning(const char* name, const Vec3<Number>& u, const Vec3<Number>& v,
                      const Vec3<Number>& w);

/// Returns true if (b - a) x (c - a) is 0.
template <class Number>
bool are_collinear(const Vec3<Number>& a, const Vec3<Number>& b, const Vec3<Number>& c);

} // namespace checks
} // namespace raylane::core
