#include "raylane/raylane.hpp"
#include "tests/scenes/library/ray_arrays.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

/// What shapes in double cost: a dozen shapes of a kind and the rays that tests are made of, in
/// double, through the library by one thread; with shapes of floats, the same enlarged to doubles
/// that are none, and with a twin beside each shape that differs from it by an ulp of double in one
/// number: so close that only exact numbers tell which is first. Nanoseconds a ray on average, and
/// microseconds of the worst one by itself, nearest hits and all crossings.
///
/// usage: raylane-doubles
namespace raylane::bench {
namespace {

using core::Vec3d;
using tests::Random, tests::Set;

constexpr std::size_t ray_count = 1 << 12, alone_count = 1 << 9;
constexpr int shape_count = 12;
constexpr double enlarged = 1.0 + 13 * 0x1p-24; // exact with a float

enum class Numbers { floats, doubles, twins };

struct Rays {
    std::vector<double> values[6];

    DoubleRaySpan span(std::size_t first, std::size_t count) const {
        const auto part = [&](int k) { return std::span(values[k]).subspan(first, count); };
        return {part(0), part(1), part(2), part(3), part(4), part(5)};
    }
};

template <class Shape>
core::InDouble<Shape> enlarge(const Shape& shape) {
    auto numbers = core::numbers_of(core::to_doubles(shape));
    for (double& number : numbers)
        number *= enlarged;
    return core::shape_of<core::InDouble<Shape>>(numbers);
}

template <class Shape>
Shape twin_of(const Shape& shape, Random& random) {
    auto numbers = core::numbers_of(shape);
    double& number =
        numbers[static_cast<std::size_t>(random.integer(0, static_cast<int>(numbers.size()) - 1))];
    number = std::nextafter(number, random.integer(0, 1) == 0 ? -HUGE_VAL : HUGE_VAL);
    return core::shape_of<Shape>(numbers);
}

template <class Shape>
void add(SceneBuilder& builder, const Shape& shape) {
    try {
        builder.add(std::bit_cast<typename tests::InLibrary<Shape>::Type>(shape), 0);
    } catch (const InvalidValue&) { // a twin need not be valid
    }
}

template <class Shape>
Scene make(Numbers wanted, Set set, Rays& rays) {
    Random random(static_cast<std::uint64_t>(core::kind_of<Shape>) + 1);
    SceneBuilder builder;
    builder.add_material({});
    std::vector<Shape> shapes;
    for (int i = 0; i < shape_count; ++i) {
        shapes.push_back(ray_sets::Target<Shape>::make(random, set == Set::lattice));
        if (wanted == Numbers::floats)
            add(builder, shapes.back());
        else
            add(builder, enlarge(shapes.back()));
        if (wanted == Numbers::twins) add(builder, twin_of(enlarge(shapes.back()), random));
    }
    Random of_rays(7);
    for (std::size_t i = 0; i < ray_count; ++i) {
        const core::Ray<float> ray =
            ray_sets::make_ray(shapes[of_rays.integer(0, shape_count - 1)], set, of_rays);
        const double factor = wanted == Numbers::floats ? 1.0 : enlarged;
        for (int axis = 0; axis < 3; ++axis) {
            rays.values[axis].push_back(factor * static_cast<double>(ray.origin[axis]));
            rays.values[3 + axis].push_back(static_cast<double>(ray.direction[axis]));
        }
    }
    return builder.build();
}

using Clock = std::chrono::steady_clock;

double nanoseconds_of(const std::function<void()>& act) {
    const auto start = Clock::now();
    act();
    return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

double least_of(int turns, const std::function<void()>& act) {
    double least = HUGE_VAL;
    for (int turn = 0; turn < turns; ++turn)
        least = std::min(least, nanoseconds_of(act));
    return least;
}

struct Times {
    double nearest = 0.0, worst = 0.0, all = 0.0, worst_of_all = 0.0;
};

template <class Shape>
Times times_of(Numbers numbers, Set set) {
    Rays rays;
    const Scene scene = make<Shape>(numbers, set, rays);
    const Tracer tracer(scene, {.threads = 1});
    tests::Hits hits(ray_count);
    CrossingRows rows;
    const auto nearest = [&](std::size_t first, std::size_t count) {
        HitSpan span = hits.span();
        span.t = span.t.first(count);
        span.normal_x = span.normal_x.first(count);
        span.normal_y = span.normal_y.first(count);
        span.normal_z = span.normal_z.first(count);
        span.shape = span.shape.first(count);
        span.entering = span.entering.first(count);
        tracer.intersect(rays.span(first, count), span);
    };
    const auto all = [&](std::size_t first, std::size_t count) {
        tracer.crossings(rays.span(first, count), rows);
    };
    Times times;
    times.nearest = least_of(5, [&] { nearest(0, ray_count); }) / ray_count;
    times.all = least_of(5, [&] { all(0, ray_count); }) / ray_count;
    for (std::size_t i = 0; i < alone_count; ++i) {
        times.worst = std::max(times.worst, least_of(3, [&] { nearest(i, 1); }) / 1000.0);
        times.worst_of_all = std::max(times.worst_of_all, least_of(3, [&] { all(i, 1); }) / 1000.0);
    }
    return times;
}

} // namespace
} // namespace raylane::bench

int main() {
    using namespace raylane;
    using namespace raylane::bench;
    std::printf("%-32s %28s %28s %28s\n", "", "floats", "doubles", "doubles and twins");
    std::printf("%-32s", "ns a ray, us of the worst");
    for (int i = 0; i < 3; ++i)
        std::printf(" %6s %6s %6s %7s", "hit", "worst", "all", "worst");
    std::printf("\n");
    core::for_each_shape_type([]<class Shape>(std::type_identity<Shape>) {
        for (const Set set : ray_sets::all_sets) {
            const std::string name = std::string(core::name_of(core::kind_of<Shape>)) + ", " +
                                     std::string(ray_sets::set_names[static_cast<int>(set)]);
            std::printf("%-32s", name.c_str());
            for (const Numbers numbers : {Numbers::floats, Numbers::doubles, Numbers::twins}) {
                const Times times = times_of<Shape>(numbers, set);
                std::printf(" %6.0f %6.1f %6.0f %7.1f", times.nearest, times.worst, times.all,
                            times.worst_of_all);
            }
            std::printf("\n");
            std::fflush(stdout);
        }
    });
}
