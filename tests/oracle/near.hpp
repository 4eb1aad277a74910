#pragma once

#include "core/shapes/ray.hpp"
#include "tests/any_shape.hpp"

#include <vector>

/// Finds the shapes that a line may cross, so that exact numbers need not test all of them. It
/// leaves out only shapes that the line is certain to miss.
namespace raylane::oracle {

using core::Vec3d;

class Neighbours {
  public:
    template <Variant Any>
    explicit Neighbours(const std::vector<Any>& shapes) {
        for (const Any& shape : shapes)
            balls_.push_back(ball_around(shape));
    }

    bool may_cross(std::size_t shape, const core::Ray<double>& ray) const {
        const Ball& ball = balls_[shape];
        const Vec3d from = ray.origin - ball.center;
        const double reach = ball.radius + 0x1p-40 * core::length(from);
        return core::length(core::cross(from, ray.direction)) <=
               reach * core::length(ray.direction) * (1.0 + 0x1p-20);
    }

  private:
    std::vector<Ball> balls_;
};

} // namespace raylane::oracle
