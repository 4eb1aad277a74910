#include "tests/scenes/api/exam_in_double.hpp"
#include "tests/scenes/api/solid_exam.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cmath>

/// Tests of solids that are made of others against the oracle.
using namespace raylane;
using namespace raylane::tests;
using oracle::Expression, oracle::Op;

namespace {

/// Returns a shape that may be a part. With `lattice` its numbers are small whole ones.
AnyShapeInDouble any_part(Random& random, bool lattice) {
    const auto made = [&]<class Shape>(std::type_identity<Shape>) {
        return AnyShapeInDouble(core::to_doubles(ray_sets::Target<Shape>::make(random, lattice)));
    };
    switch (random.integer(0, 8)) {
    case 0:
        return made(std::type_identity<core::Plane>());
    case 1:
        return made(std::type_identity<core::Quadric>());
    case 2:
    case 3:
        return made(std::type_identity<core::Box>());
    case 4:
        return made(std::type_identity<core::CappedCylinder>());
    case 5:
        return made(std::type_identity<core::CappedCone>());
    case 6:
        return made(std::type_identity<core::Ellipsoid>());
    default:
        return made(std::type_identity<core::Sphere>());
    }
}

AnyShapeInDouble any_box(Random& random) {
    const double size = 8.0 * random.integer(1, 3);
    return core::BoxOf<double>{
        {-size / 2, -size / 2, -size / 2}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
}

Expression any_expression(Random& random, bool lattice, int depth,
                          std::vector<AnyShapeInDouble>& before) {
    if (depth == 0 || random.integer(0, 3) == 0) {
        // Repeats an earlier part or makes a new one.
        if (!before.empty() && random.integer(0, 4) == 0)
            return {Op::part, before[static_cast<std::size_t>(
                                  random.integer(0, static_cast<int>(before.size()) - 1))]};
        before.push_back(any_part(random, lattice));
        return {Op::part, before.back()};
    }
    constexpr Op ops[] = {Op::unite, Op::intersect, Op::subtract, Op::clip};
    Expression made{ops[random.integer(0, 3)]};
    const int parts = made.op == Op::unite && random.integer(0, 5) == 0 ? 20 : random.integer(2, 3);
    for (int i = 0; i < parts; ++i)
        made.operands.push_back(any_expression(random, lattice, depth - 1, before));
    return made;
}

/// Returns a crowd, that is a union of balls and a few other shapes, cut by planes, boxes and
/// balls.
Expression any_cut_crowd(Random& random, bool lattice) {
    const auto number = [&](double least, double most) {
        const double any = random.uniform(least, most);
        return lattice ? std::round(any) : any;
    };
    const auto point = [&] { return core::Vec3d(number(-3, 3), number(-3, 3), number(-3, 3)); };
    Expression crowd{Op::unite};
    for (int i = random.integer(25, 60); i > 0; --i) {
        const core::Vec3d center = point();
        const double radius = lattice ? 0.5 * random.integer(1, 3) : random.uniform(0.3, 1.2);
        if (random.integer(0, 7) != 0)
            crowd.operands.push_back({Op::part, core::SphereOf<double>{center, radius}});
        else if (random.integer(0, 1) != 0)
            crowd.operands.push_back({Op::part, core::CylinderOf<double, core::Ends::capped>{
                                                    center, {0, number(1, 3), 1}, radius}});
        else
            crowd.operands.push_back(
                {Op::part,
                 core::BoxOf<double>{center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}});
    }
    const auto plane = [&] {
        core::Vec3d normal = point();
        if (core::squared_length(normal) == 0.0) normal = {0, 0, 1};
        return Expression{Op::part, core::PlaneOf<double>{point(), normal}};
    };
    Expression made{random.integer(0, 3) == 0 ? Op::clip : Op::subtract};
    if (random.integer(0, 2) == 0) { // intersected with a box
        Expression boxed{Op::intersect};
        boxed.operands.push_back(std::move(crowd));
        boxed.operands.push_back({Op::part, core::BoxOf<double>{point(),
                                                                {number(2, 5), 0, 0},
                                                                {0, number(2, 5), 0},
                                                                {0, 0, number(2, 5)}}});
        crowd = std::move(boxed);
    }
    made.operands.push_back(std::move(crowd));
    for (int i = random.integer(1, 3); i > 0; --i) {
        switch (random.integer(0, 4)) {
        case 0: {
            Expression wedge{Op::intersect};
            for (int k = random.integer(2, 3); k > 0; --k)
                wedge.operands.push_back(plane());
            made.operands.push_back(std::move(wedge));
            break;
        }
        case 1:
            made.operands.push_back({Op::part, core::BoxOf<double>{point(),
                                                                   {number(1, 4), 0, 0},
                                                                   {0, number(1, 4), 0},
                                                                   {0, 0, number(1, 4)}}});
            break;
        case 2:
            made.operands.push_back({Op::part, core::SphereOf<double>{point(), number(1, 3)}});
            break;
        default:
            made.operands.push_back(plane());
        }
    }
    if (random.integer(0, 2) != 0) return made;
    // Beside another part.
    Expression both{Op::unite};
    both.operands.push_back(std::move(made));
    both.operands.push_back({Op::part, core::SphereOf<double>{point(), 1.0}});
    return both;
}

void ask(const Expression& expression, Random& random, bool lattice, int count, bool onward,
         SolidTally& wrong) {
    const std::optional<Scene> scene = scene_of(expression);
    if (!scene) return; // a quadric without bounds
    const std::vector<AnyShapeInDouble> shapes = shapes_of(expression);
    std::vector<core::Ray<float>> rays;
    for (int i = 0; i < count; ++i) {
        const auto& aim = shapes[static_cast<std::size_t>(
            random.integer(0, static_cast<int>(shapes.size()) - 1))];
        rays.push_back(std::visit(
            [&]<class Shape>(const Shape& shape) {
                return ray_sets::make_ray(
                    core::to_floats(shape),
                    lattice ? ray_sets::Set::lattice : ray_sets::any_set(random), random);
            },
            aim));
    }
    ask(expression, *scene, rays, wrong);
    if (onward) ask_onward(*scene, rays, wrong);
}

/// A solid of parts with one axis, and rays along it.
struct Bench {
    Expression solid;
    std::vector<core::Ray<float>> rays;
};

/// With `lattice` the axis is a coordinate axis, parts have whole numbers, and many rays touch them
/// or meet several at one point. Every third ray is off the axis by an ulp, and every third one is
/// tilted.
Bench any_bench(Random& random, bool lattice) {
    const core::Vec3f axis =
        lattice ? core::Vec3f(0, 0, 1)
                : core::Vec3f(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.5, 1));
    const core::Vec3d along = core::convert<double>(axis);
    const core::Vec3d across =
        lattice ? core::Vec3d(1, 0, 0) : core::normalized(core::cross(along, core::Vec3d(0, 1, 0)));
    const core::Vec3d beside =
        lattice ? core::Vec3d(0, 1, 0) : core::normalized(core::cross(along, across));
    const auto radius = [&] { return lattice ? random.integer(1, 5) : random.uniform(0.5, 5.0); };
    const auto any_of_axis = [&]() -> Expression {
        const core::Vec3d at = static_cast<double>(random.integer(-3, 3)) * along;
        const core::Vec3d length = static_cast<double>(random.integer(1, 4)) * along;
        switch (random.integer(0, 4)) {
        case 0:
            return {Op::part, core::CylinderOf<double, core::Ends::capped>{at, length, radius()}};
        case 1:
            return {Op::part,
                    core::ConeOf<double, core::Ends::capped>{at, length, radius(), radius()}};
        case 2:
            return {Op::part, core::PlaneOf<double>{at, along}};
        default:
            return {Op::part, core::SphereOf<double>{at, radius()}};
        }
    };
    Bench bench{{Op::intersect}, {}};
    Expression made{random.integer(0, 1) != 0 ? Op::subtract : Op::unite};
    for (int i = random.integer(2, 3); i > 0; --i) {
        Expression two{random.integer(0, 2) != 0 ? Op::intersect : Op::subtract};
        for (int k = 0; k < 2; ++k)
            two.operands.push_back(any_of_axis());
        made.operands.push_back(two);
    }
    bench.solid.operands = {made, {Op::part, core::SphereOf<double>{{0, 0, 0}, 9.0}}};
    for (int i = 0; i < 150; ++i) {
        const double u = lattice ? random.integer(-5, 5) : random.uniform(-5, 5),
                     v = lattice ? random.integer(-5, 5) : random.uniform(-5, 5);
        const bool back = random.integer(0, 1) != 0;
        core::Ray<float> ray{
            core::convert<float>(u * across + v * beside - (back ? -20.0 : 20.0) * along),
            (back ? -0.5F : 0.5F) * axis};
        if (i % 3 == 0) {
            float& nudged = ray.direction[random.integer(0, 2)];
            nudged = std::nextafter(nudged, random.integer(0, 1) != 0 ? 9.0F : -9.0F);
        } else if (i % 3 == 1) {
            const double tilt = std::ldexp(random.uniform(-1, 1), -random.integer(2, 20));
            ray.direction +=
                core::convert<float>(tilt * (random.integer(0, 1) != 0 ? across : beside));
        }
        bench.rays.push_back(ray);
    }
    return bench;
}

void check(const SolidTally& wrong, bool lattice) {
    CAPTURE(lattice, wrong.asked, wrong.surfaces, wrong.first, wrong.example);
    CHECK(wrong.rows == 0);
    CHECK(wrong.hits == 0);
    CHECK(wrong.blocked == 0);
    CHECK(wrong.sides == 0);
    CHECK(wrong.firsts == 0);
    CHECK(wrong.surfaces > wrong.asked / 10);
}

} // namespace

