#include "core/shape_table.hpp"
#include "core/solve.hpp"
#include "simd/isa.hpp"
#include "tests/catch.hpp"
#include "tests/ray_sets.hpp"
#include "tests/simd/filter_check.hpp"
#include "tests/simd/rounds.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;

/// The filters' bounds against the certified answer in double.

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

int rounds() {
    return tests::rounds(500);
}

/// Whether to say how tight the bounds are.
bool wants_report() {
    return std::getenv("RAYLANE_TEST_REPORT") != nullptr;
}

FilterChecks checks_of(Isa isa) {
    switch (isa) {
    case Isa::sse42:
        return filter_checks_sse42();
    case Isa::avx2:
        return filter_checks_avx2();
    default:
        return filter_checks_avx512();
    }
}

/// A ray as it is meant, and as the filters see it.
struct Doubled {
    Ray<double> ray;
    Ray<float> rounded;
    float slack;

    explicit Doubled(const Ray<double>& meant) : ray(meant) {
        ray.direction = normalized(ray.direction);
        rounded = {convert<float>(ray.origin), convert<float>(ray.direction)};
        const double moved = length(Vec3d(convert<double>(rounded.origin) - ray.origin));
        slack = std::nextafter(static_cast<float>(moved * (1.0 + 0x1p-16) + 0x1p-68),
                               std::numeric_limits<float>::infinity());
    }
};

/// The first crossing with t > 0, and what t may be off by. Not known where one of the crossings
/// may be anywhere, even in double-double: at a line that touches a cone's extension, say.
struct First {
    double t = infinity;
    double error = 0.0;
    bool known = true;
    bool exists() const { return t < infinity; }
};

template <class Shape>
First first_crossing(const Shape& shape, const Ray<double>& ray) {
    std::uint64_t widened = 0;
    First first;
    for (const core::Crossing<double>& crossing : solve(shape, ray, Start{}, widened)) {
        first.known = first.known && crossing.error < infinity;
        if (!(crossing.t > 0.0 && crossing.t < first.t)) continue;
        first.t = crossing.t;
        first.error = crossing.error;
    }
    return first;
}

struct Answer {
    bool possible;
    double lower;
    bool certain;
    double upper;
};

/// Owns the arrays of a stream.
class Stream {
  public:
    void add(const Doubled& ray) {
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis].push_back(ray.rounded.origin[axis]);
            direction_[axis].push_back(ray.rounded.direction[axis]);
        }
        slack_.push_back(ray.slack);
    }

    FilterStream view() {
        const std::size_t count = slack_.size(), padded = (count + 15) / 16 * 16;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis].resize(padded, nan);
            direction_[axis].resize(padded, nan);
        }
        slack_.resize(padded, nan);
        for (std::vector<float>& out : out_)
            out.assign(padded, 0.0F);
        return {count,
                {origin_[0].data(), origin_[1].data(), origin_[2].data()},
                {direction_[0].data(), direction_[1].data(), direction_[2].data()},
                slack_.data(),
                out_[0].data(),
                out_[1].data(),
                out_[2].data(),
                out_[3].data()};
    }

    Answer answer(std::size_t i) const {
        return {out_[0][i] != 0.0F, static_cast<double>(out_[1][i]), out_[2][i] != 0.0F,
                static_cast<double>(out_[3][i])};
    }
    std::size_t padded() const { return slack_.size(); }

  private:
    std::array<std::vector<float>, 3> origin_, direction_;
    std::vector<float> slack_;
    std::array<std::vector<float>, 4> out_;
};

template <class Shape>
ShapeBlock view_of(const Block<Shape>& block) {
    return {block.values, reinterpret_cast<const float*>(block.ids)};
}

/// What is wrong with an answer; null if nothing.
const char* lie(const Answer& answer, const First& truth) {
    if (!truth.known) return nullptr;
    if (truth.exists() && !answer.possible) return "a crossing was said to be impossible";
    if (truth.exists() && !(answer.lower <= truth.t + truth.error)) return "lower is too high";
    if (answer.possible && !(answer.lower >= 0.0)) return "lower is negative";
    if (answer.certain && !truth.exists()) return "a crossing was said to be certain";
    if (answer.certain && !answer.possible) return "certain, but not possible";
    if (answer.certain && !(answer.upper >= truth.t - truth.error)) return "upper is too low";
    return nullptr;
}

