#pragma once

#include "core/numbers/bounded.hpp"
#include "core/numbers/vector.hpp"
#include "core/shapes/invalid_value.hpp"

#include <string>

/// Checks of the numbers that a scene may hold. All functions named require_ throw InvalidValue.
namespace raylane::core {

/// Coordinates and lengths are at most this large, so that no product in the solvers can overflow.
inline constexpr float coordinate_limit = 1e30F;

namespace checks {

/// The place of a number. Only a refusal puts it into words: ten million spheres have forty million
/// places.
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

std::string text_of(float value);
std::string text_of(const Vec3f& v);

[[noreturn]] void refuse(const Field& field, const std::string& must, float got);
void require(bool good, const Field& field, const char* must, float got);
void require_coordinate(const Field& field, float value);
void require_point(const Field& field, const Vec3f& point);
void require_direction(const Field& field, const Vec3f& direction);
void require_positive(const Field& field, float value);
void require_not_negative(const Field& field, float value);
void require_fraction(const Field& field, float value);
void require_count(const char* field, int value, int least, int most);
/// Requires an enumerator: one from 0 to `last`.
template <class Enum>
void require_enumerator(const char* field, Enum value, Enum last) {
    if (value > last)
        throw InvalidValue(field, "must be one of its enumerators, 0 to " +
                                      std::to_string(static_cast<unsigned>(last)) + ", got " +
                                      std::to_string(static_cast<unsigned>(value)));
}

/// Requires three vectors, fields name/0 to name/2, to span a volume.
void require_spanning(const char* name, const Vec3f& u, const Vec3f& v, const Vec3f& w);

using Wide = Bounded<DoubleDouble>;

/// True if an exact product of float coordinates is 0, or cannot be told from it in 106 bits.
bool vanishes(const Wide& a);
Vec3<Wide> wide(const Vec3f& v);
bool parallel(const Vec3<Wide>& a, const Vec3<Wide>& b);

} // namespace checks
} // namespace raylane::core
