#pragma once

#include "tests/scenes/api/exam.hpp"

#include <limits>
#include <string>
#include <vector>

/// Checks the library's answers for rays and shapes in double against the oracle.
namespace raylane::tests {

inline constexpr double endless = std::numeric_limits<double>::infinity();

/// Owns the arrays of rays in double.
struct DoubleRays {
    std::vector<double> origin[3], direction[3], t_min, t_max;

    void add(const core::Ray<double>& ray, double after, double most) {
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis].push_back(ray.origin[axis]);
            direction[axis].push_back(ray.direction[axis]);
        }
        t_min.push_back(after);
        t_max.push_back(most);
    }
    std::size_t size() const { return t_min.size(); }
    DoubleRaySpan span() const {
        return {origin[0],    origin[1],    origin[2], direction[0],
                direction[1], direction[2], t_min,     t_max};
    }
};

struct DoubleAnswers {
    explicit DoubleAnswers(const Tracer& tracer, const DoubleRays& rays)
        : hits(rays.size()), t_double(rays.size(), -1.0), normals(rays.size()),
          blocked(rays.size(), 77), counts(rays.size(), 77) {
        HitSpan span = hits.span();
        span.t_double = t_double;
        normals.add_to(span);
        tracer.intersect(rays.span(), span);
        tracer.occluded(rays.span(), blocked);
        tracer.crossings(rays.span(), rows, {.normals = true, .normals_double = true});
        tracer.crossings(rays.span(), firsts, {.most = 1, .normals = true, .normals_double = true});
        tracer.count_crossings(rays.span(), counts);
    }
    Hits hits;
    std::vector<double> t_double;
    DoubleNormals normals;
    std::vector<std::uint8_t> blocked;
    std::vector<std::uint64_t> counts;
    CrossingRows rows, firsts; ///< all crossings, and at most one a ray
};

struct DoubleFaults {
    long rays = 0, hits = 0, shape = 0, t = 0, t_double = 0, normal = 0, side = 0, occlusion = 0,
         crossings = 0, double_normal = 0;
    std::string first; ///< the numbers of the first faulty query and of the expected answer
    long all() const {
        return shape + t + t_double + normal + side + occlusion + crossings + double_normal;
    }
};

/// Checks rays without limits, and with limits at the first three crossings and next to them.
/// Omits shapes that core finds invalid.
template <oracle::Variant Any>
void ask(const std::vector<Any>& given_shapes, const std::vector<core::Ray<double>>& rays,
         DoubleFaults& faults);

} // namespace raylane::tests
