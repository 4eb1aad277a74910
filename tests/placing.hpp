#pragma once

#include "core/shapes/shapes.hpp"

#include <variant>

namespace raylane::tests {

using core::Vec3f;

using AnyShape =
    std::variant<core::Sphere, core::Plane, core::Disc, core::Triangle, core::SmoothTriangle,
                 core::Box, core::OpenCylinder, core::CappedCylinder, core::OpenCone,
                 core::CappedCone, core::Quadric>;

/// A shape moved by `offset`, then enlarged about the origin. Exact where the results are floats:
/// for powers of two, and offsets that the sums have room for.
class Placing {
  public:
    Placing(const Vec3f& offset, float factor) : offset_(offset), factor_(factor) {}

    core::Sphere operator()(const core::Sphere& s) const {
        return {point(s.center), s.radius * factor_};
    }
    core::Plane operator()(const core::Plane& p) const { return {point(p.point), p.normal}; }
    core::Disc operator()(const core::Disc& d) const {
        return {point(d.center), d.normal, d.radius * factor_};
    }
    core::Triangle operator()(const core::Triangle& t) const {
        return {point(t.a), point(t.b), point(t.c)};
    }
    core::SmoothTriangle operator()(const core::SmoothTriangle& t) const {
        return {point(t.a), point(t.b), point(t.c), t.normal_a, t.normal_b, t.normal_c};
    }
    core::Box operator()(const core::Box& b) const {
        return {point(b.corner), b.edge_u * factor_, b.edge_v * factor_, b.edge_w * factor_};
    }
    template <core::Ends ends>
    core::Cylinder<ends> operator()(const core::Cylinder<ends>& c) const {
        return {point(c.base), c.axis * factor_, c.radius * factor_};
    }
    template <core::Ends ends>
    core::Cone<ends> operator()(const core::Cone<ends>& c) const {
        return {point(c.base), c.axis * factor_, c.base_radius * factor_, c.top_radius * factor_};
    }
    /// The form is that of p / factor.
    core::Quadric operator()(core::Quadric q) const {
        q.center = point(q.center);
        for (float* square : {&q.xx, &q.yy, &q.zz, &q.xy, &q.xz, &q.yz})
            *square /= factor_ * factor_;
        for (float* linear : {&q.x, &q.y, &q.z})
            *linear /= factor_;
        q.lower *= factor_;
        q.upper *= factor_;
        return q;
    }
    AnyShape operator()(const AnyShape& any) const {
        return std::visit([&](const auto& shape) { return AnyShape((*this)(shape)); }, any);
    }

    Vec3f point(const Vec3f& p) const { return (p + offset_) * factor_; }

  private:
    Vec3f offset_;
    float factor_;
};

} // namespace raylane::tests
