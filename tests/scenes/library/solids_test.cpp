#include "core/shapes/side.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/solid.hpp"
#include "tests/ray_sets.hpp"
#include "tests/sanitized.hpp"
#include "tests/scenes/library/in_library.hpp"
#include "tests/scenes/library/ray_arrays.hpp"
#include "tests/simd/rounds.hpp"

#include <sstream>

/// Solids that are made of others, held to the oracle.
using namespace raylane;
using namespace raylane::tests;
using oracle::Expression, oracle::Op;

namespace {

/// A shape that may be a part, of small whole numbers or of any.
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
        // The same once more, or something new.
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
        made.of.push_back(any_expression(random, lattice, depth - 1, before));
    return made;
}

/// A crowd of balls and a few others, less what planes, boxes and balls take away.
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
            crowd.of.push_back({Op::part, core::SphereOf<double>{center, radius}});
        else if (random.integer(0, 1) != 0)
            crowd.of.push_back({Op::part, core::CylinderOf<double, core::Ends::capped>{
                                              center, {0, number(1, 3), 1}, radius}});
        else
            crowd.of.push_back(
                {Op::part,
                 core::BoxOf<double>{center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}});
    }
    const auto plane = [&] {
        core::Vec3d normal = point();
        if (core::squared_length(normal) == 0.0) normal = {0, 0, 1};
        return Expression{Op::part, core::PlaneOf<double>{point(), normal}};
    };
    Expression made{random.integer(0, 3) == 0 ? Op::clip : Op::subtract};
    if (random.integer(0, 2) == 0) { // what is left of it in a box
        Expression boxed{Op::intersect};
        boxed.of.push_back(std::move(crowd));
        boxed.of.push_back({Op::part, core::BoxOf<double>{point(),
                                                          {number(2, 5), 0, 0},
                                                          {0, number(2, 5), 0},
                                                          {0, 0, number(2, 5)}}});
        crowd = std::move(boxed);
    }
    made.of.push_back(std::move(crowd));
    for (int i = random.integer(1, 3); i > 0; --i) {
        switch (random.integer(0, 4)) {
        case 0: {
            Expression wedge{Op::intersect};
            for (int k = random.integer(2, 3); k > 0; --k)
                wedge.of.push_back(plane());
            made.of.push_back(std::move(wedge));
            break;
        }
        case 1:
            made.of.push_back({Op::part, core::BoxOf<double>{point(),
                                                             {number(1, 4), 0, 0},
                                                             {0, number(1, 4), 0},
                                                             {0, 0, number(1, 4)}}});
            break;
        case 2:
            made.of.push_back({Op::part, core::SphereOf<double>{point(), number(1, 3)}});
            break;
        default:
            made.of.push_back(plane());
        }
    }
    if (random.integer(0, 2) != 0) return made;
    // Beside something else.
    Expression both{Op::unite};
    both.of.push_back(std::move(made));
    both.of.push_back({Op::part, core::SphereOf<double>{point(), 1.0}});
    return both;
}

raylane::Solid solid_of(const Expression& expression) {
    if (expression.op == Op::part)
        return std::visit(
            []<class Shape>(const Shape& shape) {
                return raylane::Solid(std::bit_cast<typename InLibrary<Shape>::Type>(shape));
            },
            expression.shape);
    std::vector<raylane::Solid> parts;
    for (const Expression& part : expression.of)
        parts.push_back(solid_of(part));
    const std::vector<raylane::Solid> others(parts.begin() + 1, parts.end());
    switch (expression.op) {
    case Op::unite:
        return union_of(parts);
    case Op::intersect:
        return intersection_of(parts);
    case Op::subtract:
        return difference_of(parts[0], others);
    default:
        return clipped(parts[0], others);
    }
}

template <class Visit>
void each_shape(const Expression& expression, const Visit& visit) {
    if (expression.op == Op::part) visit(expression.shape);
    for (const Expression& part : expression.of)
        each_shape(part, visit);
}

/// True also where a line lies in faces.
bool is_on(const AnyShapeInDouble& any, const core::Vec3d& point) {
    return std::visit(
        [&]<class Shape>(const Shape& shape) {
            if constexpr (core::has_inside<Shape>)
                return core::side_of(shape, point) == core::Side::surface;
            else
                return false;
        },
        any);
}

struct Wrong {
    long rows = 0, hits = 0, blocked = 0, sides = 0, asked = 0, surfaces = 0;
    std::string first, of;

    void blame(long& kind, const std::string& what) {
        if (++kind == 1) first += what + "\n";
    }
};

std::string described(const Expression& expression) {
    std::ostringstream text;
    text.precision(17);
    if (expression.op == Op::part) {
        text << core::name_of(static_cast<core::Kind>(expression.shape.index())) << "[";
        std::visit(
            [&](const auto& shape) {
                for (const double number : core::numbers_of(shape))
                    text << " " << number;
            },
            expression.shape);
        text << " ]";
        return text.str();
    }
    text << "|&-/"[static_cast<int>(expression.op) - 1] << "(";
    for (const Expression& part : expression.of)
        text << described(part) << " ";
    text << ")";
    return text.str();
}

