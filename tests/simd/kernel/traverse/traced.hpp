#pragma once

#include "core/reference/search.hpp"
#include "core/scene/scene.hpp"
#include "simd/query/query.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

/// Rays for the tracing kernels, and the kernels' answers.
namespace raylane::tests {

using namespace core;
using namespace simd;
using ray_sets::Random;

inline constexpr std::uint32_t all_kinds = (1U << core::kind_count) - 1;

template <class Shape>
void add(SceneBuilder& builder, Random& random, int count) {
    for (int i = 0; i < count; ++i)
        builder.add(ray_sets::Target<Shape>::make(random, false), 0);
}

/// Returns a scene of shapes of each bounded kind, or, if `overlapping`, of spheres around one
/// point, so that rays have the whole tree in front of them. Planes are in no tree.
inline Scene make_scene(bool overlapping, int planes = 0, int node_width = 16) {
    Random random(5);
    Workers workers(node_width);
    SceneBuilder builder;
    builder.workers = &workers;
    builder.wants_light = false;
    builder.add_material({});
    if (overlapping) {
        for (int i = 0; i < 2000; ++i)
            builder.add(Sphere{ray_sets::rounded(random.cube(1.0)),
                               static_cast<float>(random.uniform(4.0, 5.0))},
                        0);
        return std::move(builder).build();
    }
    for (int i = 0; i < planes; ++i)
        builder.add(
            Plane{ray_sets::rounded(random.cube(8.0)), ray_sets::rounded(random.direction())}, 0);
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        if constexpr (is_bounded<Shape>)
            add<Shape>(builder, random, kind_of<Shape> == Kind::sphere ? 200 : 40);
    });
    return std::move(builder).build();
}

/// Rays from random origins in random directions, some along planes and axes.
struct Rays {
    std::size_t count, padded;
    std::vector<double> ray[6];
    std::vector<float> rounded[7], t_limit;
    std::vector<std::uint32_t> origin_first, origin_last;

    Rays(std::size_t n, double size)
        : count(n), padded((n + 31) / 16 * 16), t_limit(padded), origin_first(padded, no_slot),
          origin_last(padded, no_slot) {
        Random random(7);
        for (std::vector<double>& values : ray)
            values.assign(padded, 1.0);
        for (std::vector<float>& values : rounded)
            values.resize(padded);
        for (std::size_t i = 0; i < n; ++i) {
            Vec3d origin = random.cube(size), direction = random.direction();
            if (i % 4 == 1) { // along planes and axes, or almost
                constexpr double little[] = {0.0, -0.0, 1e-40, -1e-40, 1e-12, -1e-33};
                for (int axis = random.integer(0, 2), k = 0; k < random.integer(1, 2); ++k)
                    direction[(axis + k) % 3] = little[random.integer(0, 5)];
                if (squared_length(direction) < 1e-3) direction.x = 1.0;
                direction /= std::sqrt(squared_length(direction));
            }
            if (i % 8 == 2) origin = 50.0 * origin, direction = normalized(random.cube(3) - origin);
            if (i % 16 == 3) origin = convert<double>(ray_sets::rounded(origin)) * 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                ray[axis][i] = origin[axis];
                ray[3 + axis][i] = direction[axis];
            }
            t_limit[i] = static_cast<float>(random.log_uniform(0.05, 30.0));
        }
    }

    RoundedRays round(const Kernels& kernels) {
        const RoundedRays result = {{rounded[0].data(), rounded[1].data(), rounded[2].data()},
                                    {rounded[3].data(), rounded[4].data(), rounded[5].data()},
                                    rounded[6].data(),
                                    origin_first.data(),
                                    origin_last.data(),
                                    {ray[0].data(), ray[1].data(), ray[2].data()},
                                    {ray[3].data(), ray[4].data(), ray[5].data()}};
        kernels.rays.round_rays(count, result, 0.0F);
        return result;
    }

    void aim(std::size_t i, const Vec3d& direction) {
        for (int axis = 0; axis < 3; ++axis)
            ray[3 + axis][i] = direction[axis];
    }

    /// Starts the ray on the shapes of these ids.
    void leave(std::size_t i, ShapeId first, ShapeId last) {
        origin_first[i] = first;
        origin_last[i] = last;
    }
    bool leaves(std::size_t i, ShapeId id) const {
        return origin_first[i] <= id && id <= origin_last[i];
    }

    void start(std::size_t i, const Vec3d& origin) {
        for (int axis = 0; axis < 3; ++axis)
            ray[axis][i] = origin[axis];
    }

    /// Puts the ray's origin in one plane, where each 16 rays fill a square beside the last 16.
    void stay_near(std::size_t i) {
        const double row = static_cast<double>(i / 64), along = static_cast<double>(i % 64 / 16);
        ray[0][i] = 0.2 * (4.0 * along + static_cast<double>(i % 4));
        ray[1][i] = -9.0;
        ray[2][i] = 0.2 * (4.0 * row + static_cast<double>(i / 4 % 4)) - 4.0;
    }

    Ray<double> get(std::size_t i) const {
        return {{ray[0][i], ray[1][i], ray[2][i]}, {ray[3][i], ray[4][i], ray[5][i]}};
    }
};

/// The kernels' answer for each ray.
struct Answers {
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    std::vector<float> first, second;
    std::vector<std::uint32_t> slot;
    std::vector<std::uint8_t> state;

    explicit Answers(std::size_t padded)
        : first(padded, infinity), second(padded, infinity), slot(padded, no_slot),
          state(padded, unblocked) {}
    Candidates candidates() { return {first.data(), second.data(), slot.data()}; }

    /// Returns whether both have the same answer for a ray, except beyond the distance that is
    /// certain.
    bool agree(const Answers& other, std::size_t i) const {
        const float beyond = first[i] * culling_slack;
        return first[i] == other.first[i] && (slot[i] == other.slot[i] || second[i] == first[i]) &&
               (second[i] == other.second[i] || !(std::min(second[i], other.second[i]) < beyond));
    }
};

/// A scene in the kernels' terms, with memory for `capacity` rays.
struct Traced {
    Scene scene;
    SceneData data{scene};
    Workspace workspace{};
    Arena arena;

    Traced(Scene traced_scene, std::size_t capacity)
        : scene(std::move(traced_scene)),
          arena(arena_for([&](Arena& a) { workspace = workspace_for(data, a, capacity); })) {}
    Traced(const Traced&) = delete; // parts of it refer to others
    Traced& operator=(const Traced&) = delete;

    static const TraceKernels& exactly(const Kernels& kernels) {
        return Tracing{&kernels, Precision::exact}.method().trace;
    }

    Hit<double> nearest(const Ray<double>& ray) {
        return searcher_.nearest(ray, {}, [](const Hit<double>&) { return true; }).hit;
    }

    /// Checks that the answer for a ray does not contradict the nearest hit.
    void check(const Answers& answers, std::size_t i, const Hit<double>& hit) const {
        const auto first = static_cast<double>(answers.first[i]);
        const auto seen_to =
            static_cast<double>(std::min(answers.second[i], answers.first[i] * culling_slack));
        CAPTURE(i, hit.t, first, seen_to);
        if (hit.any() && !(first <= hit.t * (1 + 1e-12))) FAIL("passed the nearest by");
        if (hit.any() && hit.t < seen_to && answers.slot[i] != data.slot_of(hit.kind, hit.place))
            FAIL("another shape");
    }

  private:
    Searcher<double> searcher_{scene, Search::hierarchy};
};

} // namespace raylane::tests