Vec3d in_double(const Vec3f& v) {
    return convert<double>(v);
}

/// A shape's floats, each changed by a random factor near 1, or moved.
template <class Shape>
Shape nudged(const Shape& shape, double size, Random& random) {
    Floats<Shape> floats = floats_of(shape);
    for (float& value : floats)
        if (random.integer(0, 3) == 0)
            value = static_cast<float>(static_cast<double>(value) *
                                       (1.0 + size * random.uniform(-1.0, 1.0)));
    return shape_of<Shape>(floats);
}

/// The same shape, `scale` times as large.
template <class Shape>
Shape scaled(const Shape& shape, double scale) {
    Floats<Shape> floats = floats_of(shape);
    for (float& value : floats)
        value = static_cast<float>(static_cast<double>(value) * scale);
    return shape_of<Shape>(floats);
}
template <>
Quadric scaled(const Quadric& q, double scale) {
    const auto f = [](double v) { return static_cast<float>(v); };
    const auto d = [](float v) { return static_cast<double>(v); };
    Quadric r = q;
    r.center = convert<float>(Vec3d(in_double(q.center) * scale));
    r.lower = convert<float>(Vec3d(in_double(q.lower) * scale));
    r.upper = convert<float>(Vec3d(in_double(q.upper) * scale));
    for (float* linear : {&r.x, &r.y, &r.z})
        *linear = f(d(*linear) * scale);
    r.one = f(d(q.one) * scale * scale);
    return r;
}

/// Long, flat, slender or blunt, that is of proportions that the usual targets do not have.
template <class Shape>
Shape extreme(const Shape& shape, Random&) {
    return shape;
}
template <Ends ends>
Cylinder<ends> extreme(Cylinder<ends> c, Random& r) {
    c.radius = static_cast<float>(static_cast<double>(c.radius) * r.log_uniform(1e-4, 1e3));
    return c;
}
template <Ends ends>
Cone<ends> extreme(Cone<ends> c, Random& r) {
    const double scale = r.log_uniform(1e-4, 1e3);
    c.base_radius = static_cast<float>(static_cast<double>(c.base_radius) * scale);
    c.top_radius = static_cast<float>(static_cast<double>(c.top_radius) * scale);
    if (r.integer(0, 2) == 0 && c.base_radius != 0.0F)
        c.top_radius = static_cast<float>(static_cast<double>(c.base_radius) *
                                          (1.0 + r.log_uniform(1e-7, 1e-1)));
    return c;
}
template <>
Box extreme(const Box& box, Random& r) {
    Box b = box;
    b.edge_u = convert<float>(Vec3d(in_double(b.edge_u) * r.log_uniform(1e-4, 1e3)));
    if (r.integer(0, 1) == 0)
        b.edge_v = convert<float>(Vec3d(in_double(b.edge_u) * r.log_uniform(0.1, 10.0) +
                                        in_double(b.edge_v) * r.log_uniform(1e-3, 1.0)));
    return b;
}
template <class AnyTriangle>
AnyTriangle extreme_triangle(AnyTriangle t, Random& r) {
    const Vec3d a = in_double(t.a), e = in_double(t.b) - a;
    if (r.integer(0, 1) == 0) {
        t.b = convert<float>(Vec3d(a + e * r.log_uniform(1e-4, 1e2)));
    } else {
        const Vec3d g = in_double(t.c) - a;
        t.c = convert<float>(Vec3d(a + e * r.uniform(-1.0, 2.0) + g * r.log_uniform(1e-5, 1e-1)));
    }
    return t;
}
template <>
Triangle extreme(const Triangle& t, Random& r) {
    return extreme_triangle(t, r);
}
template <>
SmoothTriangle extreme(const SmoothTriangle& t, Random& r) {
    return extreme_triangle(t, r);
}

/// Whether it is a shape at all.
template <class Shape>
bool is_shape(const Shape& shape) {
    for (const float value : floats_of(shape))
        if (!std::isfinite(value)) return false;
    return true;
}

