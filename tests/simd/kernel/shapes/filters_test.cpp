#include "tests/simd/kernel/shapes/filter_trial.hpp"
#include "tests/simd/kernel/shapes/hard_cases.hpp"
#include "tests/simd/kernel/shapes/mutations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using namespace raylane::filter_trial;
using namespace raylane::hard_cases;

/// Compares the filters' bounds with the certified answer in double.

namespace {

int rounds() {
    return tests::rounds(500);
}

/// Returns whether the tightness of the bounds is to be printed.
bool wants_report() {
    return std::getenv("RAYLANE_TEST_REPORT") != nullptr;
}

template <class Shape>
struct Round {
    Block<Shape> block;
    int count;
    std::vector<Doubled> rays;
    std::vector<First> truth; ///< of all rays with shape 0, then with shape 1, ...

    explicit Round(Random& random, Shape (*make)(Random&, bool) = make_shape<Shape>)
        : count(random.integer(1, 3)) {
        const bool lattice = random.integer(0, 5) == 0;
        for (int lane = 0; lane < count; ++lane)
            block.set(lane, make(random, lattice), static_cast<ShapeId>(lane));
        for (int i = 0; i < 100; ++i)
            rays.emplace_back(with_unit_direction(
                attack(block.get(random.integer(0, count - 1)), lattice, random)));
        for (int lane = 0; lane < count; ++lane)
            for (const Doubled& ray : rays)
                truth.push_back(first_crossing(block.get(lane), ray.ray));
    }

    const First& first(int lane, std::size_t i) const {
        return truth[static_cast<std::size_t>(lane) * rays.size() + i];
    }
};

/// Returns a cylinder or cone with radii up to 1e30. Squares of their numbers overflow in float.
template <class Shape>
Shape with_huge_radii(Random& random, bool lattice) {
    constexpr std::size_t first_radius = 6;
    while (true) {
        Numbers<Shape> numbers = numbers_of(make_shape<Shape>(random, lattice));
        for (std::size_t i = first_radius; i < numbers.size(); ++i)
            if (random.integer(0, 2) > 0)
                numbers[i] = std::ldexp(numbers[i], random.integer(20, 99));
        const Shape shape = shape_of<Shape>(numbers);
        if (mutations::is_valid(shape)) return shape;
    }
}

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
    const Numbers<Shape> floats = numbers_of(round.block.get(lane));
    CAPTURE(std::vector<float>(floats.begin(), floats.end()));
    FAIL(wrong);
}

template <class Shape>
void check_round(const FilterChecks& checks, const Round<Shape>& round) {
    const auto kind = kind_of<Shape>;
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
                FAIL("an inert ray has a crossing");
    }
    for (std::size_t i = 0; i < round.rays.size(); i += 10) {
        checks.bound_block(kind, view_of(round.block), view, i);
        for (int lane = 0; lane < round.count; ++lane)
            check_answer(stream.answer(lane), round, lane, i);
        for (int lane = round.count; lane < block_size; ++lane)
            if (stream.answer(lane).possible || stream.answer(lane).certain)
                FAIL("an empty lane has a crossing");
    }
}

} // namespace

TEMPLATE_TEST_CASE("what the filters say of a ray is so", "", RAYLANE_ALL_SHAPES) {
    Random random(23);
    for (int round = 0; round < rounds(); ++round) {
        const Round<TestType> trial(random);
        for (const Isa isa : available_isas()) {
            CAPTURE(static_cast<int>(isa), round);
            check_round(checks_of(isa), trial);
        }
    }
}

TEMPLATE_TEST_CASE("filters of cylinders and cones with huge radii are right", "", OpenCylinder,
                   CappedCylinder, OpenCone, CappedCone) {
    Random random(24);
    for (int round = 0; round < rounds(); ++round) {
        const Round<TestType> trial(random, with_huge_radii<TestType>);
        for (const Isa isa : available_isas()) {
            CAPTURE(static_cast<int>(isa), round);
            check_round(checks_of(isa), trial);
        }
    }
}

namespace {

template <class Shape>
void check_ray(const Shape& shape, const Ray<double>& ray) {
    Block<Shape> block;
    block.set(0, shape, 0);
    const First truth = first_crossing(shape, ray);
    for (const Isa isa : available_isas()) {
        Stream stream;
        stream.add(Doubled(ray));
        checks_of(isa).bound_rays(kind_of<Shape>, view_of(block), 0, stream.view());
        const char* const wrong = lie(stream.answer(0), truth);
        INFO(static_cast<int>(isa) << ": " << (wrong == nullptr ? "" : wrong));
        CHECK(wrong == nullptr);
    }
}

} // namespace

/// A random search found these rays. The square of a length overflows, its error does not.
TEST_CASE("filters of cylinders and cones with a radius above 2^64 are right") {
    const Vec3f base(0x1.a03064p+62F, 0x1.2fc9aep+60F, 0x1.1115f8p+63F),
        axis(0x1.2751bcp+53F, 0x1.60545cp+55F, 0x1.f1a028p+52F);
    const Ray<double> ray = {{0x1.ef40ec0000002p+63, 0x1.106d8e0000003p+60, -0x1.639f260000008p+60},
                             {-0x1.dd55b67e09152p-2, 0x1.5ba2dc5bca33bp-2, 0x1.a24b0a6e72347p-1}};
    check_ray(OpenCylinder{base, axis, 0x1.216d72p+64F}, ray);
    check_ray(CappedCylinder{base, axis, 0x1.216d72p+64F}, ray);
    check_ray(CappedCone{{0x1.1e847cp+65F, -0x1.6bab64p+65F, 0x1.03140ap+66F},
                         {-0x1.f75e5ep+58F, -0x1.d32264p+56F, 0x1.de7656p+57F},
                         0x1.3ff5bap+64F,
                         0},
              {{0x1.1098be71c3503p+65, -0x1.5854371a29efdp+65, 0x1.f401433789ef7p+65},
               {0x1.56f2b78f52de7p-2, -0x1.4a2accaeb6472p-1, 0x1.5fc0ce543d6bdp-1}});
}

