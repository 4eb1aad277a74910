#include "core/solids/placement.hpp"

#include "core/shapes/checks.hpp"

#include <cmath>
#include <string>
#include <variant>

namespace raylane::core {

namespace {

/// Returns the double as Transform rounds numbers: below `min_double`, the nearest float; no -0.
double settled(double nearest) {
    if (std::abs(nearest) < min_double)
        return static_cast<double>(static_cast<float>(nearest)) + 0.0;
    return nearest;
}

/// Rounds a sum of products, whose terms are at most `size` together. Returns false if the error
/// leaves the nearest double in doubt.
bool round(const DoubleDouble& sum, double size, double& nearest) {
    const double error = 0x1p-92 * size;
    nearest = settled(sum.high);
    return std::abs(sum.high) > 0x1p-500 && sum.high + (sum.low + error) == sum.high &&
           sum.high + (sum.low - error) == sum.high;
}

/// Computes the rows of a placement's linear map in this type. `rows`: zeros.
template <class Number>
void set_rows(const Placement& placement, Number (&rows)[3][3]) {
    for (int axis = 0; axis < 3; ++axis)
        rows[axis][axis] = placement.scale;
    for (int axis = 0; axis < 3; ++axis) {
        if (placement.rotate[axis] == 0.0) continue;
        const auto [sine, cosine] = turn_by_degrees(placement.rotate[axis]);
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        for (int column = 0; column < 3; ++column) {
            const Number a = rows[j][column], b = rows[k][column];
            rows[j][column] = Number(cosine) * a - Number(sine) * b;
            rows[k][column] = Number(sine) * a + Number(cosine) * b;
        }
    }
}

void check_number(const std::string& field, double value) {
    if (!(std::abs(value) <= 1e30))
        throw InvalidValue(field, "must be from -1e30 to 1e30, got " + checks::text_of(value));
}

} // namespace

void validate(const Placement& placement) {
    for (int axis = 0; axis < 3; ++axis) {
        check_number("translate/" + std::to_string(axis), placement.translate[axis]);
        check_number("rotate/" + std::to_string(axis), placement.rotate[axis]);
    }
    check_number("scale", placement.scale);
    if (!(placement.scale > 0.0))
        throw InvalidValue("scale", "must be positive, got " + checks::text_of(placement.scale));
}

Transform transform_of(const Placement& placement) {
    return Transform::translation(placement.translate)
        .after(Transform::rotation(placement.rotate)
                   .after(Transform::scaling(Vec3d(placement.scale))));
}

bool can_place(const PartShape& shape) {
    return std::holds_alternative<SphereOf<double>>(shape) ||
           std::holds_alternative<CylinderOf<double, Ends::open>>(shape) ||
           std::holds_alternative<CylinderOf<double, Ends::capped>>(shape);
}

Placer::Placer(const Placement& placement)
    : placement_(placement), turns_(placement.rotate != Vec3d(0.0)) {
    set_rows(placement, rows_);
}

std::array<Vec3d, 3> rows_of(const Placement& placement) {
    double rows[3][3]{};
    set_rows(placement, rows);
    std::array<Vec3d, 3> result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = {rows[i][0], rows[i][1], rows[i][2]};
    return result;
}

bool Placer::place_point(const Vec3d& point, Vec3d& placed) const {
    bool sure = true;
    for (int axis = 0; axis < 3; ++axis) {
        const double by = placement_.translate[axis];
        if (!turns_) {
            placed[axis] =
                settled(placement_.scale == 1.0 ? point[axis] + by
                                                : std::fma(placement_.scale, point[axis], by));
            continue;
        }
        DoubleDouble sum = by;
        double size = 0.0;
        for (int k = 0; k < 3; ++k) {
            if (rows_[axis][k].high == 0.0 || point[k] == 0.0) continue;
            sum = sum + rows_[axis][k] * DoubleDouble(point[k]);
            size += placement_.scale * std::abs(point[k]);
        }
        if (size == 0.0)
            placed[axis] = settled(by);
        else
            sure &= round(sum, size + std::abs(by), placed[axis]);
    }
    return sure;
}

bool Placer::place_vector(const Vec3d& vector, Vec3d& placed) const {
    Placer still = *this;
    still.placement_.translate = Vec3d(0.0);
    return still.place_point(vector, placed);
}

template <class Shape>
Shape Placer::exactly(const Shape& shape) const {
    return std::get<Shape>(transform_of(placement_)(of_shape(shape)).shape);
}

SphereOf<double> Placer::operator()(const SphereOf<double>& shape) const {
    SphereOf<double> placed{{}, settled(shape.radius * placement_.scale)};
    return place_point(shape.center, placed.center) ? placed : exactly(shape);
}

template <Ends ends>
CylinderOf<double, ends> Placer::operator()(const CylinderOf<double, ends>& shape) const {
    CylinderOf<double, ends> placed{{}, {}, settled(shape.radius * placement_.scale)};
    const bool sure = place_point(shape.base, placed.base) && place_vector(shape.axis, placed.axis);
    return sure ? placed : exactly(shape);
}

template CylinderOf<double, Ends::open>
Placer::operator()(const CylinderOf<double, Ends::open>&) const;
template CylinderOf<double, Ends::capped>
Placer::operator()(const CylinderOf<double, Ends::capped>&) const;

} // namespace raylane::core
