#include "scenes/formats/json/transform.hpp"

#include <algorithm>
#include <vector>

namespace raylane::scenes {

bool has_transform(const JsonValue& object) {
    return std::any_of(transform_keys.begin(), transform_keys.end(),
                       [&](std::string_view key) { return object.find(key).has_value(); });
}

core::Transform transform_of(const JsonValue& object) {
    using core::Transform;
    if (const auto matrix = object.find("transform")) {
        for (const std::string_view key : transform_keys)
            if (key != "transform") object.exclude("transform", key);
        double numbers[3][4];
        const std::vector<JsonValue> rows = matrix->array(3, "rows");
        for (std::size_t row = 0; row < 3; ++row) {
            const std::vector<JsonValue> values = rows[row].array(4, "numbers");
            for (std::size_t column = 0; column < 4; ++column)
                numbers[row][column] = values[column].real();
        }
        return checked(object, [&] { return Transform::matrix(numbers); });
    }
    Transform transform;
    if (const auto scale = object.find("scale")) {
        const bool is_even = scale->is_number();
        const core::Vec3d by = is_even ? core::Vec3d(scale->real()) : scale->real_vector();
        if (is_even && by.x == 0.0) scale->fail_expecting("other than 0");
        transform = checked(object, [&] { return Transform::scaling(by); });
    }
    if (const auto rotate = object.find("rotate"))
        transform = Transform::rotation(rotate->real_vector()).after(transform);
    if (const auto translate = object.find("translate"))
        transform = Transform::translation(translate->real_vector()).after(transform);
    return transform;
}

} // namespace raylane::scenes
