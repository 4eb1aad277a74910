#pragma once

#include "core/shapes/ray.hpp"
#include "tests/placing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

/// Which of many shapes a line may cross: all but those that it surely passes by, so that exact
/// numbers need not ask each.
namespace raylane::oracle {

using core::Vec3d;
using tests::AnyShape;

/// All of a shape is within.
struct Ball {
    Vec3d center;
    double radius;
};

class BallAround {
  public:
    Ball operator()(const core::Sphere& s) const { return about(s.center, wide(s.radius)); }
    Ball operator()(const core::Plane& p) const {
        return {wide(p.point), std::numeric_limits<double>::infinity()};
    }
    Ball operator()(const core::Disc& d) const { return about(d.center, wide(d.radius)); }
    template <class AnyTriangle>
    requires requires(AnyTriangle triangle) { triangle.c; }
    Ball operator()(const AnyTriangle& t) const {
        return about(t.a, std::max(distance(t.a, t.b), distance(t.a, t.c)));
    }
    Ball operator()(const core::Box& b) const {
        return about(b.corner, size(b.edge_u) + size(b.edge_v) + size(b.edge_w));
    }
    template <core::Ends ends>
    Ball operator()(const core::Cylinder<ends>& c) const {
        return about(c.base, size(c.axis) + wide(c.radius));
    }
    template <core::Ends ends>
    Ball operator()(const core::Cone<ends>& c) const {
        return about(c.base, size(c.axis) + wide(std::max(c.base_radius, c.top_radius)));
    }
    Ball operator()(const core::Quadric& q) const {
        return about(q.center, size(q.lower) + size(q.upper));
    }

  private:
    static constexpr double slack = 1.0 + 0x1p-20; // far more than what is rounded here

    static double wide(float value) { return static_cast<double>(value); }
    static Vec3d wide(const core::Vec3f& v) { return core::convert<double>(v); }
    static double size(const core::Vec3f& v) { return core::length(wide(v)); }
    static double distance(const core::Vec3f& a, const core::Vec3f& b) {
        return core::length(wide(b) - wide(a));
    }
    static Ball about(const core::Vec3f& center, double radius) {
        return {wide(center), radius * slack};
    }
};

class Neighbours {
  public:
    explicit Neighbours(std::span<const AnyShape> shapes) {
        for (const AnyShape& shape : shapes)
            balls_.push_back(std::visit(BallAround(), shape));
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
