#pragma once

#include "bench/ceiling/ceiling.hpp"
#include "core/shapes/shapes.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <vector>

/// Computes the floats from which the loops of ceiling.hpp read each shape. This happens once per
/// scene and in double.
namespace raylane::bench {

using core::convert;
using core::Vec3d;

class Numbers {
  public:
    void add(double value) { all_.push_back(static_cast<float>(value)); }
    void add(const Vec3d& v) {
        for (int axis = 0; axis < 3; ++axis)
            add(v[axis]);
    }
    void add(const core::Vec3f& v) { add(convert<double>(v)); }
    const float* data() const { return all_.data(); }

  private:
    std::vector<float> all_;
};

inline Vec3d unit(const Vec3d& v) {
    return core::normalized(v);
}

inline void prepare(const core::Sphere& s, Numbers& numbers) {
    numbers.add(s.center);
    numbers.add(static_cast<double>(s.radius));
    numbers.add(1.0 / static_cast<double>(s.radius));
}

inline void prepare(const core::Plane& p, Numbers& numbers) {
    numbers.add(p.point);
    numbers.add(unit(convert<double>(p.normal)));
}

inline void prepare(const core::Disc& d, Numbers& numbers) {
    numbers.add(d.center);
    numbers.add(unit(convert<double>(d.normal)));
    numbers.add(static_cast<double>(d.radius) * static_cast<double>(d.radius));
}

inline void prepare(const core::Triangle& t, Numbers& numbers) {
    const Vec3d b = convert<double>(t.b) - convert<double>(t.a);
    const Vec3d c = convert<double>(t.c) - convert<double>(t.a);
    numbers.add(t.a);
    numbers.add(b);
    numbers.add(c);
    numbers.add(unit(core::cross(b, c)));
}

inline void prepare(const core::SmoothTriangle& t, Numbers& numbers) {
    prepare(core::Triangle{t.a, t.b, t.c}, numbers);
}

/// Returns the rows of the inverse of the matrix with the columns u, v and w.
inline glm::dmat3 inverse_rows(const core::Vec3f& u, const core::Vec3f& v, const core::Vec3f& w) {
    return glm::transpose(
        glm::inverse(glm::dmat3(convert<double>(u), convert<double>(v), convert<double>(w))));
}

inline void prepare(const core::Box& box, Numbers& numbers) {
    numbers.add(box.corner);
    const glm::dmat3 rows = inverse_rows(box.edge_u, box.edge_v, box.edge_w);
    for (int i = 0; i < 3; ++i) {
        numbers.add(Vec3d(rows[i]));
        numbers.add(unit(rows[i]));
    }
}

inline void prepare_axial(const core::Vec3f& base, const core::Vec3f& axis, double base_radius,
                          double top_radius, Numbers& numbers) {
    const double length = core::length(convert<double>(axis));
    numbers.add(base);
    numbers.add(unit(convert<double>(axis)));
    numbers.add(length);
    numbers.add(base_radius * base_radius);
    numbers.add((top_radius - base_radius) / length);
    numbers.add(base_radius);
}
template <core::Ends ends>
void prepare(const core::Cylinder<ends>& c, Numbers& numbers) {
    const auto radius = static_cast<double>(c.radius);
    prepare_axial(c.base, c.axis, radius, radius, numbers);
}
template <core::Ends ends>
void prepare(const core::Cone<ends>& c, Numbers& numbers) {
    prepare_axial(c.base, c.axis, static_cast<double>(c.base_radius),
                  static_cast<double>(c.top_radius), numbers);
}

inline void prepare(const core::Quadric& q, Numbers& numbers) {
    numbers.add(q.center);
    for (const float value : {q.xx, q.yy, q.zz, q.xy, q.xz, q.yz, q.x, q.y, q.z, q.one})
        numbers.add(static_cast<double>(value));
    numbers.add(q.lower);
    numbers.add(q.upper);
}

inline void prepare(const core::Ellipsoid& e, Numbers& numbers) {
    numbers.add(e.center);
    const glm::dmat3 rows = inverse_rows(e.axis_u, e.axis_v, e.axis_w);
    for (int i = 0; i < 3; ++i)
        numbers.add(Vec3d(rows[i]));
}

} // namespace raylane::bench