std::string word(core::ShapeId shape, double t, bool entering) {
    std::ostringstream text;
    text.precision(17);
    text << (entering ? "+" : "-") << shape << "@" << t << " ";
    return text.str();
}

void ask(const Expression& expression, Random& random, bool lattice, int count, Wrong& wrong) {
    SceneBuilder builder;
    std::optional<Scene> scene;
    try {
        builder.add(solid_of(expression), builder.add_material({}));
        scene = builder.build();
    } catch (const InvalidValue&) { // a quadric without bounds
        return;
    }
    std::vector<AnyShapeInDouble> shapes;
    each_shape(expression, [&](const AnyShapeInDouble& shape) { shapes.push_back(shape); });
    Rays rays;
    std::vector<core::Ray<double>> exact;
    for (int i = 0; i < count; ++i) {
        const auto& aim = shapes[static_cast<std::size_t>(
            random.integer(0, static_cast<int>(shapes.size()) - 1))];
        const core::Ray<float> ray = std::visit(
            [&]<class Shape>(const Shape& shape) {
                return ray_sets::make_ray(
                    core::to_floats(shape),
                    lattice ? ray_sets::Set::lattice : ray_sets::any_set(random), random);
            },
            aim);
        rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                 {ray.direction.x, ray.direction.y, ray.direction.z});
        exact.push_back({core::convert<double>(ray.origin), core::convert<double>(ray.direction)});
    }
    const bool has_clip = described(expression).find('/') != std::string::npos;
    const Tracer tracer(*scene);
    CrossingRows rows;
    tracer.crossings(rays.span(), rows);
    const Hits hits = intersect(tracer, rays);
    std::vector<std::uint8_t> blocked(rays.size());
    tracer.occluded(rays.span(), blocked);
    SolidRows solids;
    tracer.contains(PointSpan{rays.span().origin_x, rays.span().origin_y, rays.span().origin_z},
                    solids);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        oracle::SolidLine line(expression, exact[i]);
        const std::vector<oracle::SolidHit> truth = line.surfaces();
        ++wrong.asked;
        wrong.surfaces += static_cast<long>(truth.size());
        std::string expected, found;
        for (const oracle::SolidHit& hit : truth)
            expected +=
                word(hit.shape, oracle::rounded_to_double(hit.hit.root, hit.hit.t), hit.entering);
        for (std::uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
            found += word(rows.shape[k], rows.t[k], rows.entering[k] != 0);
        if (found != expected) wrong.blame(wrong.rows, "rows " + found + "for " + expected);
        std::string first =
            truth.empty()
                ? "none"
                : word(truth[0].shape,
                       static_cast<double>(oracle::rounded(truth[0].hit.root, truth[0].hit.t)),
                       truth[0].entering);
        const std::string hit =
            hits.shape[i] == no_shape
                ? "none"
                : word(hits.shape[i], static_cast<double>(hits.t[i]), hits.entering[i] != 0);
        if (hit != first) wrong.blame(wrong.hits, "hit " + hit + "for " + first);
        if ((blocked[i] != 0) == truth.empty()) wrong.blame(wrong.blocked, "occluded " + first);
        int side = line.side_of_origin();
        for (const AnyShapeInDouble& shape : shapes)
            if (is_on(shape, exact[i].origin)) side = 0;
        const bool is_in = solids.first[i] != solids.first[i + 1];
        // What is clipped may have an inside, and no surface at all.
        if (side != 0 && !has_clip && is_in != (side < 0)) wrong.blame(wrong.sides, "side");
        if (!wrong.first.empty() && wrong.of.empty()) {
            std::ostringstream text;
            text.precision(17);
            for (int axis = 0; axis < 3; ++axis)
                text << exact[i].origin[axis] << " " << exact[i].direction[axis] << ", ";
            wrong.of = described(expression) + " by " + text.str();
        }
    }
}

void check(const Wrong& wrong, bool lattice) {
    CAPTURE(lattice, wrong.asked, wrong.surfaces, wrong.first, wrong.of);
    CHECK(wrong.rows == 0);
    CHECK(wrong.hits == 0);
    CHECK(wrong.blocked == 0);
    CHECK(wrong.sides == 0);
    CHECK(wrong.surfaces > wrong.asked / 10);
}

} // namespace

TEST_CASE("solids of any others are what real arithmetic says") {
    const bool lattice = GENERATE(true, false);
    Random random(seed(17));
    Wrong wrong;
    const int scenes = rounds(120);
    for (int i = 0; i < scenes; ++i) {
        std::vector<AnyShapeInDouble> before;
        Expression made{Op::intersect};
        made.of.push_back(any_expression(random, lattice, 3, before));
        if (random.integer(0, 3) != 0) made.of.push_back({Op::part, any_box(random)});
        ask(made, random, lattice, 200, wrong);
    }
    check(wrong, lattice);
}

TEST_CASE("a crowd that is cut is what real arithmetic says") {
    const bool lattice = GENERATE(true, false);
    Random random(seed(23));
    Wrong wrong;
    const int scenes = rounds(60);
    for (int i = 0; i < scenes; ++i)
        ask(any_cut_crowd(random, lattice), random, lattice, 100, wrong);
    check(wrong, lattice);
}
