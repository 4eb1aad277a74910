#include "tests/catch.hpp"
#include "tests/meetings/gathering.hpp"
#include "tests/scenes/library/exam.hpp"
#include "tests/simd/rounds.hpp"

#include <bit>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <variant>

/// Rays and shapes in double, asked of the library, against the oracle.
using namespace raylane;
using namespace raylane::tests;
using core::Vec3d;
using meetings::Way;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Rays in double with arrays of their own.
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

struct Answers {
    explicit Answers(const Tracer& tracer, const DoubleRays& rays)
        : hits(rays.size()), t_double(rays.size(), -1.0), blocked(rays.size(), 77) {
        HitSpan span = hits.span();
        span.t_double = t_double;
        tracer.intersect(rays.span(), span);
        tracer.occluded(rays.span(), blocked);
        tracer.crossings(rays.span(), rows);
    }
    Hits hits;
    std::vector<double> t_double;
    std::vector<std::uint8_t> blocked;
    CrossingRows rows;
};

/// A ray beside one in float, as doubles can be: by some of their ulps, or by what no float has. As
/// small as it may be, it is no smaller than floats are, so that it still is one.
core::Ray<double> beside(const core::Ray<float>& ray, Random& random) {
    core::Ray<double> result{core::convert<double>(ray.origin),
                             core::convert<double>(ray.direction)};
    const auto scale = [](double& component, double by) {
        const double scaled = component * by;
        if (!(std::abs(scaled) < 0x1p-149)) component = scaled;
    };
    const int way = random.integer(0, 4);
    if (way == 0) return result;
    if (way == 1) { // the same line, in thirds
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

/// Order of a crossing's true t and a double.
int compare(const oracle::Hit& hit, double t) {
    if (t == endless) return -1;
    const int order = oracle::compare_digits(hit.t, oracle::Number(t));
    return order != 0 ? order : oracle::sign_at(hit.root, oracle::Exact(-t), oracle::Exact(1));
}

struct Question {
    std::size_t sight;
    double t_min, t_max;
};

struct Faults {
    long rays = 0, hits = 0, shape = 0, t = 0, t_double = 0, normal = 0, side = 0, occlusion = 0,
         crossings = 0;
    std::string first; ///< what was asked and expected, in numbers
    long all() const { return shape + t + t_double + normal + side + occlusion + crossings; }
};

template <oracle::Variant Any>
std::string described(const Question& question, const DoubleRays& rays, std::size_t i,
                      const oracle::Found* truth, const std::vector<Any>& shapes) {
    std::ostringstream out;
    out << std::setprecision(17) << shapes.size() << " shapes; ray";
    for (int axis = 0; axis < 3; ++axis)
        out << ' ' << rays.origin[axis][i];
    out << " towards";
    for (int axis = 0; axis < 3; ++axis)
        out << ' ' << rays.direction[axis][i];
    out << ", t from " << question.t_min << " to " << question.t_max;
    if (truth != nullptr) out << "; shape " << truth->shape << " at " << truth->t;
    for (std::size_t id = 0; id < shapes.size(); ++id) {
        if (shapes.size() > 40 && (truth == nullptr || id != truth->shape)) continue;
        out << "; shape " << id << ", kind " << shapes[id].index() << ':';
        std::visit(
            [&](const auto& shape) {
                for (const auto value : core::numbers_of(shape))
                    out << ' ' << value;
            },
            shapes[id]);
    }
    return out.str();
}

/// Rays without limits, and with these at crossings and next to them.
template <oracle::Variant Any>
void ask(const std::vector<Any>& all, const std::vector<core::Ray<double>>& rays, Faults& faults) {
    const std::vector<Any> shapes = valid(all);
    const oracle::Neighbours neighbours(shapes);
    const std::vector<char> counts = which_count(shapes);
    const Tracer tracer(scene_of(shapes), {.threads = 1});
    std::vector<oracle::Sight> sights;
    std::vector<Question> questions;
    DoubleRays asked;
    const auto add = [&](const core::Ray<double>& ray, double t_min, double t_max) {
        asked.add(ray, t_min, t_max);
        questions.push_back({sights.size() - 1, t_min, t_max});
    };
    for (const core::Ray<double>& ray : rays) {
        sights.emplace_back(shapes, neighbours, ray, [](ShapeId, bool) { return true; });
        add(ray, 0.0, endless);
        int count = 0;
        for (const oracle::Found& found : sights.back().all()) {
            if (++count > 3) break;
            const double t = oracle::rounded_to_double(found.hit.root, found.hit.t);
            for (const double limit : {std::nextafter(t, 0.0), t, std::nextafter(t, endless)}) {
                add(ray, limit, endless);
                add(ray, 0.0, limit);
            }
        }
    }
    const Answers answers(tracer, asked);
    const long known = faults.all();
    const oracle::Found* before = nullptr;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const Question& question = questions[i];
        oracle::Sight& sight = sights[question.sight];
        const oracle::Found* truth = nullptr;
        for (const oracle::Found& found : sight.all()) {
            if (compare(found.hit, question.t_min) <= 0) continue;
            if (compare(found.hit, question.t_max) <= 0) truth = &found;
            break;
        }
        ++faults.rays;
        if (faults.all() > known && faults.first.empty())
            faults.first = described(questions[i - 1], asked, i - 1, before, shapes);
        before = truth;
        const auto is_between = [&](const oracle::Found& found) {
            return counts[found.shape] != 0 && compare(found.hit, question.t_min) > 0 &&
                   compare(found.hit, question.t_max) <= 0;
        };
        faults.crossings += is_right(answers.rows, i, sight, is_between) ? 0 : 1;
        const Hits& hits = answers.hits;
        faults.occlusion += answers.blocked[i] != (truth != nullptr ? 1 : 0) ? 1 : 0;
        if (truth == nullptr) {
            faults.shape += hits.is_none(i) && answers.t_double[i] == endless ? 0 : 1;
            continue;
        }
        ++faults.hits;
        if (hits.shape[i] != truth->shape) {
            ++faults.shape;
            continue;
        }
        faults.t += hits.t[i] != truth->t ? 1 : 0;
        faults.t_double +=
            answers.t_double[i] != oracle::rounded_to_double(truth->hit.root, truth->hit.t) ? 1 : 0;
        faults.side += hits.entering[i] != (truth->hit.entering ? 1 : 0) ? 1 : 0;
        faults.normal += core::Vec3f(hits.nx[i], hits.ny[i], hits.nz[i]) !=
                                 sight.normal_of(*truth, shapes[truth->shape])
                             ? 1
                             : 0;
    }
}

} // namespace