/// Rays to try on a shape: those of the sets, and what is particular to filters.
template <class Shape>
Ray<double> attack(const Shape& shape, bool lattice, Random& random) {
    const Set set = lattice ? Set::lattice : ray_sets::any_set(random);
    const Ray<float> ray = ray_sets::make_ray(shape, set, random);
    Ray<double> result{in_double(ray.origin), in_double(ray.direction)};
    using T = ray_sets::Target<Shape>;
    switch (random.integer(0, 5)) {
    case 0: { // an origin that is not a float
        const double size = length(result.origin) * random.log_uniform(1e-16, 1e-6);
        result.origin += random.direction() * size;
        break;
    }
    case 1: { // aimed in double at the surface or just beside it
        const ray_sets::SurfacePoint target = T::surface(shape, random);
        const double size = T::size(shape);
        const double miss = random.integer(0, 1) == 0 ? 0.0 : size * random.log_uniform(1e-9, 1e-3);
        const Vec3d point = target.point + random.direction() * miss;
        const Vec3d d = random.integer(0, 1) == 0
                            ? normalized(ray_sets::across(target.normal, random) +
                                         target.normal * random.log_uniform(1e-9, 1e-2))
                            : random.direction();
        result = {point - d * (size * random.log_uniform(1e-3, 1e6)), d};
        break;
    }
    case 2: { // from just before, on or behind the surface
        const ray_sets::SurfacePoint target = T::surface(shape, random);
        const double off = T::size(shape) * random.log_uniform(1e-10, 1e-3);
        result.origin = target.point + target.normal * (random.integer(-1, 1) * off);
        break;
    }
    default:
        break;
    }
    return result;
}

template <class Shape>
Shape make_shape(Random& random, bool lattice) {
    while (true) {
        Shape shape = ray_sets::Target<Shape>::make(random, lattice);
        if (lattice) return shape;
        if (random.integer(0, 3) == 0) shape = extreme(shape, random);
        if (random.integer(0, 3) == 0) shape = scaled(shape, random.log_uniform(1e-8, 1e8));
        if (random.integer(0, 15) == 0) shape = scaled(shape, random.log_uniform(1e-15, 1e15));
        if (is_shape(shape)) return shape;
    }
}

template <class Shape>
struct Round {
    Block<Shape> block;
    int count;
    std::vector<Doubled> rays;
    std::vector<First> truth; ///< of all rays with shape 0, then with shape 1, ...

    explicit Round(Random& random) : count(random.integer(1, 3)) {
        const bool lattice = random.integer(0, 5) == 0;
        for (int lane = 0; lane < count; ++lane)
            block.set(lane, make_shape<Shape>(random, lattice), static_cast<ShapeId>(lane));
        for (int i = 0; i < 100; ++i)
            rays.emplace_back(attack(block.get(random.integer(0, count - 1)), lattice, random));
        for (int lane = 0; lane < count; ++lane)
            for (const Doubled& ray : rays)
                truth.push_back(first_crossing(block.get(lane), ray.ray));
    }

    const First& first(int lane, std::size_t i) const {
        return truth[static_cast<std::size_t>(lane) * rays.size() + i];
    }
};

template <class Shape>
void check_answer(const Answer& answer, const Round<Shape>& round, int lane, std::size_t i) {
    const char* const wrong = lie(answer, round.first(lane, i));
    if (wrong == nullptr) return;
    const First& truth = round.first(lane, i);
    const Doubled& ray = round.rays[i];
    CAPTURE(lane, i, truth.t, truth.error, answer.possible, answer.lower, answer.certain,
            answer.upper, ray.slack);
    CAPTURE(ray.ray.origin.x, ray.ray.origin.y, ray.ray.origin.z, ray.ray.direction.x,
            ray.ray.direction.y, ray.ray.direction.z);
    const Floats<Shape> floats = floats_of(round.block.get(lane));
    CAPTURE(std::vector<float>(floats.begin(), floats.end()));
    FAIL(wrong);
}

