#include "tests/meetings/gathering.hpp"
#include "tests/scenes/api/exam_in_double.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <bit>
#include <cmath>
#include <utility>
#include <variant>

/// Tests of the library's answers for rays and shapes in double against the oracle.
using namespace raylane;
using namespace raylane::tests;
using core::Vec3d;
using meetings::Way;

namespace {

/// Returns a ray next to one in float, displaced by a few ulps of doubles or by steps that no float
/// has. No component is scaled below the smallest float.
core::Ray<double> beside(const core::Ray<float>& ray, Random& random) {
    core::Ray<double> result{core::convert<double>(ray.origin),
                             core::convert<double>(ray.direction)};
    const auto scale = [](double& component, double by) {
        const double scaled = component * by;
        if (!(std::abs(scaled) < 0x1p-149)) component = scaled;
    };
    const int way = random.integer(0, 4);
    if (way == 0) return result;
    if (way == 1) { // the same line, with a third of the direction
        const double third = 1.0 / 3.0;
        for (int axis = 0; axis < 3; ++axis)
            scale(result.direction[axis], third);
        return result;
    }
    const double size = way == 2 ? 0x1p-53 : random.log_uniform(0x1p-53, 0x1p-24);
    for (int axis = 0; axis < 3; ++axis) {
        scale(result.origin[axis], 1.0 + size * random.integer(-2, 2));
        if (way != 3) scale(result.direction[axis], 1.0 + size * random.integer(-2, 2));
        if (way == 4 && random.integer(0, 3) == 0) result.direction[axis] += 0x1p-90;
    }
    return result;
}

} // namespace

TEST_CASE("answers for rays in double are exact for these doubles", "[meetings]") {
    Random random(seed(20261124));
    DoubleFaults faults;
    for (const Way way : meetings::all_ways)
        for (int round = 0; round < rounds(1, 1); ++round)
            for (int kind = 0; kind < core::kind_count; ++kind) {
                const int other = random.integer(0, core::kind_count - 1);
                meetings::MeetingMaker maker(kind, other, way, random);
                const meetings::Meeting meeting = maker.make(20);
                std::vector<core::Ray<double>> rays;
                for (const core::Ray<float>& ray : meeting.rays)
                    rays.push_back(beside(ray, random));
                ask(meeting.shapes, rays, faults);
            }
    CAPTURE(faults.rays, faults.hits, faults.shape, faults.t, faults.t_double, faults.side,
            faults.normal, faults.occlusion, faults.crossings, faults.double_normal, faults.first);
    CHECK(faults.all() == 0);
    CHECK(faults.hits > faults.rays / 4);
}

TEST_CASE("equal rays in double and in float have equal answers") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    DoubleRays rays;
    for (std::size_t i = 0; i < setup.rays.size(); ++i)
        rays.add(setup.rays.ray(i), 0.0, endless);
    const DoubleAnswers answers(tracer, rays);
    const Hits hits = intersect(tracer, setup.rays);
    CHECK(answers.hits == hits);
    CHECK(answers.blocked == occluded(tracer, setup.rays));
    // t in float is t in double, rounded.
    std::vector<double> t_double(setup.rays.size(), -1.0);
    tracer.intersect(setup.rays.span(), {.t_double = t_double});
    CHECK(t_double == answers.t_double);
    for (std::size_t i = 0; i < t_double.size(); ++i) {
        const auto t = static_cast<double>(hits.t[i]);
        if (hits.shape[i] != no_shape) CHECK(std::abs(t_double[i] - t) <= 0x1p-24 * t);
    }
}

TEST_CASE("rays of any finite doubles are traced, and others are counted") {
    const Tracer tracer(ball());
    DoubleRays rays;
    const auto add = [&](const Vec3d& origin, const Vec3d& direction) {
        rays.add({origin, direction}, 0.0, endless);
    };
    add({0, 0, -2}, {0, 0, 0x1p127});
    add({0, 0, -2}, {0, 0x1p-148, 0x1p-140});
    add({0x1p-149, 0, -2}, {0x1p-270, 0, 1});
    add({0, 0, -0x1p128}, {0, 0, 1});
    add({0, 0x1p-150, -2}, {0, 0, 1});
    add({0, 0, -2}, {0x1p-277, 0, 1});
    add({0, 0, -2}, {0, 0, 0x1p128});
    add({0, 0, -2}, {0, 0, 0x1p-1074});
    add({0, 0, -0x1p1023}, {0x1p-1074, 0, 0x1p1023});
    const std::size_t found = rays.size();
    add({0, 0, -2}, {0, 0, endless});
    add({0, std::nan(""), -2}, {0, 0, 1});
    add({0, 0, -2}, {0, 0, 0});
    const DoubleAnswers answers(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CAPTURE(i);
        CHECK((answers.hits.shape[i] == 0) == (i < found));
        CHECK(answers.blocked[i] == (i < found ? 1 : 0));
        CHECK(answers.rows.first[i + 1] - answers.rows.first[i] == (i < found ? 2 : 0));
    }
    QueryStatistics statistics;
    CrossingStatistics of_crossings;
    Hits hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    CrossingRows rows;
    LengthRows lengths;
    tracer.intersect(rays.span(), hits.span(), &statistics);
    CHECK(std::exchange(statistics.refused, 0) == 3);
    tracer.occluded(rays.span(), blocked, &statistics);
    CHECK(std::exchange(statistics.refused, 0) == 3);
    tracer.crossings(rays.span(), rows, {}, &of_crossings);
    CHECK(of_crossings.refused == 3);
    tracer.path_lengths(rays.span(), lengths, &statistics);
    CHECK(std::exchange(statistics.refused, 0) == 3);
    for (std::size_t i = 0; i < rays.size(); ++i)
        CHECK(lengths.first[i + 1] == std::min(i + 1, found));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto value_at = [i](const std::vector<double>& column) {
            return std::span(column).subspan(i, 1);
        };
        const DoubleRaySpan alone{value_at(rays.origin[0]),    value_at(rays.origin[1]),
                                  value_at(rays.origin[2]),    value_at(rays.direction[0]),
                                  value_at(rays.direction[1]), value_at(rays.direction[2])};
        tracer.intersect(alone, HitSpan{.t = std::span(hits.t).first(1)}, &statistics);
        CHECK(hits.t[0] == answers.hits.t[i]);
        CHECK(std::exchange(statistics.refused, 0) == (i < found ? 0 : 1));
        tracer.occluded(alone, std::span(blocked).first(1), &statistics);
        CHECK(blocked[0] == answers.blocked[i]);
        CHECK(std::exchange(statistics.refused, 0) == (i < found ? 0 : 1));
        tracer.crossings(alone, rows, {.most = 1}, &of_crossings);
        CHECK(rows.t.size() == (i < found ? 1 : 0));
        CHECK(of_crossings.refused == (i < found ? 0 : 1));
    }
    SolidRows solids;
    tracer.contains({rays.origin[0], rays.origin[1], rays.origin[2]}, solids, &statistics);
    CHECK(std::exchange(statistics.refused, 0) == 1);
    // A ray without an interval between its limits is not refused; one with a limit of NaN is.
    DoubleRays limited;
    limited.add({{0, 0, -2}, {0, 0, 1}}, 2.0, 1.0);
    limited.add({{0, 0, -2}, {0, 0, 1}}, endless, endless);
    limited.add({{0, 0, -2}, {0, 0, 1}}, std::nan(""), endless);
    limited.add({{0, 0, -2}, {0, 0, 1}}, 0.0, std::nan(""));
    Hits none(limited.size());
    tracer.intersect(limited.span(), none.span(), &statistics);
    CHECK(std::exchange(statistics.refused, 0) == 2);
    tracer.path_lengths(limited.span(), lengths, &statistics);
    CHECK(std::exchange(statistics.refused, 0) == 2);
}