TEST_CASE("rays in double are taken for exactly their doubles", "[meetings]") {
    Random random(seed(20261124));
    Faults faults;
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
            faults.normal, faults.occlusion, faults.crossings, faults.first);
    CHECK(faults.all() == 0);
    CHECK(faults.hits > faults.rays / 4);
}

TEST_CASE("rays in double answer as rays in float do where they are the same") {
    const Heap all = heap();
    const Tracer tracer(all.scene);
    DoubleRays rays;
    for (std::size_t i = 0; i < all.rays.size(); ++i)
        rays.add(all.rays.ray(i), 0.0, endless);
    const Answers answers(tracer, rays);
    const Hits hits = intersect(tracer, all.rays);
    CHECK(answers.hits == hits);
    CHECK(answers.blocked == occluded(tracer, all.rays));
    // And t in double is what t in float is rounded from.
    std::vector<double> t_double(all.rays.size(), -1.0);
    tracer.intersect(all.rays.span(), {.t_double = t_double});
    CHECK(t_double == answers.t_double);
    for (std::size_t i = 0; i < t_double.size(); ++i) {
        const auto t = static_cast<double>(hits.t[i]);
        if (hits.shape[i] != no_shape) CHECK(std::abs(t_double[i] - t) <= 0x1p-24 * t);
    }
}

TEST_CASE("doubles outside of the range of floats are none") {
    const Tracer tracer(ball());
    DoubleRays rays;
    const auto add = [&](const Vec3d& origin, const Vec3d& direction) {
        rays.add({origin, direction}, 0.0, endless);
    };
    add({0, 0, -2}, {0, 0, 0x1p127});
    add({0, 0, -2}, {0, 0x1p-148, 0x1p-140});
    add({0x1p-149, 0, -2}, {0x1p-270, 0, 1});
    const std::size_t found = rays.size();
    add({0, 0, -0x1p128}, {0, 0, 1});
    add({0, 0x1p-150, -2}, {0, 0, 1});
    add({0, 0, -2}, {0x1p-277, 0, 1});
    add({0, 0, -2}, {0, 0, 0x1p128});
    add({0, 0, -2}, {0, 0, endless});
    add({0, std::nan(""), -2}, {0, 0, 1});
    add({0, 0, -2}, {0, 0, 0});
    const Answers answers(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CAPTURE(i);
        CHECK((answers.hits.shape[i] == 0) == (i < found));
        CHECK(answers.blocked[i] == (i < found ? 1 : 0));
    }
}

namespace {

/// How shapes and rays of floats become those of doubles.
enum class Change {
    none,
    enlarged, ///< all lengths by one factor: what met meets still
    stirred,  ///< each number by its own, but the same numbers by the same
};
constexpr Change all_changes[] = {Change::none, Change::enlarged, Change::stirred};

/// Tiny ones stay as they are: there is nothing between such floats.
double changed(double number, Change change) {
    if (change == Change::none || std::abs(number) < 0x1p-125) return number;
    constexpr double factor =
        1.0 + 13 * 0x1p-24; // with a float, or a small number and itself, exact
    if (change == Change::enlarged) return number * factor;
    // Of the number alone.
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
        // Q(p / factor), times its square.
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

void ask(const meetings::Meeting& meeting, Change change, Faults& faults) {
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

TEST_CASE("shapes in double are taken for exactly their doubles", "[meetings]") {
    Random random(seed(20261125));
    for (const Change change : all_changes) {
        Faults faults;
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
                faults.first);
        CHECK(faults.all() == 0);
        CHECK(faults.hits > faults.rays / 4);
    }
}
