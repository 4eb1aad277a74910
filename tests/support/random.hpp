#pragma once

#include "core/numbers/vector.hpp"

#include <cmath>
#include <cstdint>
#include <random>

/// Random numbers and vectors for tests, the same on each run.
namespace raylane::ray_sets {

using core::Vec3d;
using core::Vec3f;

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    int integer(int low, int high) {
        const std::int64_t count = std::int64_t{high} - low + 1;
        return static_cast<int>(
            low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(count)));
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    Vec3d cube(double size) {
        return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }
    Vec3d direction() {
        while (true) {
            const Vec3d v = cube(1.0);
            const double square = core::squared_length(v);
            if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
        }
    }
    Vec3f small_integers(int most) {
        return {static_cast<float>(integer(-most, most)), static_cast<float>(integer(-most, most)),
                static_cast<float>(integer(-most, most))};
    }
    Vec3f small_integers_not_zero(int most) {
        while (true) {
            const Vec3f v = small_integers(most);
            if (v != Vec3f(0.0F)) return v;
        }
    }

  private:
    std::mt19937_64 engine_;
};

/// Not inline, as g++ 12 drops the conversion to float and back where it vectorises it.
[[gnu::noinline]] inline Vec3f rounded(const Vec3d& v) {
    return core::convert<float>(v);
}
inline float rounded(double v) {
    return static_cast<float>(v);
}

/// Returns a random unit vector at right angles to v.
inline Vec3d across(const Vec3d& v, Random& random) {
    return core::normalized(core::cross(v, random.direction()));
}

/// Returns a vector within the plane, or tilted out of it by 1e-7 to 1e-1.
inline Vec3d nearly_across(const Vec3d& normal, Random& random) {
    const Vec3d n = core::normalized(normal);
    const double tilt = random.integer(0, 2) == 0 ? 0.0 : random.log_uniform(1e-7, 1e-1);
    return across(n, random) + n * tilt;
}

} // namespace raylane::ray_sets
