#include "raylane/raylane.hpp"
#include "tests/scenes/api/c_handles.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

/// Closest points by the library, in C++ and C. tests/core/closest_test.cpp checks the points.
using namespace raylane;
using namespace raylane::tests;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

template <class Real>
struct Points {
    std::vector<Real> x, y, z;

    void add(double to_x, double to_y, double to_z) {
        x.push_back(static_cast<Real>(to_x));
        y.push_back(static_cast<Real>(to_y));
        z.push_back(static_cast<Real>(to_z));
    }
    BasicPointSpan<Real> span() const { return {x, y, z}; }
};

struct Answers {
    std::vector<double> distance, x, y, z;
    std::vector<ShapeId> shape_id;
    std::vector<std::uint8_t> face;

    explicit Answers(std::size_t count)
        : distance(count, 7.0), x(count), y(count), z(count), shape_id(count), face(count) {}
    ClosestSpan span() { return {distance, x, y, z, shape_id, face}; }
    bool operator==(const Answers& other) const {
        const auto is_same = [](double a, double b) {
            return a == b || (std::isnan(a) && std::isnan(b));
        };
        const auto are_same = [&](const auto& a, const auto& b) {
            return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
        };
        return distance == other.distance && are_same(x, other.x) && are_same(y, other.y) &&
               are_same(z, other.z) && shape_id == other.shape_id && face == other.face;
    }
};

template <class Real>
Answers closest(const Tracer& tracer, const Points<Real>& points,
                std::span<const double> max_distance = {}, QueryStatistics* statistics = nullptr) {
    Answers answers(points.x.size());
    tracer.closest(points.span(), answers.span(), max_distance, statistics);
    return answers;
}

Scene ball_on_a_floor() {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    builder.add(Plane{{0, 0, -1}, {0, 0, 1}}, material);
    builder.add(Sphere{{0, 0, 2}, 1}, material);
    builder.add(CappedCylinder{{5, 0, 0}, {0, 0, 2}, 1}, material);
    return builder.build();
}

template <class Real>
Points<Real> many_points(int count) {
    ray_sets::Random random(41);
    Points<Real> points;
    for (int i = 0; i < count; ++i) {
        const core::Vec3d at = random.cube(8.0);
        points.add(at.x, at.y, at.z);
    }
    return points;
}

} // namespace

TEST_CASE("closest points of a ball, a floor and a pillar are those of geometry") {
    Points<double> points;
    points.add(0, 0, 5);
    points.add(3, 0, 2);
    points.add(0, 4, -0.5);
    points.add(0, 0, 0); // as far from the floor as from the ball
    points.add(5, 0.25, 1.875);
    points.add(5, 0, 1);
    const Answers answers = closest(Tracer(ball_on_a_floor()), points);
    CHECK(answers.distance == std::vector<double>{2, 1, 0.5, 1, 0.125, 1});
    CHECK(answers.shape_id == std::vector<ShapeId>{1, 2, 0, 0, 2, 2});
    CHECK(answers.face == std::vector<std::uint8_t>{0, 0, 0, 0, 2, 0});
    CHECK(answers.x == std::vector<double>{0, 4, 0, 0, 5, 5});
    CHECK(answers.y == std::vector<double>{0, 0, 4, 0, 0.25, 1});
    CHECK(answers.z == std::vector<double>{3, 2, -1, -1, 2, 1});
}

TEST_CASE("a distance limit leaves out shapes that are farther away") {
    Points<float> points;
    for (int i = 0; i < 5; ++i)
        points.add(0, 0, 5);
    const double limits[] = {2, std::nextafter(2.0, 0.0), 0, -1, std::nan("")};
    QueryStatistics statistics;
    const Answers answers = closest(Tracer(ball_on_a_floor()), points, limits, &statistics);
    CHECK(answers.distance == std::vector<double>{2, endless, endless, endless, endless});
    CHECK(answers.shape_id == std::vector<ShapeId>{1, no_shape, no_shape, no_shape, no_shape});
    CHECK(std::isnan(answers.z[1]));
    CHECK(statistics.refused == 1);
}