template <class Shape>
void check_round(const FilterChecks& checks, const Round<Shape>& round) {
    const auto kind = static_cast<KindNumber>(kind_of<Shape>);
    Stream stream;
    for (const Doubled& ray : round.rays)
        stream.add(ray);
    const FilterStream view = stream.view();
    for (int lane = 0; lane < round.count; ++lane) {
        checks.bound_rays(kind, view_of(round.block), lane, view);
        for (std::size_t i = 0; i < round.rays.size(); ++i)
            check_answer(stream.answer(i), round, lane, i);
        for (std::size_t i = round.rays.size(); i < stream.padded(); ++i)
            if (stream.answer(i).possible || stream.answer(i).certain)
                FAIL("something is said of an inert ray");
    }
    for (std::size_t i = 0; i < round.rays.size(); i += 10) {
        checks.bound_block(kind, view_of(round.block), view, i);
        for (int lane = 0; lane < round.count; ++lane)
            check_answer(stream.answer(lane), round, lane, i);
        for (int lane = round.count; lane < block_size; ++lane)
            if (stream.answer(lane).possible || stream.answer(lane).certain)
                FAIL("something is said of an empty lane");
    }
}

/// How much of its bounds a certain crossing uses: 0 in their middle, more than 1 outside of them.
/// Wide bounds (by grazing, or by an origin on the surface) are lopsided, so they tell nothing.
double use_of_bounds(const Answer& answer, const First& truth) {
    if (!answer.certain || !(answer.upper - answer.lower < 0x1p-14 * truth.t)) return 0.0;
    const double middle = 0.5 * (answer.lower + answer.upper),
                 half_width = 0.5 * (answer.upper - answer.lower);
    return half_width > 0.0 ? std::abs(truth.t - middle) / half_width : infinity;
}

template <class Shape>
struct Attempt {
    Shape shape;
    Ray<double> ray;
};

template <class Shape>
double use_of_bounds(const FilterChecks& checks, const Attempt<Shape>& attempt) {
    const First truth = first_crossing(attempt.shape, attempt.ray);
    if (!truth.exists() || !truth.known) return -1.0;
    Block<Shape> block;
    block.set(0, attempt.shape, 0);
    Stream stream;
    stream.add(Doubled(attempt.ray));
    const FilterStream view = stream.view();
    checks.bound_rays(static_cast<KindNumber>(kind_of<Shape>), view_of(block), 0, view);
    const Answer answer = stream.answer(0);
    if (const char* const wrong = lie(answer, truth)) FAIL(wrong);
    return use_of_bounds(answer, truth);
}

/// Changes rays and shapes a little, over and over, and keeps what makes the bounds fit worse. With
/// slack in the origins, moving one along the ray uses all of it: bounds come close to being broken
/// whatever rounding does.
template <class Shape>
double climb(const FilterChecks& checks, bool slack, Random& random, int steps) {
    Attempt<Shape> best{make_shape<Shape>(random, false), {}};
    best.ray = attack(best.shape, false, random);
    const auto tidy = [&](Ray<double>& ray) {
        if (!slack) ray.origin = in_double(convert<float>(ray.origin));
        ray.direction = normalized(ray.direction);
    };
    tidy(best.ray);
    double most = use_of_bounds(checks, best);
    for (int step = 0; step < steps; ++step) {
        Attempt<Shape> next = best;
        const double size = random.log_uniform(1e-9, 1e-1);
        switch (random.integer(0, 3)) {
        case 0:
            next.shape = nudged(next.shape, size, random);
            break;
        case 1:
            next.ray.origin += random.direction() * (size * length(next.ray.origin));
            break;
        case 2:
            next.ray.direction = normalized(next.ray.direction + random.direction() * size);
            break;
        default:
            if (most <= 0.0) next.ray = attack(next.shape, false, random);
            next.ray.origin += next.ray.direction * (random.uniform(-1.0, 1.0) * size *
                                                     ray_sets::Target<Shape>::size(next.shape));
        }
        tidy(next.ray);
        if (!is_shape(next.shape)) continue;
        const double use = use_of_bounds(checks, next);
        if (use < most) continue;
        most = use;
        best = next;
    }
    return most;
}

Isa widest_isa() {
    Isa best = Isa::sse42;
    for (const Isa isa : all_isas)
        if (is_available(isa)) best = isa;
    return best;
}

} // namespace

TEMPLATE_TEST_CASE("what the filters say of a ray is so", "", RAYLANE_ALL_SHAPES) {
    Random random(23);
    for (int round = 0; round < rounds(); ++round) {
        const Round<TestType> trial(random);
        for (const Isa isa : all_isas) {
            if (!is_available(isa)) continue;
            CAPTURE(static_cast<int>(isa), round);
            check_round(checks_of(isa), trial);
        }
    }
}

