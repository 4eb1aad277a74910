#pragma once

#include "simd/stream/stream_tracer.hpp"
#include "tests/support/catch.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace raylane::tests {

/// Owns the columns of a stream of rays. Columns of limits and of shapes may stay empty.
struct StreamColumns {
    std::vector<float> columns[6], t_min, t_max;
    std::vector<core::ShapeId> leaves;

    void add(const core::Ray<float>& ray) {
        for (int axis = 0; axis < 3; ++axis) {
            columns[axis].push_back(ray.origin[axis]);
            columns[3 + axis].push_back(ray.direction[axis]);
        }
    }
    std::size_t size() const { return columns[0].size(); }
    core::Ray<double> get(std::size_t i) const {
        const auto at = [&](int k) { return static_cast<double>(columns[k][i]); };
        return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
    }
    simd::RayStream<float> view() const { return view(0, size()); }
    simd::RayStream<float> view(std::size_t first, std::size_t count) const {
        const auto from = [&](const auto& column) {
            return column.empty() ? nullptr : column.data() + first;
        };
        return {count,
                {from(columns[0]), from(columns[1]), from(columns[2])},
                {from(columns[3]), from(columns[4]), from(columns[5])},
                from(t_min),
                from(t_max),
                from(leaves)};
    }
};

/// The nearest hits of a stream of rays, and whether they are occluded.
struct RayAnswers {
    std::vector<float> t, normal[3];
    std::vector<core::ShapeId> shape;
    std::vector<std::uint8_t> entering, occluded;

    RayAnswers(const simd::StreamTracer& tracer, const simd::RayStream<float>& rays)
        : t(rays.count), shape(rays.count), entering(rays.count), occluded(rays.count) {
        for (std::vector<float>& component : normal)
            component.resize(rays.count);
        tracer.nearest(rays, {t.data(),
                              {normal[0].data(), normal[1].data(), normal[2].data()},
                              shape.data(),
                              entering.data()});
        tracer.occluded(rays, occluded.data());
    }
};

/// Returns the number of floats that differ in any bit.
inline long differing(const std::vector<float>& a, const std::vector<float>& b) {
    long count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i]) ? 0 : 1;
    return count;
}

/// Checks that two tracers give the same answers to the bit.
inline void check_same(const RayAnswers& found, const RayAnswers& expected) {
    CHECK(differing(found.t, expected.t) == 0);
    for (int axis = 0; axis < 3; ++axis)
        CHECK(differing(found.normal[axis], expected.normal[axis]) == 0);
    CHECK(found.shape == expected.shape);
    CHECK(found.entering == expected.entering);
    CHECK(found.occluded == expected.occluded);
}

} // namespace raylane::tests