TEST_CASE("points that are not finite have no closest point") {
    Points<double> points;
    points.add(0, std::nan(""), 5);
    points.add(endless, 0, 5);
    points.add(0, 0, 5);
    QueryStatistics statistics;
    const Answers answers = closest(Tracer(ball_on_a_floor()), points, {}, &statistics);
    CHECK(statistics.refused == 2);
    CHECK(answers.distance == std::vector<double>{endless, endless, 2});
    const Answers nothing = closest(Tracer(SceneBuilder().build()), points);
    CHECK(nothing.shape_id == std::vector<ShapeId>(3, no_shape));
}

TEST_CASE("closest points do not depend on threads, and columns may be left out") {
    const Scene scene = ball_on_a_floor();
    const Points<double> points = many_points<double>(5000);
    const Answers one = closest(Tracer(scene, {.threads = 1}), points);
    CHECK(one == closest(Tracer(scene, {.threads = 3}), points));
    std::vector<double> distance(points.x.size());
    Tracer(scene).closest(points.span(), {.distance = distance});
    CHECK(distance == one.distance);
}

TEST_CASE("wrong lengths and constructed solids are refused by closest") {
    const Tracer tracer(ball_on_a_floor());
    const Points<float> points = many_points<float>(2);
    double one[1] = {};
    CHECK_THROWS_WITH(tracer.closest(points.span(), {.distance = one}),
                      "distance: must have one element for each of 2 points, got 1");
    CHECK_THROWS_WITH(tracer.closest(points.span(), {}, one),
                      "max_distance: must have one element for each of 2 points, got 1");
    SceneBuilder builder;
    builder.add(Solid(Sphere{{0, 0, 0}, 1}) | Sphere{{1, 0, 0}, 1}, builder.add_material({}));
    CHECK_THROWS_WITH(closest(Tracer(builder.build()), points),
                      "scene: must have no constructed solids: closest points on them are not "
                      "supported");
}

TEST_CASE("closest points in C are those of C++") {
    const Builder builder = builder_in_c();
    std::uint32_t material = 0;
    const raylane_material plain = raylane_default_material();
    REQUIRE(raylane_add_material(builder.get(), &plain, &material) == RAYLANE_OK);
    const raylane_sphere ball{{0, 0, 2}, 1};
    REQUIRE(raylane_add_spheres(builder.get(), &ball, 1, material, nullptr) == RAYLANE_OK);
    const SceneHandle scene = built(builder);
    const TracerHandle tracer = tracer_of(scene);
    SceneBuilder in_cpp;
    in_cpp.add(Sphere{{0, 0, 2}, 1}, in_cpp.add_material({}));
    const Tracer tracer_in_cpp(in_cpp.build());

    Points<double> points = many_points<double>(100);
    points.x[3] = std::nan("");
    const std::vector<double> limits(100, 6.0);
    std::uint64_t refused = 77;
    const raylane_double_points doubles = {100, points.x.data(), points.y.data(), points.z.data(),
                                           &refused};
    Answers in_c(100);
    const raylane_closest_points to = {in_c.distance.data(), in_c.x.data(),
                                       in_c.y.data(),        in_c.z.data(),
                                       in_c.shape_id.data(), in_c.face.data()};
    REQUIRE(raylane_closest_doubles(tracer.get(), &doubles, limits.data(), &to) == RAYLANE_OK);
    CHECK(refused == 1);
    CHECK(in_c == closest(tracer_in_cpp, points, limits));

    const Points<float> few = many_points<float>(100);
    const raylane_points floats = {100, few.x.data(), few.y.data(), few.z.data(), nullptr};
    REQUIRE(raylane_closest(tracer.get(), &floats, nullptr, &to) == RAYLANE_OK);
    CHECK(in_c == closest(tracer_in_cpp, few));
    const raylane_closest_points none{};
    CHECK(raylane_closest(tracer.get(), &floats, nullptr, &none) == RAYLANE_OK);
    CHECK(raylane_closest(tracer.get(), &floats, nullptr, nullptr) == RAYLANE_INVALID_VALUE);
    CHECK(raylane_error_text() == std::string("closest: must not be NULL"));
}