namespace {

/// A change that makes doubles of the floats of shapes and rays.
enum class Change {
    none,
    enlarged, ///< multiplies all lengths by one factor: shapes that met still meet
    stirred,  ///< multiplies each number by a factor that depends on this number alone
};
constexpr Change all_changes[] = {Change::none, Change::enlarged, Change::stirred};

/// Returns the changed number. Tiny ones stay, as numbers below core::min_double must be floats.
double changed(double number, Change change) {
    if (change == Change::none || std::abs(number) < 0x1p-125) return number;
    constexpr double factor =
        1.0 + 13 * 0x1p-24; // exact products: with a float, and of its square with a small number
    if (change == Change::enlarged) return number * factor;
    // The factor depends on the number alone.
    const auto bits = std::bit_cast<std::uint64_t>(number) * 0x9E3779B97F4A7C15;
    const double part = static_cast<double>(bits >> 11) * 0x1p-53;
    return number * (1.0 + std::ldexp(part - 0.5, -24 - static_cast<int>(bits % 29)));
}

template <class Shape>
core::InDouble<Shape> changed(const Shape& shape, Change change) {
    auto numbers = core::numbers_of(core::to_doubles(shape));
    for (double& number : numbers)
        number = changed(number, change);
    auto result = core::shape_of<core::InDouble<Shape>>(numbers);
    if constexpr (core::kind_of<Shape> == core::Kind::quadric) {
        if (change != Change::enlarged) return result;
        // Q(p / factor) times factor^2.
        const core::InDouble<Shape> before = core::to_doubles(shape);
        result.xx = before.xx;
        result.yy = before.yy;
        result.zz = before.zz;
        result.xy = before.xy;
        result.xz = before.xz;
        result.yz = before.yz;
        result.one = changed(result.one, change);
    }
    return result;
}

void ask(const meetings::Meeting& meeting, Change change, DoubleFaults& faults) {
    std::vector<AnyShapeInDouble> shapes;
    for (const tests::AnyShape& any : meeting.shapes)
        shapes.push_back(std::visit(
            [&](const auto& shape) { return AnyShapeInDouble(changed(shape, change)); }, any));
    std::vector<core::Ray<double>> rays;
    for (const core::Ray<float>& ray : meeting.rays) {
        rays.push_back({core::convert<double>(ray.origin), core::convert<double>(ray.direction)});
        for (int axis = 0; axis < 3; ++axis)
            rays.back().origin[axis] = changed(rays.back().origin[axis], change);
    }
    ask(shapes, rays, faults);
}

} // namespace

TEST_CASE("answers for shapes in double are exact for these doubles", "[meetings]") {
    Random random(seed(20261125));
    for (const Change change : all_changes) {
        DoubleFaults faults;
        for (const Way way : meetings::all_ways)
            for (int kind = 0; kind < core::kind_count; ++kind) {
                const int other = random.integer(0, core::kind_count - 1);
                meetings::MeetingMaker maker(kind, other, way, random);
                ask(maker.make(20), change, faults);
            }
        for (int round = 0; round < rounds(4, 1); ++round)
            for (const meetings::Kind& kind : meetings::gatherings)
                if (round == 0 || kind.least <= 30)
                    ask(kind.make(kind.least, random, 20), change, faults);
        CAPTURE(static_cast<int>(change), faults.rays, faults.hits, faults.shape, faults.t,
                faults.t_double, faults.side, faults.normal, faults.occlusion, faults.crossings,
                faults.double_normal, faults.first);
        CHECK(faults.all() == 0);
        CHECK(faults.hits > faults.rays / 4);
    }
}