TEMPLATE_TEST_CASE("no search finds a ray that breaks the filters' bounds", "",
                   RAYLANE_ALL_SHAPES) {
    Random random(29);
    double most = 0.0, most_with_slack = 0.0;
    for (int start = 0; start < std::max(1, rounds() / 5); ++start) {
        const FilterChecks checks = checks_of(start % 4 == 0 ? Isa::sse42 : widest_isa());
        most = std::max(most, climb<TestType>(checks, false, random, 200));
        most_with_slack = std::max(most_with_slack, climb<TestType>(checks, true, random, 100));
    }
    CHECK(most < 1.0);
    CHECK(most_with_slack < 1.0);
    if (wants_report())
        WARN(name_of(kind_of<TestType>) << ": the worst ray uses " << most
                                        << " of its bounds, with slack " << most_with_slack);
}

namespace {

template <class Shape>
constexpr bool is_solid =
    std::is_same_v<Shape, Sphere> || std::is_same_v<Shape, Box> ||
    std::is_same_v<Shape, CappedCylinder> || std::is_same_v<Shape, CappedCone>;

/// How tight the bounds are, in t plus the distance of the origin from the shape.
struct Tightness {
    std::vector<double> gaps;   ///< from lower to t
    std::vector<double> widths; ///< from lower to upper, where certain
    int hits = 0, certain = 0, misses = 0, ghosts = 0;

    void add(const Answer& answer, const First& truth, double distance) {
        if (truth.exists()) {
            ++hits;
            gaps.push_back((truth.t - answer.lower) / (truth.t + distance));
            if (!answer.certain) return;
            ++certain;
            widths.push_back((answer.upper - answer.lower) / (truth.t + distance));
        } else {
            ++misses;
            ghosts += answer.possible ? 1 : 0;
        }
    }

    static double quantile(std::vector<double> values, double q) {
        if (values.empty()) return infinity;
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
    }
    double certain_rate() const { return certain / static_cast<double>(std::max(1, hits)); }
    double ghost_rate() const { return ghosts / static_cast<double>(std::max(1, misses)); }
};

template <class Shape>
Tightness tightness(Set set) {
    Random random(31);
    Tightness result;
    while (result.hits < 4000) {
        using T = ray_sets::Target<Shape>;
        const Shape shape = T::make(random, false);
        Block<Shape> block;
        block.set(0, shape, 0);
        Stream stream;
        std::vector<Doubled> rays;
        for (int i = 0; i < 64; ++i) {
            const Ray<float> ray = ray_sets::make_ray(shape, set, random);
            rays.emplace_back(Ray<double>{in_double(ray.origin), in_double(ray.direction)});
            stream.add(rays.back());
        }
        const FilterStream view = stream.view();
        checks_of(widest_isa())
            .bound_rays(static_cast<KindNumber>(kind_of<Shape>), view_of(block), 0, view);
        for (std::size_t i = 0; i < rays.size(); ++i)
            result.add(stream.answer(i), first_crossing(shape, rays[i].ray),
                       length(Vec3d(rays[i].ray.origin - T::center(shape))));
    }
    if (wants_report())
        WARN(name_of(kind_of<Shape>)
             << (set == Set::inside ? ", inside" : "") << ": gap median "
             << Tightness::quantile(result.gaps, 0.5) << ", p90 "
             << Tightness::quantile(result.gaps, 0.9) << ", p99 "
             << Tightness::quantile(result.gaps, 0.99) << ", median width "
             << Tightness::quantile(result.widths, 0.5) << "; hits certain "
             << result.certain_rate() << ", misses held possible " << result.ghost_rate());
    return result;
}

} // namespace

TEMPLATE_TEST_CASE("the filters' bounds are tight", "", RAYLANE_ALL_SHAPES) {
    const Tightness found = tightness<TestType>(Set::random);
    CHECK(Tightness::quantile(found.gaps, 0.5) < 3e-6);
    CHECK(Tightness::quantile(found.gaps, 0.99) < 1e-4);
    CHECK(found.certain_rate() > 0.95);
    CHECK(found.ghost_rate() < 0.01);
    if constexpr (is_solid<TestType>) {
        const Tightness inside = tightness<TestType>(Set::inside);
        CHECK(Tightness::quantile(inside.gaps, 0.5) < 1e-4);
        CHECK(inside.certain_rate() > 0.95);
    }
}
