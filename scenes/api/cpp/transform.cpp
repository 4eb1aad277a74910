#include "raylane/transform.hpp"

#include "core/shapes/checks.hpp"
#include "core/solids/transform.hpp"
#include "scenes/api/cpp/translate.hpp"

#include <utility>

namespace raylane {

namespace {

std::shared_ptr<const core::Transform> shared(core::Transform transform) {
    return std::make_shared<const core::Transform>(std::move(transform));
}

/// Returns a vector of an argument, whose numbers must be in range.
core::Vec3d checked(const char* field, const Vec3Of<double>& v) {
    const core::Vec3d vector(v.x, v.y, v.z);
    core::checks::require_point(field, vector);
    return vector;
}

core::Transform matrix_of(const std::array<std::array<double, 4>, 3>& rows) {
    double numbers[3][4];
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            const double number = rows[std::size_t(row)][std::size_t(column)];
            core::checks::require_coordinate(core::checks::Field("transform").at(row).at(column),
                                             number);
            numbers[row][column] = number;
        }
    return core::Transform::matrix(numbers);
}

} // namespace

Transform::Transform() : Transform(shared({})) {}

Transform::Transform(const std::array<std::array<double, 4>, 3>& rows)
    : Transform(library::translated([&] { return shared(matrix_of(rows)); })) {}

Transform::Transform(std::shared_ptr<const core::Transform> transform)
    : transform_(std::move(transform)) {}

Transform Transform::scaled(double factor) const {
    return scaled({factor, factor, factor});
}

Transform Transform::scaled(const Vec3Of<double>& factors) const {
    return library::translated([&] {
        return Transform(
            shared(core::Transform::scaling(checked("scale", factors)).after(*transform_)));
    });
}

Transform Transform::rotated(const Vec3Of<double>& degrees) const {
    return library::translated([&] {
        return Transform(
            shared(core::Transform::rotation(checked("rotate", degrees)).after(*transform_)));
    });
}

Transform Transform::translated(const Vec3Of<double>& by) const {
    return library::translated([&] {
        return Transform(
            shared(core::Transform::translation(checked("translate", by)).after(*transform_)));
    });
}

Transform Transform::then(const Transform& next) const {
    return library::translated(
        [&] { return Transform(shared(next.transform_->after(*transform_))); });
}

} // namespace raylane
