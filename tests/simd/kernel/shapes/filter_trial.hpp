#pragma once

#include "core/shapes/shape_table.hpp"
#include "core/shapes/solve.hpp"
#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"
#include "tests/simd/kernel/shapes/filter_check.hpp"
#include "tests/support/random.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

/// Tests one ray or many with the filters and checks the answers.
namespace raylane::filter_trial {

using namespace core;
using namespace simd;

inline FilterChecks checks_of(Isa isa) {
    return of_isa(isa, []<Isa which>() { return filter_checks<which>(); });
}

/// An exact ray, and the rounded ray that filters get.
struct Doubled {
    Ray<double> ray;
    Ray<float> rounded;
    float slack;

    explicit Doubled(const Ray<double>& meant) : ray(meant) {
        rounded = {ray_sets::rounded(ray.origin), ray_sets::rounded(ray.direction)};
        const double moved = length(Vec3d(convert<double>(rounded.origin) - ray.origin));
        slack = std::nextafter(static_cast<float>(moved * (1.0 + 0x1p-16) + 0x1p-68),
                               std::numeric_limits<float>::infinity());
    }
};

inline Ray<double> with_unit_direction(Ray<double> ray) {
    ray.direction = normalized(ray.direction);
    return ray;
}

/// The first crossing with t > 0, and a bound on the error of t. It is not known if a crossing has
/// no bound even in double-double, for example of a line that touches a cone's extension.
struct First {
    double t = infinity<double>;
    double error = 0.0;
    bool known = true;
    bool exists() const { return t < infinity<double>; }
};

template <class Shape>
First first_crossing(const Shape& shape, const Ray<double>& ray) {
    std::uint64_t widened = 0;
    First first;
    for (const core::Crossing<double>& crossing : solve(shape, ray, Start{}, widened)) {
        first.known = first.known && crossing.error < infinity<double>;
        if (!(crossing.t > 0.0 && crossing.t < first.t)) continue;
        first.t = crossing.t;
        first.error = crossing.error;
    }
    return first;
}

struct Answer {
    bool possible;
    double lower;
    bool certain;
    double upper;
    bool may_meet;
    bool contradicts;
};

/// Owns the arrays of a stream.
class Stream {
  public:
    void add(const Doubled& ray) {
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis].push_back(ray.rounded.origin[axis]);
            direction_[axis].push_back(ray.rounded.direction[axis]);
        }
        slack_.push_back(ray.slack);
    }

    FilterStream view() {
        const std::size_t count = slack_.size(), padded = (count + 15) / 16 * 16;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis].resize(padded, nan);
            direction_[axis].resize(padded, nan);
        }
        slack_.resize(padded, nan);
        for (std::vector<float>& out : out_)
            out.assign(padded, 0.0F);
        return {count,
                {origin_[0].data(), origin_[1].data(), origin_[2].data()},
                {direction_[0].data(), direction_[1].data(), direction_[2].data()},
                slack_.data(),
                out_[0].data(),
                out_[1].data(),
                out_[2].data(),
                out_[3].data(),
                out_[4].data(),
                out_[5].data()};
    }

    Answer answer(std::size_t i) const {
        return {out_[0][i] != 0.0F, static_cast<double>(out_[1][i]),
                out_[2][i] != 0.0F, static_cast<double>(out_[3][i]),
                out_[4][i] != 0.0F, out_[5][i] != 0.0F};
    }
    std::size_t padded() const { return slack_.size(); }

  private:
    std::array<std::vector<float>, 3> origin_, direction_;
    std::vector<float> slack_;
    std::array<std::vector<float>, 6> out_;
};

template <class Shape>
ShapeBlock view_of(const Block<Shape>& block) {
    return {block.values, reinterpret_cast<const float*>(block.ids)};
}

/// Returns the fault of an answer, or null if it is right.
inline const char* lie(const Answer& answer, const First& truth) {
    if (answer.contradicts) return "the blocking state contradicts the bounds";
    if (!truth.known) return nullptr;
    if (truth.exists() && !answer.possible) return "an existing crossing was called impossible";
    if (truth.exists() && !answer.may_meet) return "an existing crossing was skipped";
    if (truth.exists() && !(answer.lower <= truth.t + truth.error)) return "lower is too high";
    if (answer.possible && !(answer.lower >= 0.0)) return "lower is negative";
    if (answer.certain && !truth.exists()) return "a missing crossing was called certain";
    if (answer.certain && !answer.possible) return "certain, but not possible";
    if (answer.certain && !(answer.upper >= truth.t - truth.error)) return "upper is too low";
    return nullptr;
}

} // namespace raylane::filter_trial
