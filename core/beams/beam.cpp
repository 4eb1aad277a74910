#include "core/beams/beam.hpp"

namespace raylane::core {

BeamCone::BeamCone(const Beam& beam) {
    constexpr double more = 1.0 + 0x1p-40, less = 1.0 - 0x1p-40;
    Vec3d of_origin, of_direction;
    for (int axis = 0; axis < 3; ++axis) {
        origin_[axis] = beam.origin[axis].value;
        direction_[axis] = beam.direction[axis].value;
        of_origin[axis] = beam.origin[axis].spread();
        of_direction[axis] = beam.direction[axis].spread();
    }
    const double speed = length(direction_);
    width_ = length(of_origin) * more;
    growth_ = length(of_direction) * more;
    per_speed_ = 1.0 / speed;
    // If rays may run beside the axis, no upper bound on t exists.
    const double approach = speed * less - growth_;
    per_approach_ = approach > 0.0 ? 1.0 / approach : std::numeric_limits<double>::infinity();
}

BeamSlabs::BeamSlabs(const Beam& beam) {
    for (int axis = 0; axis < 3; ++axis) {
        const Affine& origin = beam.origin[axis];
        const Affine& direction = beam.direction[axis];
        lowest_[axis] = static_cast<float>(origin.lower());
        highest_[axis] = static_cast<float>(origin.upper());
        lowest_[axis] -= 0x1p-23F * std::abs(lowest_[axis]) + 0x1p-140F;
        highest_[axis] += 0x1p-23F * std::abs(highest_[axis]) + 0x1p-140F;
        slowest_[axis] = line(-direction.lower());
        fastest_[axis] = line(direction.upper());
    }
}

/// Returns the line of a speed. A speed near 0, of either sign, is replaced by a small positive
/// one, which gives a weaker bound on t.
BeamSlabs::Line BeamSlabs::line(double speed) {
    constexpr double least = 0x1p-100;
    if (std::abs(speed) < least) speed = least;
    return {static_cast<float>(1.0 / speed), speed > 0.0};
}

float BeamSlabs::near(const Bounds& box) const {
    float lower[3][block_size], upper[3][block_size];
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 4; ++i) {
            lower[axis][i] = box.lower[axis];
            upper[axis][i] = box.upper[axis];
        }
    return near4(lower, upper, 0)[0];
}

} // namespace raylane::core