TEST_CASE("solids of any parts are crossed as in real arithmetic") {
    const bool lattice = GENERATE(true, false);
    Random random(seed(17));
    SolidTally wrong;
    const int scenes = rounds(50, 20, 120);
    for (int i = 0; i < scenes; ++i) {
        std::vector<AnyShapeInDouble> before;
        Expression made{Op::intersect};
        made.operands.push_back(any_expression(random, lattice, 3, before));
        if (random.integer(0, 3) != 0) made.operands.push_back({Op::part, any_box(random)});
        ask(made, random, lattice, 200, /*onward=*/true, wrong);
    }
    check(wrong, lattice);
}

TEST_CASE("a hit with a solid has the float nearest to the true t, not to its double") {
    // The true t is 2^-60 beside the middle of two floats, to which its double rounds.
    const double middle = 0x1.924925p+0;
    const Expression box{Op::part,
                         core::BoxOf<double>{{-1, -1, middle}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}};
    const Expression ball{Op::part, core::SphereOf<double>{{0, 0, 0}, 9.0}};
    const Expression solid{Op::intersect, {}, {box, ball}};
    std::vector<core::Ray<float>> rays;
    for (const float off : {-0x1p-60F, 0.0F, 0x1p-60F})
        rays.push_back({{0, 0, off}, {0, 0, 1}});
    const std::optional<Scene> scene = scene_of(solid);
    REQUIRE(scene);
    SolidTally wrong;
    ask(solid, *scene, rays, wrong);
    check(wrong, false);
}

