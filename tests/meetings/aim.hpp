#pragma once

#include "core/shapes/ray.hpp"
#include "tests/meetings/frame.hpp"
#include "tests/support/any_shape.hpp"

namespace raylane::meetings {

/// Place of the frame's origin in the world, and the length of 1 there. Coordinates are exact as
/// far as floats have the bits.
class Place {
  public:
    Place(const Vec3f& offset, double size) : offset_(offset), size_(size) {}

    /// Returns a place of a size from about 1e-6 to 1e6, sometimes at the lower end of floats.
    static Place any(Random& random) {
        const int power = random.integer(0, 19) == 0  ? random.integer(-142, -125)
                          : random.integer(0, 2) == 0 ? 0
                                                      : random.integer(-20, 20);
        Place place(Vec3f(0.0F), std::ldexp(1.0, power));
        switch (random.integer(0, 5)) {
        case 0: // near the origin, so that few bits suffice
            place.offset_ = random.small_integers(8);
            break;
        case 1: // far away: shapes are rounded
            place.offset_ = ray_sets::rounded(random.direction() * random.log_uniform(1.0, 1e6));
            break;
        default:
            break;
        }
        return place;
    }
    Place moved(const Vec3d& by) const { return {offset_ + ray_sets::rounded(by), size_}; }

    double size() const { return size_; }
    Vec3d operator()(const Vec3d& point) const {
        return size_ * (core::convert<double>(offset_) + point);
    }
    AnyShape operator()(const AnyShape& shape) const {
        return tests::Placing(offset_, static_cast<float>(size_))(shape);
    }

  private:
    Vec3f offset_;
    double size_;
};

/// Aims rays at a point where shapes meet. The shapes touch in the frame's plane of x and y there.
class Aim {
  public:
    /// `at` is in the frame's coordinates.
    Aim(const Frame& frame, const Place& place, const Vec3d& at)
        : frame_(frame), place_(place), at_(frame(at)) {}

    /// Returns a ray through the meeting, or past it by 1e-12 to 1e-3 or by small integers. Its
    /// direction has small integers, lies in the common tangent plane or almost, or is random. It
    /// starts near or far, on either side.
    core::Ray<float> ray(Random& random) const {
        const Vec3d way = way_of(random), past = at_ + frame_(past_of(random));
        double before = random.integer(-4, 4);
        if (random.integer(0, 2) == 0) before = random.log_uniform(1e-3, 1e7);
        const Vec3f origin = ray_sets::rounded(place_(past - before * frame_(way)));
        Vec3d direction = frame_(way);
        if (random.integer(0, 2) == 0) direction *= random.log_uniform(1e-3, 1e3);
        // From the rounded origin towards the exact target.
        if (random.integer(0, 2) == 0 && before != 0.0)
            direction = (place_(past) - core::convert<double>(origin)) / place_.size();
        Vec3f rounded = ray_sets::rounded(direction);
        if (rounded == Vec3f(0.0F)) rounded.x = 1.0F;
        return {origin, rounded};
    }

  private:
    static Vec3d whole(Random& random, int most) {
        return core::convert<double>(random.small_integers(most));
    }
    static Vec3d way_of(Random& random) {
        Vec3d way;
        switch (random.integer(0, 5)) {
        case 0:
            way = whole(random, 2) * Vec3d(1.0, 1.0, 0.0);
            break;
        case 1:
            way = whole(random, 1) * Vec3d(1.0, 1.0, 0.0);
            way.z = random.log_uniform(1e-12, 1e-1);
            break;
        case 2:
            way = {0.0, 0.0, 1.0};
            break;
        case 3:
            way = {random.log_uniform(1e-12, 1.0), random.log_uniform(1e-12, 1e-1), -1.0};
            break;
        case 4:
            way = random.direction();
            break;
        default:
            way = whole(random, 4);
        }
        if (way == Vec3d(0.0)) way.x = 1.0;
        return way;
    }
    static Vec3d past_of(Random& random) {
        Vec3d past(0.0);
        switch (random.integer(0, 3)) {
        case 0:
            return random.direction() * random.log_uniform(1e-12, 1e-3);
        case 1:
            past = whole(random, 3);
            past.z = random.integer(-1, 1);
            return past;
        case 2:
            past[random.integer(0, 2)] = random.log_uniform(1e-12, 1e-3);
            return past;
        default:
            return past;
        }
    }

    Frame frame_;
    Place place_;
    Vec3d at_; // in the place's coordinates
};

} // namespace raylane::meetings