TEST_CASE("the filter of a box is right for a direction with a subnormal component") {
    const Box box{{0x1.317b2p+0F, 0x1.20fc24p+3F, 0x1.9ee324p-1F},
                  {0x1.f15464p-2F, 0, 0},
                  {0, 0x1.294e34p+50F, 0},
                  {0, 0, 0x1.4a021p-43F}};
    check_ray(
        box, {{-0x1.e33de4p+97, 0x1.20fc24p+3, 0x1.9ee324p-1}, {1.0, 0.0, 0x1.5da37f044dd56p-141}});
}

TEST_CASE("the filter of a triangle is right for a direction with a subnormal component") {
    const Triangle triangle{{-0x1.5d0958p-48F, 0x1.1a3774p-52F, -0x1.46c9a2p-49F},
                            {-0x1.5d066p-48F, 0x1.19922cp-52F, -0x1.46e998p-49F},
                            {0x1.1a029cp-48F, -0x1.01f7dcp-47F, -0x1.cf3e66p-48F}};
    check_ray(triangle, {{-0x1.3a892ap-48, -0x1.cfd25ep-54, -0x1.7ab918p+91},
                         {0.0, -0x1.74b918ebb63c6p-146, 1.0}});
}

TEST_CASE("a plane may be met beyond the largest float") {
    const Plane ground{{0, 0, 0}, {0, 1, 0}};
    const Ray<double> ray{{0, 1e10, 0}, {1, -1e-30, 0}};
    Block<Plane> block;
    block.set(0, ground, 0);
    for (const Isa isa : available_isas()) {
        Stream stream;
        stream.add(Doubled(ray));
        const FilterStream view = stream.view();
        checks_of(isa).bound_rays(Kind::plane, view_of(block), 0, view);
        CHECK(stream.answer(0).possible);
        CHECK(stream.answer(0).lower < infinity<double>);
    }
}

TEST_CASE("bounds and obstacles agree for rays that leave a sphere along its normal") {
    Random random(41);
    int possible = 0;
    for (int round = 0; round < 100; ++round) {
        using T = ray_sets::Target<Sphere>;
        const Sphere sphere = T::make(random, false);
        Block<Sphere> block;
        block.set(0, sphere, 0);
        Stream stream;
        for (int i = 0; i < 16; ++i) {
            const ray_sets::SurfacePoint start = T::surface(sphere, random);
            stream.add(Doubled(Ray<double>{start.point, start.normal}));
        }
        for (const Isa isa : available_isas()) {
            checks_of(isa).bound_rays(Kind::sphere, view_of(block), 0, stream.view());
            for (std::size_t i = 0; i < 16; ++i) {
                possible += stream.answer(i).possible ? 1 : 0;
                if (stream.answer(i).contradicts) FAIL("the blocking state contradicts the bounds");
            }
        }
    }
    CHECK(possible > 100);
}

namespace {

/// Tightness of the bounds, as a part of t plus the distance from the origin to the shape's centre.
struct Tightness {
    std::vector<double> gaps;   ///< from lower to t
    std::vector<double> widths; ///< from lower to upper, where certain
    int hits = 0, certain = 0, misses = 0, ghosts = 0, unsifted = 0;

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
            unsifted += answer.may_meet ? 1 : 0;
        }
    }

    static double quantile(std::vector<double> values, double q) {
        if (values.empty()) return infinity<double>;
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
    }
    double certain_rate() const { return certain / static_cast<double>(std::max(1, hits)); }
    double ghost_rate() const { return ghosts / static_cast<double>(std::max(1, misses)); }
    double unsifted_rate() const { return unsifted / static_cast<double>(std::max(1, misses)); }
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
            rays.emplace_back(
                with_unit_direction({in_double(ray.origin), in_double(ray.direction)}));
            stream.add(rays.back());
        }
        const FilterStream view = stream.view();
        checks_of(best_isa()).bound_rays(kind_of<Shape>, view_of(block), 0, view);
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
             << result.certain_rate() << ", misses held possible " << result.ghost_rate()
             << ", worth a look " << result.unsifted_rate());
    return result;
}

} // namespace

TEMPLATE_TEST_CASE("the filters' bounds are tight", "", RAYLANE_ALL_SHAPES) {
    const Tightness found = tightness<TestType>(Set::random);
    CHECK(Tightness::quantile(found.gaps, 0.5) < 3e-6);
    CHECK(Tightness::quantile(found.gaps, 0.99) < 1e-4);
    CHECK(found.certain_rate() > 0.95);
    if constexpr (tests::Nature<TestType>::is_sifted) CHECK(found.unsifted_rate() < 0.25);
    CHECK(found.ghost_rate() < 0.01);
    if constexpr (tests::is_solid<TestType>) {
        const Tightness inside = tightness<TestType>(Set::inside);
        CHECK(Tightness::quantile(inside.gaps, 0.5) < 1e-4);
        CHECK(inside.certain_rate() > 0.95);
    }
}