TEST_CASE("a crowd that is cut is crossed as in real arithmetic") {
    const bool lattice = GENERATE(true, false);
    Random random(seed(23));
    SolidTally wrong;
    const int scenes = rounds(30, 20, 60);
    for (int i = 0; i < scenes; ++i)
        ask(any_cut_crowd(random, lattice), random, lattice, 100, /*onward=*/false, wrong);
    check(wrong, lattice);
}

TEST_CASE("solids with one axis are crossed as in real arithmetic by rays along it") {
    const bool lattice = GENERATE(true, false);
    Random random(seed(29));
    SolidTally wrong;
    const int scenes = rounds(60, 20, 200);
    for (int i = 0; i < scenes; ++i) {
        const Bench bench = any_bench(random, lattice);
        const std::optional<Scene> scene = scene_of(bench.solid);
        if (!scene) continue;
        ask(bench.solid, *scene, bench.rays, wrong);
        if (!lattice) ask_onward(*scene, bench.rays, wrong);
    }
    check(wrong, lattice);
}

TEST_CASE("limits of rays in double at a solid's surfaces lead to the next one or include it") {
    Random random(seed(31));
    const int scenes = rounds(20, 8, 60);
    std::size_t wrong = 0, asked = 0;
    for (int i = 0; i < scenes; ++i) {
        const Bench bench = any_bench(random, /*lattice=*/false);
        const std::optional<Scene> scene = scene_of(bench.solid);
        if (!scene) continue;
        const Tracer tracer(*scene);
        DoubleRays rays, limited;
        for (const core::Ray<float>& ray : bench.rays)
            rays.add({core::convert<double>(ray.origin) + core::Vec3d(1e-9),
                      core::convert<double>(ray.direction)},
                     0.0, endless);
        CrossingRows rows;
        tracer.crossings(rays.span(), rows);
        std::vector<double> expected;
        for (std::size_t ray = 0; ray < rays.size(); ++ray) {
            const auto t =
                std::span(rows.t).subspan(rows.first[ray], rows.first[ray + 1] - rows.first[ray]);
            const core::Ray<double> exact{
                {rays.origin[0][ray], rays.origin[1][ray], rays.origin[2][ray]},
                {rays.direction[0][ray], rays.direction[1][ray], rays.direction[2][ray]}};
            for (const double limit : t) {
                const auto next = std::upper_bound(t.begin(), t.end(), limit);
                limited.add(exact, limit, endless);
                expected.push_back(next != t.end() ? *next : endless);
                limited.add(exact, std::nextafter(limit, 0.0), limit);
                expected.push_back(limit);
            }
        }
        const DoubleAnswers answers(tracer, limited);
        asked += expected.size();
        for (std::size_t k = 0; k < expected.size(); ++k) {
            const bool same = answers.t_double[k] == expected[k] &&
                              answers.blocked[k] == (expected[k] < endless ? 1 : 0) &&
                              is_first(answers.firsts, answers.rows, k);
            wrong += same ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(asked > 1000);
}
