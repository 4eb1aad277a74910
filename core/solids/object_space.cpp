#include "core/solids/object_space.hpp"

namespace raylane::core {

ObjectSpace space_moved_by(const std::array<Vec3d, 3>& axes, const Vec3d& origin) {
    ObjectSpace space{origin, axes};
    space.rows = {cross(axes[1], axes[2]), cross(axes[2], axes[0]), cross(axes[0], axes[1])};
    const double volume = dot(space.rows[0], axes[0]);
    for (Vec3d& row : space.rows)
        row = {row.x / volume, row.y / volume, row.z / volume};
    return space;
}

ObjectSpace space_moved_by(const Placement& placement) {
    const std::array<Vec3d, 3> rows = rows_of(placement);
    std::array<Vec3d, 3> axes{};
    for (int i = 0; i < 3; ++i)
        axes[static_cast<std::size_t>(i)] = {rows[0][i], rows[1][i], rows[2][i]};
    return space_moved_by(axes, placement.translate);
}

ObjectSpace moved(const ObjectSpace& space, const ObjectSpace& outer) {
    const auto in_scene = [&](const Vec3d& v) {
        return v.x * outer.axes[0] + v.y * outer.axes[1] + v.z * outer.axes[2];
    };
    ObjectSpace result;
    result.origin = in_scene(space.origin) + outer.origin;
    for (std::size_t i = 0; i < 3; ++i) {
        result.axes[i] = in_scene(space.axes[i]);
        result.rows[i] = space.rows[i].x * outer.rows[0] + space.rows[i].y * outer.rows[1] +
                         space.rows[i].z * outer.rows[2];
    }
    return result;
}

SpaceMover::SpaceMover(const Transform& by) : by_(space_moved_by(by.columns(), by.origin())) {}

void SpaceMover::operator()(Solid& solid) {
    if (solid.made == Made::of_shape) solid.space = (*this)(solid.space);
    for (Solid& part : solid.parts)
        (*this)(part);
}

std::shared_ptr<const ObjectSpace>
SpaceMover::operator()(const std::shared_ptr<const ObjectSpace>& space) {
    if (after_ == nullptr || space != before_) {
        before_ = space;
        after_ = std::make_shared<const ObjectSpace>(space == nullptr ? by_ : moved(*space, by_));
    }
    return after_;
}

} // namespace raylane::core
